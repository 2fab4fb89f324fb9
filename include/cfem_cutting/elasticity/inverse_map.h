#pragma once

#include <memory>
#include <optional>

#include "cfem_cutting/elasticity/composite_mesh.h"

namespace cfem_cutting {

/// Where a point of deformed space lies in the tissue.
struct MaterialPoint {
  Vec3 X;  ///< m, material space
  int voxel =
      -1;  ///< the linked voxel in whose element X is embedded: the own voxel at X, or else the nearest one
  bool inside = false;  ///< in uncut or cut tissue; false: in air beside it, X is extrapolated
  /// Inside, or in the box of a linked voxel beyond the skin's tangent planes, where links may still pass. No
  /// link passes elsewhere.
  bool near_links = false;
};

/// Inverse of the deformation φ given by node positions: x ↦ X, by a spatial hash of the deformed elements
/// and Newton's method on the trilinear map. A point is inside if X lies in a linked voxel of that very
/// element and on the tissue's side of that voxel's surface links (planes of their Hermite data). Beyond a
/// severed link it belongs to the voxel across, if it is on that one's side of the link too; else it is in
/// the gap of an open cut. Where two places hold the point at once, the sides of a cut overlap: it counts as
/// in the cut, in air. Points outside, up to `reach` blocks from tissue, are extrapolated from the nearest
/// element; where that would land in the tissue of another element (an open cut), X is drawn back to the
/// nearest point of the own element's tissue.
class InverseMap {
 public:
  /// Keeps references: volume and mesh must outlive it; x is copied.
  InverseMap(const VoxelVolume& volume, const CompositeMesh& mesh, NodeField x, double reach = 2.0);
  ~InverseMap();

  /// @return nothing if x is farther from all tissue than the reach
  std::optional<MaterialPoint> operator()(const Vec3& x) const;

  /// φ of a material point.
  Vec3 forward(const MaterialPoint& point) const;

 private:
  struct Hash;
  std::optional<MaterialPoint> in_voxel_of(int element, const Vec3& x) const;
  std::optional<MaterialPoint> owner(const MaterialPoint& point, const Vec3& x) const;
  std::optional<Vec3> pull_back(int element, const Vec3& x, double largest) const;
  std::optional<MaterialPoint> beside_tissue(const Vec3& x) const;
  bool in_tissue_of_another(const MaterialPoint& point) const;

  const VoxelVolume& volume_;
  const CompositeMesh& mesh_;
  NodeField x_;
  double reach_;
  std::unique_ptr<Hash> hash_;
};

}  // namespace cfem_cutting
