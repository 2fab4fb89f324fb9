#include "cfem_cutting/cutting/cut_surface.h"

#include <cmath>
#include <limits>

#include "cfem_cutting/geometry/polyline.h"

namespace cfem_cutting {
namespace {

/// Calls visit(key) for each bucket that a box overlaps.
template <typename Visit>
void for_buckets(const Vec3& low, const Vec3& high, double cell, Visit visit) {
  const Vec3i first = (low / cell).array().floor().cast<int>();
  const Vec3i last = (high / cell).array().floor().cast<int>();
  for (int k = first.z(); k <= last.z(); ++k)
    for (int j = first.y(); j <= last.y(); ++j)
      for (int i = first.x(); i <= last.x(); ++i) {
        constexpr std::int64_t kOffset = 1 << 20;
        visit((i + kOffset) + ((j + kOffset) << 21) + ((k + kOffset) << 42));
      }
}

bool in_tissue(const VoxelVolume& volume, const Vec3& X) {
  const int voxel = volume.find(volume.lattice().voxel_at(X));
  return voxel >= 0 && volume.voxel(voxel).linked();
}

/// Centroids of a triangle's 16 equal parts (4 a side).
std::array<Vec3, 16> part_centroids(const SweptTriangle& t) {
  constexpr int kSide = 4;
  const Vec3 e1 = (t.corners[1] - t.corners[0]) / kSide;
  const Vec3 e2 = (t.corners[2] - t.corners[0]) / kSide;
  std::array<Vec3, 16> centroids;
  int n = 0;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; i + j < kSide; ++j) {
      const Vec3 corner = t.corners[0] + i * e1 + j * e2;
      centroids[n++] = corner + (e1 + e2) / 3.0;
      if (i + j + 1 < kSide) centroids[n++] = corner + 2.0 * (e1 + e2) / 3.0;
    }
  return centroids;
}

}  // namespace

CutSurface::CutSurface(double cell) : cell_(cell) {}

double CutSurface::add(const VoxelVolume& volume, const std::vector<SweptTriangle>& triangles) {
  const double near = 0.25 * cell_;
  double area = 0.0;
  for (const SweptTriangle& t : triangles) {
    int opened = 0;
    for (const Vec3& X : part_centroids(t)) opened += in_tissue(volume, X) && distance(X, near) > near;
    area += 0.5 * t.normal().norm() * opened / 16.0;
  }
  for (const SweptTriangle& t : triangles) insert(t);
  return area;
}

void CutSurface::insert(const SweptTriangle& t) {
  const int index = static_cast<int>(triangles_.size());
  triangles_.push_back(t);
  const Vec3 low = t.corners[0].cwiseMin(t.corners[1]).cwiseMin(t.corners[2]);
  const Vec3 high = t.corners[0].cwiseMax(t.corners[1]).cwiseMax(t.corners[2]);
  for_buckets(low, high, cell_, [&](std::int64_t key) { buckets_[key].push_back(index); });
}

double CutSurface::distance(const Vec3& X, double radius) const {
  double nearest = std::numeric_limits<double>::infinity();
  const Vec3 reach = Vec3::Constant(radius);
  for_buckets(X - reach, X + reach, cell_, [&](std::int64_t key) {
    const auto bucket = buckets_.find(key);
    if (bucket == buckets_.end()) return;
    for (const int i : bucket->second) {
      const auto& [a, b, c] = triangles_[i].corners;
      nearest = std::min(nearest, point_triangle_distance(X, a, b, c));
    }
  });
  return nearest <= radius ? nearest : std::numeric_limits<double>::infinity();
}

}  // namespace cfem_cutting
