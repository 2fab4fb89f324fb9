#pragma once

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// Rotation part of a deformation gradient.
struct PolarRotation {
  Mat3 R;
  bool inverted;  ///< flat or turned inside out: det F below `kFlatVolumeRatio`
};

constexpr double kFlatVolumeRatio = 1e-3;

/// The rotation nearest to F (proper also if F is flat or inverted).
PolarRotation polar_rotation(const Mat3& F);

/// Modified Rodrigues parameters of a rotation, axis × tan(angle / 4) (Schaub and Junkins 1996): three
/// numbers of size 1 at most instead of nine.
Vec3 rodrigues_parameters(const Mat3& R);

/// Solves (tr(S) I − S) q = t for the stretch S = RᵀF, with near-singular directions regularised.
Vec3 solve_spin(const Mat3& S, const Vec3& t);

}  // namespace cfem_cutting
