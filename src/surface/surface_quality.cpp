#include <algorithm>
#include <cmath>

#include "cfem_cutting/surface/tissue_surface.h"

namespace cfem_cutting {
namespace {

constexpr double kNeedleAngle = 5.0 * EIGEN_PI / 180.0;  // rad

/// Twice the area over the longest edge squared, below which a triangle counts as without area.
constexpr double kNoArea = 1e-9;

}  // namespace

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
