#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "element_kernel.h"
#include "element_set.h"
#include "thread_pool.h"

namespace cfem_cutting {

/// Elements in tiles small enough for the cache, and a tile's elements in batches of SIMD lanes: those with
/// one matrix together, then the others. What elements give their nodes is added up tile by tile, and at last
/// for the nodes on borders between tiles; always in the same order. Borders are short if elements that are
/// near each other in the set are near each other in space.
class ElementTiles {
 public:
  struct Batch {
    int first;    ///< in element_of_lane
    int count;    ///< ≤ kLanes
    bool shared;  ///< all have one matrix
  };

  ElementTiles() = default;
  ElementTiles(const ElementSet& elements, const NodeCorners& at);

  /// Elements of a tile, at most.
  static int tile_size(int elements) {
    return std::clamp(elements / 16, std::clamp(elements / 4, kTile / 16, kTile / 4), kTile);
  }

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
    thread_local std::vector<QuadOf<Scalar>> border;  // the caller's, for all threads
    if (border.size() < border_sums_.nodes.size()) border.resize(border_sums_.nodes.size());
    QuadOf<Scalar>* const on_border = border.data();
    pool.for_range(
        static_cast<int>(tiles_.size()), std::max(1, kFewest / tile_size_), [&](int begin, int end) {
          thread_local std::vector<Line<Scalar>> lines;
          for (int t = begin; t < end; ++t) {
            const Tile& tile = tiles_[t];
            const std::size_t needed =
                static_cast<std::size_t>(tile.end_batch - tile.first_batch) * kEntries / kLanes;
            if (lines.size() < needed) lines.resize(needed);
            Scalar* const out = lines.data()->data();
            for (int b = tile.first_batch; b < tile.end_batch; ++b)
              work(b, out + static_cast<std::size_t>(b - tile.first_batch) * kEntries);
            const auto* quads = reinterpret_cast<const QuadOf<Scalar>*>(out);
            inner_sums_.finish(quads, tile.inner, tile.end_inner, finish);
            border_sums_.finish(quads, tile.border, tile.end_border,
                                [on_border](int entry, const auto& sum) { on_border[entry] = sum; });
          }
        });
    pool.for_range(static_cast<int>(total_sums_.nodes.size()), kFewest,
                   [&](int begin, int end) { total_sums_.finish(on_border, begin, end, finish); });
  }

  static constexpr int kFewest = 512;  ///< elements or nodes worth waking a thread for

  std::vector<Batch> batches;
  std::vector<int> element_of_lane;  ///< batch by batch
  std::vector<int> nodes;            ///< (|batches| × 8 × lanes)

 private:
  static constexpr int kTile = 2048;            // elements, at most
  static constexpr int kEntries = 32 * kLanes;  // of a batch

  template <typename Scalar>
  struct alignas(64) Line : std::array<Scalar, kLanes> {};

  template <typename Scalar>
  using QuadOf = Eigen::Matrix<Scalar, 4, 1>;

  /// Sums of quads, one a node.
  template <typename Index>
  struct Sums {
    std::vector<int> nodes;
    std::vector<int> first{0};  // (|nodes| + 1) into terms
    std::vector<Index> terms;

    /// Adds a term to the last sum, or to a new one.
    void add(int node, bool anew, Index term) {
      if (anew) {
        nodes.push_back(node);
        first.push_back(first.back());
      }
      terms.push_back(term);
      ++first.back();
    }

    /// Calls finish(node, sum) for nodes [begin, end). Copies of pointers and of `finish` stay in registers.
    template <typename Quad, typename Finish>
    void finish(const Quad* quads, int begin, int end, Finish finish) const {
      const int* const node = nodes.data();
      const int* const last = first.data() + 1;
      const Index* term = terms.data() + first[begin];
      for (int i = begin; i < end; ++i) {
        const Index* const stop = terms.data() + last[i];
        finish(node[i], stop - term == 8 ? sum_of_eight(quads, term) : sum_of(quads, term, stop));
        term = stop;
      }
    }

   private:
    template <typename Quad>
    static Quad sum_of(const Quad* quads, const Index* term, const Index* stop) {
      Quad sum = quads[*term];
      while (++term != stop) sum += quads[*term];
      return sum;
    }

    /// Most nodes are corners of eight elements.
    template <typename Quad>
    static Quad sum_of_eight(const Quad* quads, const Index* term) {
      const auto pair = [&](int i) { return quads[term[i]] + quads[term[i + 1]]; };
      return (pair(0) + pair(2)) + (pair(4) + pair(6));
    }
  };

  struct Tile {
    int first_batch, end_batch;
    int inner = 0, end_inner = 0;    // in inner_sums_: nodes of this tile alone
    int border = 0, end_border = 0;  // in border_sums_: the others
  };

  void add_batches(const std::vector<int>& elements, bool shared);
  void add_tile(const ElementSet& elements, int begin, int end);
  std::vector<std::uint16_t> slots_of_corners(const ElementSet& elements) const;
  void add_nodes(const ElementSet& elements, const NodeCorners& at);
  void add_totals(int node_count);

  int tile_size_ = kTile;
  std::vector<Tile> tiles_;
  Sums<std::uint16_t> inner_sums_, border_sums_;  // of a tile's quads
  Sums<int> total_sums_;                          // of border_sums_, in order
};

/// Elements, where they meet, and their tiles, which several users of a mesh share.
struct TiledElements {
  explicit TiledElements(ElementSet elements) : set(std::move(elements)), corners(set), tiles(set, corners) {}
  const ElementSet set;
  const NodeCorners corners;
  const ElementTiles tiles;
};
using ElementsPointer = std::shared_ptr<const TiledElements>;

}  // namespace cfem_cutting
