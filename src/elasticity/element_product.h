#pragma once

#include <vector>

#include "cfem_cutting/elasticity/elastic_model.h"
#include "thread_pool.h"

namespace cfem_cutting {

/// Single precision for speed; double where a tolerance below single precision is asked for.
enum class Precision { kSingle, kDouble };

/// The product Σ R K Rᵀ p over all elements of a model, matrix-free: elements go through the kernel in
/// batches of SIMD lanes, and each node then adds up the entries of its elements in a fixed order.
class ElementProduct {
 public:
  explicit ElementProduct(ThreadPool& pool) : pool_(pool) {}

  /// Takes over the model's matrices (unless it has them already) and these rotations.
  void set(const ElasticModel& model, std::vector<Mat3> rotations, Precision precision);

  /// y = Σ R K Rᵀ p
  void apply(const NodeField& p, NodeField& y, Precision precision) const;

  /// Diagonal 3 × 3 blocks of Σ R K Rᵀ, N/m.
  std::vector<Mat3> diagonal_blocks(const ElasticModel& model) const;

 private:
  /// Arrays for the kernel in one precision.
  template <typename Scalar>
  struct Packed {
    std::uint64_t version = 0;
    std::vector<Scalar> stiffness;
    std::vector<Scalar> rotations;  // (|batches| × 9 × lanes)
    mutable std::vector<Scalar> x;  // (3 × |nodes|)
    mutable std::vector<Scalar> y;  // (|batches| × 24 × lanes)
  };
  struct Batch {
    int first;  // in element_of_lane_
    int count;  // ≤ lanes
    bool shared;
    std::size_t stiffness;  // offset in Packed::stiffness
  };

  void arrange(const ElasticModel& model);
  void add_batches(const std::vector<int>& elements, bool shared);
  void connect_nodes(const CompositeMesh& mesh);
  template <typename Scalar>
  void pack_stiffness(const ElasticModel& model, Packed<Scalar>& packed) const;
  template <typename Scalar>
  void pack_rotations(Packed<Scalar>& packed) const;
  template <typename Scalar>
  void multiply_batches(const NodeField& p, NodeField& y, const Packed<Scalar>& packed) const;

  ThreadPool& pool_;
  std::uint64_t version_ = 0;
  std::vector<Mat3> rotations_;
  std::vector<Batch> batches_;
  std::size_t stiffness_count_ = 0;
  std::vector<int> element_of_lane_;         // batch by batch
  std::vector<int> nodes_;                   // (|batches| × 8 × lanes)
  std::vector<int> first_slot_;              // (|nodes| + 1) into slots_
  std::vector<int> slots_;                   // offsets of x entries in Packed::y
  std::vector<int> element_corner_of_slot_;  // 8 e + n, as slots_
  Packed<float> single_;
  Packed<double> double_;
};

}  // namespace cfem_cutting
