#pragma once
/// Rest matrices of composite hexahedra, integrated over the filled part of their voxels.

#include <array>
#include <vector>

#include "rest_matrix.h"

namespace cfem_cutting {

using MeanGradient = Eigen::Matrix<double, 3, 8>;

/// What an element needs at rest.
struct ElementData {
  RestMatrix stiffness;
  MeanGradient mean_gradient;        ///< 1/m, of the shape functions over the filled volume
  Eigen::Matrix<double, 8, 1> mass;  ///< kg, row sums
};

/// Weights (m³) of a quadrature at the block's 3 × 3 × 3 points {0, ½, 1}³. All integrands here are quadratic
/// along each axis, so that any set of samples has weights at these points that give the same sums: an
/// element costs 27 products, however many voxels and samples it has (moment fitting; Müller, Kummer and
/// Oberlack 2013).
using BlockWeights = Eigen::Matrix<double, 27, 1>;

/// Weights of one voxel at position `sub` of its block of 2^level voxels an edge: exact where the voxel is
/// full, else those of its filled samples.
BlockWeights voxel_weights(const Vec3i& sub, int level, const Fill& fill, double block_volume);

/// Assembles elements of one block size from their weights.
class ElementAssembler {
 public:
  ElementAssembler(const Vec3& block_size, const std::vector<Material>& materials, ElementKind kind);

  /// @param weights one per material
  /// @param mass_weights the same, with tissue beside the block moved into it: extrapolated shape functions
  /// would give negative masses
  ElementData assemble(const std::vector<BlockWeights>& weights,
                       const std::vector<BlockWeights>& mass_weights) const;

 private:
  static constexpr int kFunctions = 8 + 3;  // shape functions, Wilson's modes
  static constexpr int kColumns = 3 * kFunctions;
  static constexpr int kModes = 9;
  using StrainMatrix = Eigen::Matrix<double, 6, kColumns>;
  using Elasticity = Eigen::Matrix<double, 6, 6>;
  using FullMatrix = Eigen::Matrix<double, kColumns, kColumns>;
  struct Sums;

  Sums integrate(const std::vector<BlockWeights>& weights) const;
  ElementMatrix condense(const Sums& sums) const;
  void prepare_stabilisation();

  std::vector<Material> materials_;
  ElementKind kind_;
  double block_volume_;                       // m³
  std::vector<ElementMatrix> stabilisation_;  // N/m, per material; for a wholly filled block
  std::array<StrainMatrix, 27> strain_;       // 1/m
  std::array<Eigen::Matrix<double, 8, 1>, 27> shape_;
  std::array<Eigen::Matrix<double, 3, 8>, 27> gradient_;  // 1/m
  std::vector<Elasticity> elasticity_;                    // Pa, per material
  std::vector<Eigen::MatrixXd> products_;  // Pa/m², (1089 × 27) per material: BᵀCB at each point
};

}  // namespace cfem_cutting
