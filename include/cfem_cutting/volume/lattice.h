#pragma once

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// Regular lattice of voxels in material space. Voxel (i, j, k) fills
/// [origin + (i, j, k)·h, origin + (i+1, j+1, k+1)·h].
struct Lattice {
  Vec3 origin = Vec3::Zero();   ///< m, lower corner of voxel (0, 0, 0)
  Vec3 spacing = Vec3::Ones();  ///< m, voxel edges h
  Vec3i size = Vec3i::Zero();   ///< voxels along each axis

  std::int64_t count() const { return std::int64_t{size.x()} * size.y() * size.z(); }
  bool contains(const Vec3i& v) const { return (v.array() >= 0).all() && (v.array() < size.array()).all(); }
  std::int64_t index(const Vec3i& v) const {
    return v.x() + size.x() * (v.y() + std::int64_t{size.y()} * v.z());
  }
  Vec3 centre(const Vec3i& v) const { return corner(v) + 0.5 * spacing; }
  Vec3 corner(const Vec3i& v) const { return origin + v.cast<double>().cwiseProduct(spacing); }
  Vec3i voxel_at(const Vec3& X) const {
    return (X - origin).cwiseQuotient(spacing).array().floor().cast<int>();
  }
};

}  // namespace cfem_cutting
