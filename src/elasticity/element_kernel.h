#pragma once

#include <vector>

namespace cfem_cutting {

/// Elements in one batch, one a SIMD lane.
constexpr int kLanes = 16;

/// How a batch has its matrices.
enum class MatrixForm {
  kMirrored,   ///< one, symmetric under reflections of the block: see MirroredMatrix, kMirroredMatrix entries
  kWhole,      ///< one, column by column: kWholeMatrix entries
  kTriangles,  ///< one a lane, its lower triangle column by column: (kTriangle × 16) entries
  kDeformations  ///< one a lane, see DeformationMatrix: (3 × 16) ratios, (kDeformationTriangle × 16) entries
                 ///< of its lower triangle, (8 × 6 × 16) of each node's block of K
};
constexpr int kMirroredMatrix = 8 * 9;
constexpr int kWholeMatrix = 24 * 24;
constexpr int kTriangle = 24 * 25 / 2;
constexpr int kDeformationTriangle = 18 * 19 / 2;
constexpr int kDeformationMatrix = 3 + kDeformationTriangle + 8 * 6;

/// Where lane l stands among the quads of a node in ElementBatch::y.
constexpr int place_of_lane(int l) { return 4 * (l % 4) + l / 4; }

/// One batch of element products y = R K Rᵀ x. Node values are quads: three coordinates and a zero.
template <typename Scalar>
struct ElementBatch {
  MatrixForm form;
  const Scalar* stiffness;
  const Scalar* rotation;  ///< (3 × 16), rodrigues_parameters of R: parameter i of lane l at [16 i + l]
  const int* nodes;        ///< (8 × 16), lane-major
  const Scalar* x;         ///< (4 × |nodes|), node by node
  Scalar* y;               ///< (8 × 16 × 4): node n of lane l at [4 (16 n + place_of_lane(l))]
};

/// Multiplication for one instruction set.
struct ElementKernel {
  const char* name;
  void (*single)(const ElementBatch<float>&);
  void (*precise)(const ElementBatch<double>&);
  void (*diagonal)(const ElementBatch<float>&, bool beside);
};

/// Those that this processor can run, the widest first.
const std::vector<ElementKernel>& element_kernels();

/// Multiplies a batch with the widest instructions that this processor has.
void multiply(const ElementBatch<float>& batch);
void multiply(const ElementBatch<double>& batch);

/// Instead of a product writes to y, for each node, entries of its 3 × 3 block of R K Rᵀ: the diagonal, or
/// those beside it, (1, 2), (0, 2) and (0, 1).
void find_diagonal(const ElementBatch<float>& batch, bool beside);

}  // namespace cfem_cutting
