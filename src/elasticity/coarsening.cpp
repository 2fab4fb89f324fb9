#include "coarsening.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "node_numbering.h"
#include "shared_face.h"

namespace cfem_cutting {
namespace {

Vec3i halved(const Vec3i& block) {
  return block.unaryExpr([](int i) { return i >> 1; });
}

/// Pairs of elements that have the four nodes of a face in common: element, its neighbour along +axis.
struct FacePair {
  int lower, upper, axis;
};

bool share_face(const ElementSet& set, int lower, int upper, int axis) {
  for (int n = 0; n < 8; ++n)
    if (!(n >> axis & 1) && set.nodes[upper][n] != set.nodes[lower][n | (1 << axis)]) return false;
  return true;
}

std::vector<FacePair> find_face_pairs(const ElementSet& set, const NodeCorners& at) {
  std::vector<FacePair> pairs;
  for (int e = 0; e < set.size(); ++e) {
    for (int axis = 0; axis < 3; ++axis) {
      const int node = set.nodes[e][1 << axis];
      for (int i = at.first[node]; i < at.first[node + 1]; ++i) {
        const int other = at.corners[i] / 8;
        const bool beside = at.corners[i] % 8 == 0 && set.block[other] - set.block[e] == Vec3i::Unit(axis);
        if (beside && share_face(set, e, other, axis)) pairs.push_back({e, other, axis});
      }
    }
  }
  return pairs;
}

/// Coarse elements are numbered by their first part.
std::vector<int> find_parents(const ElementSet& fine, const std::vector<FacePair>& pairs) {
  UnionFind sets(fine.size());
  for (const FacePair& pair : pairs)
    if (halved(fine.block[pair.lower]) == halved(fine.block[pair.upper])) sets.unite(pair.lower, pair.upper);
  std::vector<int> parent(fine.size());
  int count = 0;
  for (int e = 0; e < fine.size(); ++e) {
    const int root = sets.find(e);  // the smallest
    parent[e] = root == e ? count++ : parent[root];
  }
  return parent;
}

void unite_nodes(const std::vector<FacePair>& pairs, const std::vector<int>& parent, ElementSet& coarse) {
  UnionFind sets(8 * coarse.size());
  for (const FacePair& pair : pairs) {
    const int a = parent[pair.lower], b = parent[pair.upper];
    if (a != b) unite_at_face(sets, a, b, pair.axis);
  }
  const NodeNumbering number(sets, coarse.size());
  coarse.node_count = number.count;
  for (int c = 0; c < coarse.size(); ++c)
    std::copy_n(number.of_corner.begin() + 8 * c, 8, coarse.nodes[c].begin());
}

/// One of the coarse corners that a fine one lies between.
struct Share {
  int corner;
  std::uint32_t halvings;
};

/// Of the fine element's corner n (at 8 × octant + n).
std::array<std::vector<Share>, 64> shares_of_corners() {
  std::array<std::vector<Share>, 64> shares;
  for (int i = 0; i < 64; ++i) {
    const Eigen::Matrix<double, 8, 1> weights = corner_weights(corner_bits(i / 8), i % 8);
    for (int m = 0; m < 8; ++m)
      if (weights[m] > 0.0) shares[i].push_back({m, static_cast<std::uint32_t>(-std::ilogb(weights[m]))});
  }
  return shares;
}

Interpolation interpolate(const ElementSet& fine, const ElementSet& coarse, const std::vector<int>& parent) {
  static const std::array<std::vector<Share>, 64> shares = shares_of_corners();
  std::vector<int> corner_of_node(fine.node_count, -1);
  for (int e = fine.size() - 1; e >= 0; --e)
    for (int n = 0; n < 8; ++n) corner_of_node[fine.nodes[e][n]] = 8 * e + n;
  Interpolation sums;
  sums.first.reserve(fine.node_count + 1);
  sums.terms.reserve(4 * static_cast<std::size_t>(fine.node_count));
  for (int corner : corner_of_node) {
    const int e = corner / 8, c = parent[e];
    const Vec3i offset = fine.block[e] - 2 * coarse.block[c];
    for (const Share& share : shares[8 * (offset.x() + 2 * (offset.y() + 2 * offset.z())) + corner % 8])
      sums.terms.push_back({static_cast<std::uint32_t>(coarse.nodes[c][share.corner]), share.halvings});
    sums.first.push_back(static_cast<int>(sums.terms.size()));
  }
  return sums;
}

}  // namespace

Eigen::Matrix<double, 8, 1> corner_weights(const Vec3i& offset, int n) {
  const Vec3 t = 0.5 * (offset + corner_bits(n)).cast<double>();
  Eigen::Matrix<double, 8, 1> weights;
  for (int m = 0; m < 8; ++m) {
    const Vec3i bits = corner_bits(m);
    weights[m] = 1.0;
    for (int axis = 0; axis < 3; ++axis) weights[m] *= bits[axis] ? t[axis] : 1.0 - t[axis];
  }
  return weights;
}

Coarsening::Coarsening(const TiledElements& elements) {
  const ElementSet& fine = elements.set;
  const std::vector<FacePair> pairs = find_face_pairs(fine, elements.corners);
  parent = find_parents(fine, pairs);
  const int count = parent.empty() ? 0 : *std::max_element(parent.begin(), parent.end()) + 1;
  coarse.block.resize(count);
  coarse.nodes.resize(count);
  for (int e = 0; e < fine.size(); ++e) coarse.block[parent[e]] = halved(fine.block[e]);
  unite_nodes(pairs, parent, coarse);
  interpolation = interpolate(fine, coarse, parent);
}

ElementParts::ElementParts(const std::vector<int>& parent, int coarse_count)
    : first(coarse_count + 1, 0), elements(parent.size()) {
  for (const int c : parent) ++first[c + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> next(first.begin(), first.end() - 1);
  for (int e = 0; e < static_cast<int>(parent.size()); ++e) elements[next[parent[e]]++] = e;
}

Interpolation Interpolation::transposed(int columns) const {
  Interpolation t;
  t.first.assign(columns + 1, 0);
  for (const Term& term : terms) ++t.first[term.node + 1];
  for (int n = 0; n < columns; ++n) t.first[n + 1] += t.first[n];
  t.terms.resize(terms.size());
  std::vector<int> next(t.first.begin(), t.first.end() - 1);
  for (int i = 0; i < rows(); ++i)
    for (const Term& term : row(i))
      t.terms[next[term.node]++] = {static_cast<std::uint32_t>(i), term.halvings};
  return t;
}

void Interpolation::apply(ThreadPool& pool, const Eigen::Matrix4Xf& x, Eigen::Matrix4Xf& y) const {
  constexpr int kFewest = 256;  // rows worth waking a thread for
  y.resize(4, rows());
  pool.for_range(rows(), kFewest, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      Eigen::Vector4f even = Eigen::Vector4f::Zero(), odd = even;  // sums that do not wait for each other
      const Term *term = row(i).first, *const last = row(i).last;
      if ((last - term) % 2 == 1) {
        even = term->weight() * x.col(term->node);
        ++term;
      }
      for (; term != last; term += 2) {
        even += term[0].weight() * x.col(term[0].node);
        odd += term[1].weight() * x.col(term[1].node);
      }
      y.col(i) = even + odd;
    }
  });
}

}  // namespace cfem_cutting
