#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "element_kernel.h"
#include "element_set.h"
#include "thread_pool.h"

namespace cfem_cutting {

/// Elements in tiles, each of them compact in space and small enough for the cache, and a tile's elements in
/// batches of SIMD lanes: those with one matrix together, then the others. What elements give their nodes is
/// added up tile by tile, and at last for the nodes on borders between tiles; always in the same order.
class ElementTiles {
 public:
  struct Batch {
    int first;    ///< in element_of_lane
    int count;    ///< ≤ kLanes
    bool shared;  ///< all have one matrix
  };

  ElementTiles() = default;
  explicit ElementTiles(const ElementSet& elements);

  int size() const { return static_cast<int>(batches.size()); }
  const int* nodes_of(int batch) const { return nodes.data() + static_cast<std::size_t>(batch) * 8 * kLanes; }

  /// Calls work(batch) for all batches, on several threads.
  template <typename Work>
  void for_each(ThreadPool& pool, const Work& work) const {
    pool.for_range(size(), kFewest / kLanes, [&](int begin, int end) {
      for (int b = begin; b < end; ++b) work(b);
    });
  }

  /// Calls work(batch, out), which writes what its elements give their nodes (see ElementBatch::y), and then
  /// finish(node, sum) for each node. When a node is finished, no element needs its values any more.
  template <typename Scalar, typename Work, typename Finish>
  void sum_up(ThreadPool& pool, const Work& work, const Finish& finish) const {
    std::vector<QuadOf<Scalar>> border(border_count_);
    pool.for_range(static_cast<int>(tiles_.size()), kFewest / kTile, [&](int begin, int end) {
      thread_local std::vector<Line<Scalar>> lines;
      for (int t = begin; t < end; ++t) {
        const Tile& tile = tiles_[t];
        lines.resize(static_cast<std::size_t>(tile.end_batch - tile.first_batch) * kEntries / kLanes);
        Scalar* const out = lines.data()->data();
        for (int b = tile.first_batch; b < tile.end_batch; ++b)
          work(b, out + static_cast<std::size_t>(b - tile.first_batch) * kEntries);
        for (int i = tile.first_node; i < tile.first_border; ++i) finish(node_[i], sum_of_slots(out, i));
        for (int i = tile.first_border; i < tile.end_node; ++i) border[node_[i]] = sum_of_slots(out, i);
      }
    });
    pool.for_range(static_cast<int>(border_node_.size()), kFewest, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) finish(border_node_[i], sum_of_entries(border, i));
    });
  }

  static constexpr int kFewest = 2048;  ///< elements or nodes worth waking a thread for

  std::vector<Batch> batches;
  std::vector<int> element_of_lane;  ///< batch by batch
  std::vector<int> nodes;            ///< (|batches| × 8 × lanes)
  std::vector<int> first_element;    ///< per node: the first element there

 private:
  static constexpr int kTile = 1024;            // elements
  static constexpr int kEntries = 32 * kLanes;  // of a batch

  template <typename Scalar>
  struct alignas(64) Line : std::array<Scalar, kLanes> {};

  template <typename Scalar>
  using QuadOf = Eigen::Matrix<Scalar, 4, 1>;

  template <typename Scalar>
  QuadOf<Scalar> sum_of_slots(const Scalar* quads, int i) const {
    QuadOf<Scalar> sum = QuadOf<Scalar>::Zero();
    for (int s = first_slot_[i]; s < first_slot_[i + 1]; ++s)
      sum += QuadOf<Scalar>::MapAligned(quads + 4 * std::size_t{slots_[s]});
    return sum;
  }

  template <typename Quads>
  typename Quads::value_type sum_of_entries(const Quads& border, int i) const {
    typename Quads::value_type sum = border[border_entry_[first_entry_[i]]];
    for (int e = first_entry_[i] + 1; e < first_entry_[i + 1]; ++e) sum += border[border_entry_[e]];
    return sum;
  }

  struct Tile {
    int first_batch, end_batch;
    int first_node, first_border, end_node;  // in node_: nodes of this tile alone, then the others
  };

  void add_batches(const std::vector<int>& elements, bool shared);
  void add_tile(const ElementSet& elements, const std::vector<int>& of_tile);
  void add_nodes(const ElementSet& elements, const NodeCorners& at, const std::vector<int>& tile_of_element);
  void add_borders(int node_count);

  std::vector<Tile> tiles_;
  std::vector<int> node_;             // per tile; beyond first_border: entries of the border
  std::vector<int> first_slot_;       // (|node_| + 1) into slots_
  std::vector<std::uint16_t> slots_;  // quads of a tile's batches
  int border_count_ = 0;
  std::vector<int> border_node_;
  std::vector<int> first_entry_, border_entry_;  // (|border_node_| + 1) into entries of the border
};

}  // namespace cfem_cutting
