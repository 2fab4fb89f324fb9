#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "cfem_cutting/cutting/sweep.h"

namespace cfem_cutting {

/// All swept surface that fractures have opened so far, in material space. Tells new area from old: a second
/// pass along the same cut opens nothing and pays nothing.
class CutSurface {
 public:
  /// @param cell m, bucket size (a voxel); also the scale of "near"
  explicit CutSurface(double cell);

  /// Adds triangles and returns the area (m²) that is inside tissue and new: old is what lies over or under
  /// the surface so far, at most a quarter of a cell away. Triangles that are all old are not kept.
  double add(const VoxelVolume& volume, const std::vector<SweptTriangle>& triangles);

  /// The surface's point nearest to X, if within `radius` ≤ cell, m.
  std::optional<Vec3> nearest(const Vec3& X, double radius) const;

  /// Distance to the surface if within `radius` ≤ cell, else infinity, m.
  double distance(const Vec3& X, double radius) const;

  const std::vector<SweptTriangle>& triangles() const { return triangles_; }

 private:
  void insert(const SweptTriangle& triangle);
  bool covered(const Vec3& X) const;
  template <typename Visit>
  void for_near(const Vec3& X, double radius, Visit visit) const;

  double cell_;
  std::vector<SweptTriangle> triangles_;
  std::unordered_map<std::int64_t, std::vector<int>> buckets_;
};

}  // namespace cfem_cutting
