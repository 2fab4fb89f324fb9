#pragma once
/// Tissue of two materials whose border runs through voxels' blocks.

#include "elasticity/specimens.h"

namespace cfem_cutting {

/// 12 × 8 × 8 voxels of 0.01 m; the border is a slanted plane.
inline VoxelVolume two_material_box() {
  return labelled_volume({12, 8, 8}, 0.01, 0.01, Pose::Identity(),
                         [](const Vec3& X) { return X.x() + 0.5 * X.y() < 0.07; });
}

/// The same, turned in the lattice, so that many voxels are partly filled.
inline VoxelVolume tilted_two_material_box() {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(0.4, Vec3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  return labelled_volume({12, 8, 8}, 0.01, 0.008, pose,
                         [](const Vec3& X) { return X.x() + 0.5 * X.y() < 0.07; });
}

inline std::vector<Material> soft_and_stiff() {
  Material stiff = soft(0.3);
  stiff.young_modulus = 5e4;
  return two_materials(soft(0.45), stiff);
}

}  // namespace cfem_cutting
