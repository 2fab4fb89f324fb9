#pragma once
/// Vocabulary types. SI units: m, s, kg, N, Pa, J, rad. Frames are named in variables: X_* are
/// material points (tissue frame, undeformed), x_* or p_* are points of the deformed tissue frame T.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace cfem_cutting {

using Vec3 = Eigen::Vector3d;
using Vec3i = Eigen::Vector3i;
using Mat3 = Eigen::Matrix3d;
using Pose = Eigen::Isometry3d;  ///< X_AB: takes points of frame B to frame A

using Polyline = std::vector<Vec3>;

/// Axis-parallel box, also used for held regions.
using Box = Eigen::AlignedBox3d;

}  // namespace cfem_cutting
