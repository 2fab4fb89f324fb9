#pragma once
/// Cubes of tissue, 0.1 m across and held at the bottom, whose equilibria tests count and benchmarks time.

#include <limits>

#include "conjugate_gradients.h"
#include "specimens.h"

namespace cfem_cutting {

enum class CubeTissue {
  kUniform,
  kLayers,  ///< of four voxels, 1 : 100
  kMixture  ///< of voxels without pattern, 1 : 100
};

inline HeldNodes hold_bottom(const CompositeMesh& mesh) {
  const double bottom = mesh.rest().row(2).minCoeff();
  return hold_where(mesh, [bottom](const Vec3& X) { return X.z() <= bottom + 0.01; });
}

/// Severs the links through y = 0.0503 m from the top down to a part of the height.
inline void sever_half(VoxelVolume& volume, double part) {
  sever_plane(volume, {0.0, 0.0503, 0.0}, Vec3::UnitY(),
              [part](const Vec3& X) { return X.z() > 0.1 * (1.0 - part); });
}

inline VoxelVolume cube_volume(int across, CubeTissue tissue) {
  const double spacing = 0.1 / across;
  if (tissue == CubeTissue::kUniform) return box_volume(Vec3::Constant(0.1), spacing);
  std::mt19937 generator(1);
  return labelled_volume(Vec3i::Constant(across), spacing, spacing, Pose::Identity(), [&](const Vec3& X) {
    return tissue == CubeTissue::kLayers ? static_cast<int>(X.z() / spacing) / 4 % 2 == 0
                                         : generator() % 2 == 0;
  });
}

/// @param cut part of the height that is cut, from the top
inline ElasticModel cube_model(int across, CubeTissue tissue, double cut, double poisson_ratio) {
  VoxelVolume volume = cube_volume(across, tissue);
  if (cut > 0.0) sever_half(volume, cut);
  const Material soft_tissue{-1, 1e4, poisson_ratio, 1060.0}, stiff_tissue{-1, 1e6, poisson_ratio, 1060.0};
  const auto materials = tissue == CubeTissue::kUniform ? std::vector<Material>{soft_tissue}
                                                        : two_materials(soft_tissue, stiff_tissue);
  return {volume, 0, materials, ElementKind::kIncompatibleModes, Kinematics::kCorotational};
}

/// Solves for what the weight does to a cube at rest, to 1e-4 of its load.
/// @return iterations of conjugate gradients; INT_MAX: they did not get there
inline int count_iterations(const ElasticModel& model) {
  ThreadPool pool(1);
  Multigrid multigrid(pool);
  const HeldNodes held = hold_bottom(model.mesh());
  const std::vector<PointConstraint> none;
  const LinearSystem system(multigrid, model, model.rotations(model.mesh().rest()),
                            {Eigen::VectorXd::Zero(model.mesh().node_count()), 1.0, &none}, held.nodes,
                            Precision::kSingle);
  NodeField dx = NodeField::Zero(3, model.mesh().node_count());
  const SolveReport report = ConjugateGradients().solve(system, Vec3(0, 0, -0.1) * model.mass().transpose(),
                                                        dx, {1e-4, 500, model.mesh().block_size().mean()});
  return report.converged ? report.iterations : std::numeric_limits<int>::max();
}

}  // namespace cfem_cutting
