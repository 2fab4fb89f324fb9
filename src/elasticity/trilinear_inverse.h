#pragma once

#include <array>
#include <optional>

#include "cfem_cutting/elasticity/composite_mesh.h"

namespace cfem_cutting {

/// Solves x(t) = x for the trilinear map of a hexahedron by Newton's method.
/// @param corners (3 × 8), m; node a + 2(b + 2c) at t = (a, b, c)
/// @param largest bound of |t − ½|: an iterate beyond means that x is too far away
/// @return t, or nothing if the method leaves the bound or does not converge
std::optional<Vec3> invert_trilinear(const Eigen::Matrix<double, 3, 8>& corners, const Vec3& x,
                                     double largest);

}  // namespace cfem_cutting
