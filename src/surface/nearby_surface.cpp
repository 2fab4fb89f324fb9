#include "nearby_surface.h"

#include <algorithm>

#include "cfem_cutting/geometry/polyline.h"

namespace cfem_cutting {
namespace {

/// How often a triangle, seen along z, winds around a point. An edge gives both of its triangles the same
/// answer, so that no ray slips through between them.
int winding_in_plane(const std::array<Vec3, 3>& triangle, const Vec3& p) {
  int winding = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &from = triangle[i], &to = triangle[(i + 1) % 3];
    const bool up = from.y() <= p.y() && to.y() > p.y(), down = to.y() <= p.y() && from.y() > p.y();
    if (!up && !down) continue;
    const Vec3 &low = up ? from : to, &high = up ? to : from;
    const double side = (high.x() - low.x()) * (p.y() - low.y()) - (high.y() - low.y()) * (p.x() - low.x());
    if (side > 0.0) winding += up ? 1 : -1;
  }
  return winding;
}

bool is_above(const std::array<Vec3, 3>& triangle, const Vec3& p) {
  const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  return normal.dot(triangle[0] - p) * normal.z() > 0.0;
}

}  // namespace

NearbySurface::NearbySurface(const DeformedSurface& drawn, const Box& around, double radius)
    : radius_(radius) {
  const Box wide(around.min() - Vec3::Constant(radius), around.max() + Vec3::Constant(radius));
  for (const auto& [i, j, k] : drawn.triangles) {
    const Triangle triangle{drawn.positions[i], drawn.positions[j], drawn.positions[k]};
    const Vec3 low = triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]);
    const Vec3 high = triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]);
    if (wide.intersects(Box(low, high))) near_.push_back(triangle);
    const bool over = (low.head<2>().array() <= around.max().head<2>().array()).all() &&
                      (high.head<2>().array() >= around.min().head<2>().array()).all();
    if (over) above_.push_back(triangle);
  }
}

double NearbySurface::distance(const Vec3& p) const {
  double nearest = radius_;
  for (const Triangle& triangle : near_)
    nearest = std::min(nearest, point_triangle_distance(p, triangle[0], triangle[1], triangle[2]));
  return nearest;
}

int NearbySurface::winding_number(const Vec3& p) const {
  int winding = 0;
  for (const Triangle& triangle : above_)
    if (const int turns = winding_in_plane(triangle, p); turns != 0 && is_above(triangle, p))
      winding += turns;
  return winding;
}

}  // namespace cfem_cutting
