#include "cfem_cutting/geometry/polyline.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace cfem_cutting {
namespace {

double position_on_line(const Vec3& a, const Vec3& b, const Vec3& query) {
  const Vec3 ab = b - a;
  return (query - a).dot(ab) / ab.squaredNorm();
}

Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  return a == b ? a : Vec3(a + std::clamp(position_on_line(a, b, p), 0.0, 1.0) * (b - a));
}

PolylineProjection project_on_segment(const Polyline& polyline, int segment, const Vec3& query) {
  const Vec3& a = polyline[segment];
  const Vec3& b = polyline[segment + 1];
  const bool first = segment == 0;
  const bool last = segment + 2 == static_cast<int>(polyline.size());
  const double t = position_on_line(a, b, query);
  const double on_segment = std::clamp(t, 0.0, 1.0);

  PolylineProjection result;
  result.point = a + on_segment * (b - a);
  result.tangent = (b - a).normalized();
  result.segment = segment;
  result.t = (t < 0.0 && first) || (t > 1.0 && last) ? t : on_segment;
  result.distance = (query - result.point).norm();
  return result;
}

}  // namespace

PolylineProjection project(const Polyline& polyline, const Vec3& query) {
  assert(polyline.size() >= 2);
  PolylineProjection nearest;
  nearest.distance = std::numeric_limits<double>::infinity();
  for (int segment = 0; segment + 1 < static_cast<int>(polyline.size()); ++segment) {
    const PolylineProjection candidate = project_on_segment(polyline, segment, query);
    if (candidate.distance < nearest.distance) nearest = candidate;
  }
  return nearest;
}

std::vector<double> arc_lengths(const Polyline& polyline) {
  std::vector<double> along(polyline.size(), 0.0);
  for (std::size_t i = 1; i < along.size(); ++i)
    along[i] = along[i - 1] + (polyline[i] - polyline[i - 1]).norm();
  return along;
}

double arc_length(const Polyline& polyline, const PolylineProjection& at) {
  double length = 0.0;
  for (int i = 0; i < at.segment; ++i) length += (polyline[i + 1] - polyline[i]).norm();
  return length + (at.point - polyline[at.segment]).norm();
}

Vec3 point_along(const Polyline& polyline, double along) {
  for (std::size_t i = 0; i + 1 < polyline.size(); ++i) {
    const Vec3 way = polyline[i + 1] - polyline[i];
    const double length = way.norm();
    if (along < length) return polyline[i] + std::max(along, 0.0) / length * way;
    along -= length;
  }
  return polyline.back();
}

Polyline refine(const Polyline& polyline, double max_length) {
  assert(max_length > 0.0);
  if (polyline.empty()) return {};
  Polyline refined{polyline.front()};
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    const Vec3& a = polyline[i - 1];
    const Vec3& b = polyline[i];
    const double rounding = 1e-9;
    const int parts = std::max(1, static_cast<int>(std::ceil((b - a).norm() / max_length - rounding)));
    for (int part = 1; part < parts; ++part)
      refined.push_back(a + (b - a) * (static_cast<double>(part) / parts));
    refined.push_back(b);
  }
  return refined;
}

Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const bool above_triangle = (b - a).cross(p - a).dot(normal) >= 0.0 &&
                              (c - b).cross(p - b).dot(normal) >= 0.0 &&
                              (a - c).cross(p - c).dot(normal) >= 0.0;
  if (normal.squaredNorm() > 0.0 && above_triangle)
    return p - (p - a).dot(normal) / normal.squaredNorm() * normal;
  Vec3 nearest = a;
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    const Vec3 on_edge = nearest_on_segment(p, from, to);
    if ((p - on_edge).squaredNorm() < (p - nearest).squaredNorm()) nearest = on_edge;
  }
  return nearest;
}

double point_triangle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  return (p - nearest_on_triangle(p, a, b, c)).norm();
}

}  // namespace cfem_cutting
