#pragma once
/// Tissue that the elasticity tests share.

#include <functional>
#include <random>

#include "cfem_cutting/elasticity/integrator.h"
#include "cfem_cutting/volume/shapes.h"

namespace cfem_cutting {

/// A box of tissue from the origin.
inline VoxelVolume box_volume(const Vec3& size, double spacing) {
  return VoxelVolume::sample(*make_box(size, Pose::Identity()), Vec3::Constant(spacing));
}

/// A box turned in the lattice, so that many voxels are partly filled.
inline VoxelVolume tilted_volume(const Vec3& size, double spacing) {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(0.4, Vec3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  return VoxelVolume::sample(*make_box(size, pose), Vec3::Constant(spacing));
}

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

/// Materials of the labels 1 and 2.
inline std::vector<Material> two_materials(const Material& first, const Material& second) {
  std::vector<Material> materials{first, second};
  materials[0].label = 1;
  materials[1].label = 2;
  return materials;
}

/// Severs the links that cross a plane through `point` (m), where the voxel's centre fulfils `where`.
inline void sever_plane(
    VoxelVolume& volume, const Vec3& point, const Vec3& normal,
    const std::function<bool(const Vec3&)>& where = [](const Vec3&) { return true; }) {
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    if (!volume.voxel(v).linked() || !where(volume.centre(v))) continue;
    for (int axis = 0; axis < 3; ++axis) {
      if (volume.voxel(v).link[2 * axis + 1] != LinkState::kIntact) continue;
      const Vec3 a = volume.centre(v), b = volume.centre(volume.voxel(v).neighbour[2 * axis + 1]);
      const double da = (a - point).dot(normal), db = (b - point).dot(normal);
      if ((da < 0.0) != (db < 0.0)) volume.sever({v, axis}, {a + (b - a) * (da / (da - db)), normal});
    }
  }
}

inline Material soft(double poisson_ratio) {
  Material material;
  material.poisson_ratio = poisson_ratio;
  return material;
}

inline HeldNodes hold_where(const CompositeMesh& mesh, const std::function<bool(const Vec3&)>& where) {
  HeldNodes held;
  for (int n = 0; n < mesh.node_count(); ++n) {
    if (!where(mesh.rest().col(n))) continue;
    held.nodes.push_back(n);
    held.positions.push_back(mesh.rest().col(n));
  }
  return held;
}

/// Displacements of up to `size` (m), the same on every run.
inline NodeField random_displacement(int nodes, double size, unsigned seed) {
  std::mt19937 generator(seed);
  NodeField field(3, nodes);
  for (Eigen::Index i = 0; i < field.size(); ++i)
    field(i) = size * (2.0 * (static_cast<double>(generator()) / 4294967295.0) - 1.0);
  return field;
}

inline SolverOptions precise() {
  SolverOptions options;
  options.tolerance = 1e-12;
  options.max_iterations = 4000;
  return options;
}

}  // namespace cfem_cutting
