#include <algorithm>
#include <cmath>

#include "cfem_cutting/surface/tissue_surface.h"

namespace cfem_cutting {
namespace {

constexpr double kNeedleAngle = 5.0 * EIGEN_PI / 180.0;  // rad

/// Twice the area over the longest edge squared, below which a triangle counts as without area.
constexpr double kNoArea = 1e-9;

/// The sense of three cells around a link, or of the triangle's corners, about an axis.
double turn(const Vec3& a, const Vec3& b, const Vec3& c, int axis) { return (b - a).cross(c - a)[axis]; }

bool is_flipped(const SurfaceVertex& a, const SurfaceVertex& b, const SurfaceVertex& c) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.cell[axis] != b.cell[axis] || a.cell[axis] != c.cell[axis]) continue;
    const double cells = turn(a.cell.cast<double>(), b.cell.cast<double>(), c.cell.cast<double>(), axis);
    if (cells != 0.0) return cells * turn(a.X, b.X, c.X, axis) < 0.0;
  }
  return false;
}

}  // namespace

int count_flipped(const TissueSurface& surface) {
  const auto flipped = [&](const std::array<int, 3>& t) {
    return is_flipped(surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]);
  };
  return static_cast<int>(std::count_if(surface.triangles.begin(), surface.triangles.end(), flipped));
}

SurfaceQuality assess(const TriangleMesh& mesh) {
  SurfaceQuality quality;
  quality.defects = find_defects(mesh);
  quality.volume = enclosed_volume(mesh);
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    std::array<double, 3> edges{(b - a).norm(), (c - b).norm(), (a - c).norm()};
    std::sort(edges.begin(), edges.end());
    const double area = (b - a).cross(c - a).norm();  // m², twice the triangle's
    if (!(area > kNoArea * edges[2] * edges[2])) ++quality.degenerate;
    // The smallest angle lies between the two longer edges.
    if (!(area >= std::sin(kNeedleAngle) * edges[1] * edges[2])) ++quality.needles;
  }
  return quality;
}

}  // namespace cfem_cutting
