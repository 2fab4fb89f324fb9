#pragma once

#include <array>
#include <vector>

#include "cfem_cutting/volume/voxel_volume.h"

namespace cfem_cutting {

/// (3 × |nodes|), m (positions, displacements), m/s (velocities) or N (forces).
using NodeField = Eigen::Matrix3Xd;

/// One component of a block's voxels: a hexahedron with nodes at the block's corners; node a + 2(b + 2c)
/// lies at the corner (a, b, c).
struct CompositeElement {
  Vec3i block;              ///< (voxel index − first_voxel()) >> level
  std::vector<int> voxels;  ///< linked and hosted voxels, ascending; a hosted one may lie beside the block
  std::array<int, 8> nodes{};
};

/// Where node n of an element lies: 0 or 1 along each axis.
inline Vec3i corner_bits(int n) { return {n & 1, (n >> 1) & 1, (n >> 2) & 1}; }

/// A material point in an element: x = Σ weight[n] · x_node[n].
struct Embedding {
  int element = -1;
  std::array<int, 8> nodes{};
  std::array<double, 8> weights{};
  Vec3 apply(const NodeField& field) const;
};

/// Composite hexahedra over the voxels (Nesme et al. 2009; Dick et al. 2011): the voxels of a block fall into
/// components under the intact links inside the block, each component is an element with eight private nodes,
/// and each intact link between two blocks unites the nodes that the two elements share (DESIGN of
/// duplication: a cut block has one copy a side). A hosted voxel is joined to its host as if by an intact
/// link.
class CompositeMesh {
 public:
  CompositeMesh(const VoxelVolume& volume, int level);

  int level() const { return level_; }

  /// Lattice index at which block (0, 0, 0) starts: the smallest along each axis of any voxel, so that a box
  /// whose edges are whole blocks consists of full blocks.
  const Vec3i& first_voxel() const { return first_voxel_; }
  Vec3i block_of(const Vec3i& voxel) const {
    return (voxel - first_voxel_).unaryExpr([this](int i) { return i >> level_; });
  }

  const std::vector<CompositeElement>& elements() const { return elements_; }
  const NodeField& rest() const { return rest_; }  ///< m, material positions of the nodes
  int node_count() const { return static_cast<int>(rest_.cols()); }
  int element_of_voxel(int voxel) const { return element_of_voxel_[voxel]; }
  Vec3 block_size() const { return block_size_; }  ///< m
  Vec3 block_corner(int element) const { return rest_.col(elements_[element].nodes[0]); }

  /// Embeds a material point (also outside of the block: extrapolated) in the element of a voxel.
  Embedding embed(int voxel, const Vec3& X) const { return embed_in_element(element_of_voxel_[voxel], X); }
  Embedding embed_in_element(int element, const Vec3& X) const;

 private:
  int level_;
  Vec3i first_voxel_;
  Vec3 block_size_;
  std::vector<CompositeElement> elements_;
  std::vector<int> element_of_voxel_;
  NodeField rest_;
};

/// For each node of `after` the node of `before` that it stems from: that of the element which held one of
/// the same voxels, at the same corner. Both meshes are of one volume, `after` with more links severed.
std::vector<int> parent_nodes(const CompositeMesh& before, const CompositeMesh& after);

}  // namespace cfem_cutting
