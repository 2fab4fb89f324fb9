#include "cfem_cutting/elasticity/composite_mesh.h"

#include <algorithm>
#include <cassert>
#include <tuple>

#include "union_find.h"

namespace cfem_cutting {
namespace {

Vec3i corner_bits(int n) { return {n & 1, (n >> 1) & 1, (n >> 2) & 1}; }

Vec3i smallest_index(const VoxelVolume& volume) {
  Vec3i smallest = volume.lattice().size;
  for (const Voxel& voxel : volume.voxels()) smallest = smallest.cwiseMin(voxel.index);
  return smallest;
}

/// Calls f(v, w) once for every pair of joined voxels: by an intact link, or as hosted voxel and host.
template <typename Function>
void for_each_joint(const VoxelVolume& volume, const Function& f) {
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    const Voxel& voxel = volume.voxel(v);
    if (!voxel.linked()) {
      f(v, voxel.host);
      continue;
    }
    for (int upward = 1; upward < kDirections; upward += 2)
      if (voxel.link[upward] == LinkState::kIntact) f(v, voxel.neighbour[upward]);
  }
}

/// The block of each voxel; a hosted voxel counts as part of its host's block (aggregation; Badia, Verdugo
/// and Martín 2018). An element of its own would be a sliver, and hang on a hinge where it touches the host's
/// block at an edge.
std::vector<Vec3i> assign_blocks(const VoxelVolume& volume, const CompositeMesh& mesh) {
  std::vector<Vec3i> block;
  block.reserve(volume.voxels().size());
  for (const Voxel& voxel : volume.voxels())
    block.push_back(mesh.block_of(voxel.linked() ? voxel.index : volume.voxel(voxel.host).index));
  return block;
}

/// Root voxel of the component inside its block, per voxel.
std::vector<int> components_in_blocks(const VoxelVolume& volume, const std::vector<Vec3i>& block) {
  UnionFind sets(static_cast<int>(block.size()));
  for_each_joint(volume, [&](int v, int w) {
    if (block[v] == block[w]) sets.unite(v, w);
  });
  std::vector<int> root(block.size());
  for (std::size_t v = 0; v < root.size(); ++v) root[v] = sets.find(static_cast<int>(v));
  return root;
}

/// Voxels in the order of their elements: by block (z, y, x), then by the component's first voxel.
std::vector<int> sort_by_element(const std::vector<Vec3i>& block, const std::vector<int>& root) {
  std::vector<int> order(root.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int v) {
    return std::make_tuple(block[v].z(), block[v].y(), block[v].x(), root[v], v);
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  return order;
}

/// Unites the private nodes of two elements that lie at the same corner positions.
void unite_shared_corners(UnionFind& nodes, int a, int b, const Vec3i& offset) {
  for (int n = 0; n < 8; ++n) {
    const Vec3i bits = corner_bits(n) - offset;
    if ((bits.array() < 0).any() || (bits.array() > 1).any()) continue;
    nodes.unite(8 * a + n, 8 * b + bits.x() + 2 * (bits.y() + 2 * bits.z()));
  }
}

/// Numbers the united private nodes by their first occurrence.
/// @return the number of nodes
int number_nodes(UnionFind& sets, std::vector<CompositeElement>& elements) {
  std::vector<int> number(8 * elements.size(), -1);
  int count = 0;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    for (int n = 0; n < 8; ++n) {
      int& of_root = number[sets.find(static_cast<int>(8 * e) + n)];
      if (of_root < 0) of_root = count++;
      elements[e].nodes[n] = of_root;
    }
  }
  return count;
}

}  // namespace

Vec3 Embedding::apply(const NodeField& field) const {
  Vec3 sum = Vec3::Zero();
  for (int n = 0; n < 8; ++n) sum += weights[n] * field.col(nodes[n]);
  return sum;
}

CompositeMesh::CompositeMesh(const VoxelVolume& volume, int level)
    : level_(level),
      first_voxel_(smallest_index(volume)),
      block_size_(volume.lattice().spacing * (1 << level)),
      element_of_voxel_(volume.voxels().size(), -1) {
  const std::vector<Vec3i> block = assign_blocks(volume, *this);
  const std::vector<int> root = components_in_blocks(volume, block);
  for (int v : sort_by_element(block, root)) {
    const bool starts_element = elements_.empty() || root[elements_.back().voxels.front()] != root[v];
    if (starts_element) elements_.push_back({block[v], {}, {}});
    elements_.back().voxels.push_back(v);
    element_of_voxel_[v] = static_cast<int>(elements_.size()) - 1;
  }

  UnionFind nodes(static_cast<int>(8 * elements_.size()));
  for_each_joint(volume, [&](int v, int w) {
    const int a = element_of_voxel_[v], b = element_of_voxel_[w];
    if (a != b) unite_shared_corners(nodes, a, b, elements_[b].block - elements_[a].block);
  });
  rest_.resize(3, number_nodes(nodes, elements_));
  for (const CompositeElement& element : elements_)
    for (int n = 0; n < 8; ++n)
      rest_.col(element.nodes[n]) =
          volume.lattice().corner(first_voxel_ + (element.block + corner_bits(n)) * (1 << level));
}

Embedding CompositeMesh::embed_in_element(int element, const Vec3& X) const {
  Embedding embedding;
  embedding.element = element;
  embedding.nodes = elements_[element].nodes;
  const Vec3 t = (X - block_corner(element)).cwiseQuotient(block_size_);
  for (int n = 0; n < 8; ++n) {
    const Vec3i bits = corner_bits(n);
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis) weight *= bits[axis] ? t[axis] : 1.0 - t[axis];
    embedding.weights[n] = weight;
  }
  return embedding;
}

std::vector<int> parent_nodes(const CompositeMesh& before, const CompositeMesh& after) {
  assert(before.level() == after.level());
  std::vector<int> parent(after.node_count(), -1);
  for (const CompositeElement& element : after.elements()) {
    const CompositeElement& old = before.elements()[before.element_of_voxel(element.voxels.front())];
    for (int n = 0; n < 8; ++n) parent[element.nodes[n]] = old.nodes[n];
  }
  return parent;
}

}  // namespace cfem_cutting
