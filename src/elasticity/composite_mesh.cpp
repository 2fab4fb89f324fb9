#include "cfem_cutting/elasticity/composite_mesh.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "morton.h"
#include "node_numbering.h"
#include "shared_face.h"
#include "voxel_joints.h"

namespace cfem_cutting {
namespace {

Vec3i smallest_index(const VoxelVolume& volume) {
  Vec3i smallest = volume.lattice().size;
  for (const Voxel& voxel : volume.voxels()) smallest = smallest.cwiseMin(voxel.index);
  return smallest;
}

using Joints = std::vector<std::pair<int, int>>;

/// Tissue without a linked voxel is an element of its own if it fills at least this part of its block.
constexpr double kSmallestElement = 0.1;

/// Root voxel of the component inside its block, per voxel.
std::vector<int> components_in_blocks(const Joints& joints, const std::vector<Vec3i>& block) {
  UnionFind sets(static_cast<int>(block.size()));
  for (const auto& [v, w] : joints)
    if (block[v] == block[w]) sets.unite(v, w);
  std::vector<int> root(block.size());
  for (std::size_t v = 0; v < root.size(); ++v) root[v] = sets.find(static_cast<int>(v));
  return root;
}

/// Per root whether its component can be an element: it has a linked voxel, or enough tissue and a face in
/// common with linked tissue. Others would be slivers, or hang on a hinge.
std::vector<char> sound_components(const VoxelVolume& volume, const Joints& joints,
                                   const std::vector<Vec3i>& block, const std::vector<int>& root, int level) {
  std::vector<char> sound(root.size(), 0), has_face(root.size(), 0);
  std::vector<double> filled(root.size(), 0.0);  // of a block
  for (const auto& [v, w] : joints) {
    if ((block[v] - block[w]).cwiseAbs().sum() != 1) continue;
    if (volume.voxel(w).linked()) has_face[root[v]] = 1;
    if (volume.voxel(v).linked()) has_face[root[w]] = 1;
  }
  for (std::size_t v = 0; v < root.size(); ++v) {
    const Voxel& voxel = volume.voxels()[v];
    if (voxel.linked()) sound[root[v]] = 1;
    filled[root[v]] += voxel.fill.fraction() / (1 << (3 * level));
  }
  for (std::size_t r = 0; r < root.size(); ++r)
    if (has_face[r] && filled[r] >= kSmallestElement) sound[r] = 1;
  return sound;
}

/// The block of each voxel: its own, but the voxels of unsound components count as part of their hosts'
/// blocks (aggregation; Badia, Verdugo and Martín 2018).
std::vector<Vec3i> assign_blocks(const VoxelVolume& volume, const CompositeMesh& mesh, const Joints& joints) {
  std::vector<Vec3i> block;
  block.reserve(volume.voxels().size());
  for (const Voxel& voxel : volume.voxels()) block.push_back(mesh.block_of(voxel.index));
  const std::vector<int> root = components_in_blocks(joints, block);
  const std::vector<char> sound = sound_components(volume, joints, block, root, mesh.level());
  for (std::size_t v = 0; v < block.size(); ++v)
    if (!sound[root[v]]) block[v] = mesh.block_of(volume.voxel(volume.voxels()[v].host).index);
  return block;
}

/// Roots of components, by block along Morton's curve.
std::vector<int> sort_components(const std::vector<Vec3i>& block, const std::vector<int>& root) {
  std::vector<std::pair<std::uint64_t, int>> keys;
  for (int v = 0; v < static_cast<int>(root.size()); ++v)
    if (root[v] == v) keys.emplace_back(morton_place(block[v]), v);
  std::sort(keys.begin(), keys.end());
  std::vector<int> sorted;
  sorted.reserve(keys.size());
  for (const auto& [place, v] : keys) sorted.push_back(v);
  return sorted;
}

/// Unites the private nodes of two elements that lie at the same corner positions.
void unite_shared_corners(UnionFind& nodes, int a, int b, const Vec3i& offset) {
  for (int axis = 0; axis < 3; ++axis) {
    if (offset == Vec3i::Unit(axis)) return unite_at_face(nodes, a, b, axis);
  }
  for (int n = 0; n < 8; ++n) {
    const Vec3i bits = corner_bits(n) - offset;
    if ((bits.array() < 0).any() || (bits.array() > 1).any()) continue;
    nodes.unite(8 * a + n, 8 * b + bits.x() + 2 * (bits.y() + 2 * bits.z()));
  }
}

/// Gives the elements their nodes.
/// @return for each node its first private one, as 8 e + corner
std::vector<int> number_nodes(UnionFind& sets, std::vector<CompositeElement>& elements) {
  const NodeNumbering number(sets, static_cast<int>(elements.size()));
  std::vector<int> first(number.count);
  for (int i = static_cast<int>(number.of_corner.size()) - 1; i >= 0; --i) {
    first[number.of_corner[i]] = i;
    elements[i / 8].nodes[i % 8] = number.of_corner[i];
  }
  return first;
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
  const Joints joints = voxel_joints(volume);
  const std::vector<Vec3i> block = assign_blocks(volume, *this, joints);
  const std::vector<int> root = components_in_blocks(joints, block);
  const std::vector<int> roots = sort_components(block, root);
  elements_.reserve(roots.size());
  for (const int v : roots) {
    element_of_voxel_[v] = static_cast<int>(elements_.size());
    elements_.push_back({block[v], {}, {}});
  }
  for (int v = 0; v < static_cast<int>(root.size()); ++v) {
    element_of_voxel_[v] = element_of_voxel_[root[v]];
    elements_[element_of_voxel_[v]].voxels.push_back(v);
  }

  UnionFind nodes(static_cast<int>(8 * elements_.size()));
  for (const auto& [v, w] : joints) {
    const int a = element_of_voxel_[v], b = element_of_voxel_[w];
    if (a != b) unite_shared_corners(nodes, a, b, elements_[b].block - elements_[a].block);
  }
  const std::vector<int> first = number_nodes(nodes, elements_);
  rest_.resize(3, static_cast<Eigen::Index>(first.size()));
  for (std::size_t node = 0; node < first.size(); ++node)
    rest_.col(static_cast<Eigen::Index>(node)) = volume.lattice().corner(
        first_voxel_ + (elements_[first[node] / 8].block + corner_bits(first[node] % 8)) * (1 << level));
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
    // A hosted voxel can have come from a neighbouring block.
    const auto stayed = std::find_if(element.voxels.begin(), element.voxels.end(), [&](int v) {
      return before.elements()[before.element_of_voxel(v)].block == element.block;
    });
    assert(stayed != element.voxels.end());
    const CompositeElement& old = before.elements()[before.element_of_voxel(*stayed)];
    for (int n = 0; n < 8; ++n) parent[element.nodes[n]] = old.nodes[n];
  }
  return parent;
}

}  // namespace cfem_cutting
