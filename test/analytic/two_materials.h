#pragma once
/// Tissue of two materials whose border runs through voxels' blocks.

#include "elasticity/specimens.h"

namespace cfem_cutting {

/// A box of image voxels of this spacing, label 1 where `first` holds and 2 elsewhere, placed by X_TS.
inline VoxelVolume labelled_volume(const Vec3i& size, double spacing, double lattice_spacing,
                                   const Pose& X_TS, const std::function<bool(const Vec3&)>& first) {
  LabelImage image{size, Vec3::Constant(spacing), {}};
  const Lattice lattice{Vec3::Zero(), image.spacing, size};
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) image.labels.push_back(first(lattice.centre({i, j, k})) ? 1 : 2);
  return VoxelVolume::sample(*make_label_shape(image, {1, 2}, X_TS, "two materials"),
                             Vec3::Constant(lattice_spacing));
}

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

/// Materials of the labels 1 and 2.
inline std::vector<Material> two_materials(const Material& first, const Material& second) {
  std::vector<Material> materials{first, second};
  materials[0].label = 1;
  materials[1].label = 2;
  return materials;
}

inline std::vector<Material> soft_and_stiff() {
  Material stiff = soft(0.3);
  stiff.young_modulus = 5e4;
  return two_materials(soft(0.45), stiff);
}

}  // namespace cfem_cutting
