#include "cfem_cutting/cutting/cut_surface.h"

#include <cmath>
#include <limits>

#include "cfem_cutting/geometry/polyline.h"
#include "cfem_cutting/volume/inside.h"

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

/// Whether a triangle lies over or under a point: the foot of the perpendicular is in it, at most `reach`
/// away.
bool covers(const SweptTriangle& t, const Vec3& X, double reach) {
  const Vec3 n = t.normal();
  const double twice_area = n.norm();
  if (!(twice_area > 0.0) || std::abs(n.dot(X - t.corners[0])) > reach * twice_area) return false;
  for (int i = 0; i < 3; ++i) {
    const Vec3& a = t.corners[i];
    if (n.dot((t.corners[(i + 1) % 3] - a).cross(X - a)) < 0.0) return false;
  }
  return true;
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
  double area = 0.0;
  for (const SweptTriangle& t : triangles) {
    int opened = 0;
    for (const Vec3& X : part_centroids(t)) opened += tissue_voxel_at(volume, X) >= 0 && !covered(X);
    area += 0.5 * t.normal().norm() * opened / 16.0;
    if (opened > 0) insert(t);
  }
  return area;
}

void CutSurface::insert(const SweptTriangle& t) {
  const int index = static_cast<int>(triangles_.size());
  triangles_.push_back(t);
  const Vec3 low = t.corners[0].cwiseMin(t.corners[1]).cwiseMin(t.corners[2]);
  const Vec3 high = t.corners[0].cwiseMax(t.corners[1]).cwiseMax(t.corners[2]);
  for_buckets(low, high, cell_, [&](std::int64_t key) { buckets_[key].push_back(index); });
}

template <typename Visit>
void CutSurface::for_near(const Vec3& X, double radius, Visit visit) const {
  const Vec3 reach = Vec3::Constant(radius);
  for_buckets(X - reach, X + reach, cell_, [&](std::int64_t key) {
    const auto bucket = buckets_.find(key);
    if (bucket == buckets_.end()) return;
    for (const int i : bucket->second) visit(triangles_[i]);
  });
}

bool CutSurface::covered(const Vec3& X) const {
  const double reach = 0.25 * cell_;
  bool is_covered = false;
  for_near(X, reach, [&](const SweptTriangle& t) { is_covered = is_covered || covers(t, X, reach); });
  return is_covered;
}

std::optional<Vec3> CutSurface::nearest(const Vec3& X, double radius) const {
  std::optional<Vec3> found;
  double least = radius;
  for_near(X, radius, [&](const SweptTriangle& t) {
    const Vec3 on_triangle = nearest_on_triangle(X, t.corners[0], t.corners[1], t.corners[2]);
    const double distance = (on_triangle - X).norm();
    if (!(distance <= least)) return;
    least = distance;
    found = on_triangle;
  });
  return found;
}

double CutSurface::distance(const Vec3& X, double radius) const {
  const std::optional<Vec3> at = nearest(X, radius);
  return at ? (*at - X).norm() : std::numeric_limits<double>::infinity();
}

}  // namespace cfem_cutting
