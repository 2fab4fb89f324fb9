#pragma once

namespace cfem_cutting {

/// Elements in one batch, one a SIMD lane.
constexpr int kLanes = 16;

constexpr int kWholeMatrix = 24 * 24;   ///< entries of a shared matrix, column by column
constexpr int kTriangle = 24 * 25 / 2;  ///< of the lower triangle of an own one, column by column

/// One batch of element products y = R K Rᵀ x. Arrays are lane-major: entry i of lane l at [16 i + l].
template <typename Scalar>
struct ElementBatch {
  const Scalar* stiffness;  ///< shared: kWholeMatrix; else (kTriangle × 16)
  bool shared;              ///< all lanes have one matrix
  const Scalar* rotation;   ///< (9 × 16), R row by row
  const int* nodes;         ///< (8 × 16)
  const Scalar* x;          ///< (3 × |nodes|), node by node
  Scalar* y;                ///< (24 × 16)
};

/// Multiplies a batch with the widest instructions that this processor has.
void multiply(const ElementBatch<float>& batch);
void multiply(const ElementBatch<double>& batch);

}  // namespace cfem_cutting
