#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "element_tiles.h"
#include "thread_pool.h"

namespace cfem_cutting {

/// Weighted sums of values at other nodes: row i of a sparse matrix. In a block of half the size all weights
/// are powers of two, and so take little memory.
struct Interpolation {
  struct Term {
    std::uint32_t node : 30, halvings : 2;
    float weight() const {
      constexpr std::array<float, 4> kPowers{1.0f, 0.5f, 0.25f, 0.125f};
      return kPowers[halvings];
    }
  };
  std::vector<int> first{0};  ///< (|rows| + 1)
  std::vector<Term> terms;

  struct Row {
    const Term *first, *last;
    const Term* begin() const { return first; }
    const Term* end() const { return last; }
  };

  int rows() const { return static_cast<int>(first.size()) - 1; }
  Row row(int i) const { return {terms.data() + first[i], terms.data() + first[i + 1]}; }
  Interpolation transposed(int columns) const;

  /// y_i = Σ w x
  void apply(ThreadPool& pool, const Eigen::Matrix4Xf& x, Eigen::Matrix4Xf& y) const;
};

/// The next coarser level: blocks of twice the edge, by the same rule as the composite elements. Elements
/// that lie in one coarse block and are joined by faces are one coarse element; so the two sides of a cut
/// stay apart.
struct Coarsening {
  explicit Coarsening(const TiledElements& fine);

  ElementSet coarse;            ///< without stiffness
  std::vector<int> parent;      ///< coarse element of each fine one
  Interpolation interpolation;  ///< trilinear, from coarse nodes to fine nodes
};

/// The fine elements in each coarse one.
struct ElementParts {
  ElementParts() = default;
  ElementParts(const std::vector<int>& parent, int coarse_count);
  int size() const { return static_cast<int>(first.size()) - 1; }
  std::vector<int> first{0};  ///< (|coarse| + 1) into elements
  std::vector<int> elements;  ///< of the fine level, ascending in each
};

/// Weights of a coarse element's eight nodes at corner n of the fine element at `offset` (0 or 1 an axis) in
/// it.
Eigen::Matrix<double, 8, 1> corner_weights(const Vec3i& offset, int n);

}  // namespace cfem_cutting
