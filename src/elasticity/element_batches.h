#pragma once

#include <vector>

#include "element_kernel.h"
#include "element_set.h"
#include "thread_pool.h"

namespace cfem_cutting {

/// Elements in batches of SIMD lanes: those with one matrix together, then the others.
struct ElementBatches {
  struct Batch {
    int first;    ///< in element_of_lane
    int count;    ///< ≤ kLanes
    bool shared;  ///< all have one matrix
  };

  ElementBatches() = default;
  explicit ElementBatches(const ElementSet& elements);

  int size() const { return static_cast<int>(batches.size()); }
  const int* nodes_of(int batch) const { return nodes.data() + static_cast<std::size_t>(batch) * 8 * kLanes; }

  /// Calls work(batch) for all batches, on several threads.
  template <typename Work>
  void for_each(ThreadPool& pool, const Work& work) const {
    pool.for_range(size(), kFewest / kLanes, [&](int begin, int end) {
      for (int b = begin; b < end; ++b) work(b);
    });
  }

  /// y_node = Σ of the node's entries in `products` (|batches| × 24 × lanes), in a fixed order.
  template <typename Scalar>
  void add_up(ThreadPool& pool, const std::vector<Scalar>& products,
              Eigen::Matrix<Scalar, 3, Eigen::Dynamic>& y) const {
    y.resize(3, static_cast<Eigen::Index>(first_slot.size()) - 1);
    pool.for_range(static_cast<int>(y.cols()), kFewest, [&](int begin, int end) {
      for (int node = begin; node < end; ++node) {
        Scalar sum[3] = {};
        for (int s = first_slot[node]; s < first_slot[node + 1]; ++s) {
          const Scalar* entry = products.data() + slots[s];
          for (int i = 0; i < 3; ++i) sum[i] += entry[i * kLanes];
        }
        for (int i = 0; i < 3; ++i) y(i, node) = sum[i];
      }
    });
  }

  static constexpr int kFewest = 2048;          ///< elements or nodes worth waking a thread for
  static constexpr int kEntries = 24 * kLanes;  ///< of a batch in `products`

  std::vector<Batch> batches;
  std::vector<int> element_of_lane;  ///< batch by batch
  std::vector<int> nodes;            ///< (|batches| × 8 × lanes)
  std::vector<int> first_slot;       ///< (|nodes| + 1) into slots
  std::vector<int> slots;            ///< offsets of x entries in `products`
  std::vector<int> first_element;    ///< per node: the first element there

 private:
  void add(const std::vector<int>& elements, bool shared);
};

}  // namespace cfem_cutting
