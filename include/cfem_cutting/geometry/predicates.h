#pragma once

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// Exact sign (−1, 0, 1) of the area of triangle a, b, c; 1 if counter-clockwise.
int orient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// Exact sign of det[b − a, c − a, d − a]: 1 if d lies on the side to which (b − a) × (c − a) points.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace cfem_cutting
