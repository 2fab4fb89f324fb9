#pragma once

#include <vector>

#include "element_batches.h"

namespace cfem_cutting {

using SingleField = Eigen::Matrix3Xf;  ///< a node field in single precision

/// The product Σ R K Rᵀ p over the elements of a level, matrix-free: elements go through the kernel in
/// batches of SIMD lanes, and each node then adds up the entries of its elements in a fixed order.
class ElementProduct {
 public:
  explicit ElementProduct(ThreadPool& pool) : pool_(&pool) {}

  /// Takes over the elements. All rotations are the identity then.
  void arrange(ElementSet elements);

  /// @param rotations of the elements
  void rotate(std::vector<Mat3> rotations);

  const ElementSet& elements() const { return elements_; }
  const std::vector<Mat3>& rotations() const { return rotations_; }
  ThreadPool& pool() const { return *pool_; }

  /// y = Σ R K Rᵀ p, in the precision of its arguments
  void apply(const SingleField& p, SingleField& y) const;
  void apply(const NodeField& p, NodeField& y) const;

  /// Diagonal 3 × 3 blocks of Σ K, at rest, N/m.
  std::vector<Mat3> diagonal_at_rest() const;

  /// The rotation of an element at each node: that of the first one there.
  const Mat3& rotation_at(int node) const { return rotations_[batches_.first_element[node]]; }

 private:
  /// Arrays for the kernel in one precision.
  template <typename Scalar>
  struct Packed {
    std::vector<Scalar> stiffness;
    std::vector<std::size_t> stiffness_of_batch;  // offsets
    std::vector<Scalar> rotations;                // (|batches| × 9 × lanes)
    std::vector<Scalar> products;                 // (|batches| × 24 × lanes)
    bool stiffness_fits = false, rotations_fit = false;
  };
  template <typename Scalar>
  void pack_stiffness(Packed<Scalar>& packed) const;
  template <typename Scalar>
  void pack_rotations(Packed<Scalar>& packed) const;
  template <typename Scalar>
  void multiply_all(const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>& p,
                    Eigen::Matrix<Scalar, 3, Eigen::Dynamic>& y, Packed<Scalar>& packed) const;

  ThreadPool* pool_;
  ElementSet elements_;
  std::vector<Mat3> rotations_;
  ElementBatches batches_;
  mutable Packed<float> single_;
  mutable Packed<double> double_;
};

}  // namespace cfem_cutting
