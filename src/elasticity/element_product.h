#pragma once

#include <vector>

#include "node_block.h"
#include "packed_stiffness.h"

namespace cfem_cutting {

/// A node field in single precision, of quads: three coordinates and a zero.
using Quad = Eigen::Vector4f;
using SingleField = Eigen::Matrix<float, 4, Eigen::Dynamic>;
inline Quad* quads_of(SingleField& field) { return reinterpret_cast<Quad*>(field.data()); }
inline const Quad* quads_of(const SingleField& field) { return reinterpret_cast<const Quad*>(field.data()); }
SingleField to_quads(const NodeField& field);
void to_quads(const NodeField& field, ThreadPool& pool, SingleField& quads);
NodeField from_quads(const SingleField& field);

/// The product Σ R K Rᵀ p over the elements of a level, matrix-free: tile by tile elements go through the
/// kernel in batches of SIMD lanes, and each node adds up what its elements give it in a fixed order.
class ElementProduct {
 public:
  explicit ElementProduct(ThreadPool& pool) : pool_(&pool) {}

  /// Takes over the elements. All rotations are the identity then.
  void arrange(ElementsPointer elements);

  /// @param rotations of the elements; exchanged for the last ones
  void rotate(std::vector<Mat3>&& rotations);

  const TiledElements& elements() const { return *elements_; }
  const std::vector<Mat3>& rotations() const { return rotations_; }
  ThreadPool& pool() const { return *pool_; }

  /// Calls finish(node, Σ R K Rᵀ p there) for each node, on several threads. It may change p there.
  template <typename Finish>
  void apply(const SingleField& p, const Finish& finish) const {
    fit(single_);
    elements_->tiles.sum_up<float>(
        *pool_, [&](int b, float* y) { multiply(batch(single_, b, p.data(), y)); }, finish);
  }

  template <typename Finish>
  void apply(const NodeField& p, const Finish& finish) const {
    fit(double_);
    Eigen::Matrix4Xd quads = Eigen::Matrix4Xd::Zero(4, p.cols());
    quads.topRows<3>() = p;
    elements_->tiles.sum_up<double>(
        *pool_, [&](int b, double* y) { multiply(batch(double_, b, quads.data(), y)); }, finish);
  }

  void apply(const SingleField& p, SingleField& y) const;  ///< y = Σ R K Rᵀ p

  /// The nodes' 3 × 3 blocks of Σ R K Rᵀ, N/m, as of the last update.
  const std::vector<NodeBlock>& diagonal() const { return diagonal_; }

  /// Brings the blocks up to date within kDiagonalTurn: until an element has turned by more, they stay. (So
  /// what a solve makes of them depends, within its tolerance, on the solves before.)
  /// @return whether they changed
  bool update_diagonal();
  static constexpr double kDiagonalTurn = 0.05;  ///< rad

 private:
  /// Arrays for the kernel in one precision.
  template <typename Scalar>
  struct Packed {
    PackedStiffness<Scalar> stiffness;
    std::vector<Scalar> rotations;  // (|batches| × 3 × lanes), Rodrigues parameters
    bool stiffness_fits = false, rotations_fit = false;
  };
  template <typename Scalar>
  void fit(Packed<Scalar>& packed) const;
  template <typename Scalar>
  void pack_rotations(std::vector<Scalar>& packed) const;
  bool has_turned() const;
  void find_diagonal();
  template <typename Scalar>
  ElementBatch<Scalar> batch(const Packed<Scalar>& packed, int b, const Scalar* p, Scalar* y) const {
    return {packed.stiffness.form(b),
            packed.stiffness.of_batch(b),
            packed.rotations.data() + static_cast<std::size_t>(b) * 3 * kLanes,
            elements_->tiles.nodes_of(b),
            p,
            y};
  }

  ThreadPool* pool_;
  ElementsPointer elements_;
  std::vector<Mat3> rotations_;
  mutable Packed<float> single_;
  mutable Packed<double> double_;
  std::vector<NodeBlock> diagonal_;
  std::vector<float> diagonal_rotations_;  // packed, of diagonal_
};

}  // namespace cfem_cutting
