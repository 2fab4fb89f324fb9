#include "surface_check.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace cfem_cutting::random_cuts {
namespace {

using Triangle = std::array<int, 3>;

/// A triangle's corner and the edge opposite to it.
struct Corner {
  int vertex, from, to;
  bool operator<(const Corner& o) const { return std::tie(vertex, from) < std::tie(o.vertex, o.from); }
};

std::vector<Corner> sorted_corners(const std::vector<Triangle>& triangles) {
  std::vector<Corner> corners;
  corners.reserve(3 * triangles.size());
  for (const auto& [a, b, c] : triangles) {
    corners.push_back({a, b, c});
    corners.push_back({b, c, a});
    corners.push_back({c, a, b});
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Each edge from a vertex must be used once in either direction: its corners' `from` are all different, and
/// the same as their `to`.
bool edges_pair_up(const Corner* begin, const Corner* end) {
  std::vector<int> from, to;
  for (const Corner* c = begin; c != end; ++c) {
    from.push_back(c->from);
    to.push_back(c->to);
  }
  std::sort(to.begin(), to.end());
  return from == to && std::adjacent_find(to.begin(), to.end()) == to.end();
}

/// The edges opposite to a vertex must be one cycle.
bool is_one_fan(const Corner* begin, const Corner* end) {
  const Corner* at = begin;
  std::ptrdiff_t steps = 0;
  do {
    at = std::lower_bound(begin, end, Corner{begin->vertex, at->to, 0});
    ++steps;
  } while (at != begin);
  return steps == end - begin;
}

double smallest_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto angle = [](const Vec3& u, const Vec3& v) { return std::atan2(u.cross(v).norm(), u.dot(v)); };
  return std::min({angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)});
}

}  // namespace

void SurfaceFigures::add(const SurfaceFigures& other) {
  triangles += other.triangles;
  without_area += other.without_area;
  flipped += other.flipped;
  needles += other.needles;
  crossing += other.crossing;
}

std::string find_flaw(const std::vector<Triangle>& triangles) {
  for (const Triangle& t : triangles)
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return "a triangle uses a vertex twice";
  const std::vector<Corner> corners = sorted_corners(triangles);
  const Corner* const last = corners.data() + corners.size();
  for (const Corner* begin = corners.data(); begin != last;) {
    const Corner* end = begin;
    while (end != last && end->vertex == begin->vertex) ++end;
    if (!edges_pair_up(begin, end)) return "an edge isn't used once in either direction";
    if (!is_one_fan(begin, end)) return "a vertex has more than one fan";
    begin = end;
  }
  return {};
}

double signed_volume(const TissueSurface& surface) {
  if (surface.vertices.empty()) return 0.0;
  const Vec3 origin = surface.vertices.front().X;
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : surface.triangles)
    six_volumes += (surface.vertices[a].X - origin)
                       .dot((surface.vertices[b].X - origin).cross(surface.vertices[c].X - origin));
  return six_volumes / 6.0;
}

SurfaceFigures measure(const TissueSurface& surface) {
  SurfaceFigures figures;
  for (const auto& [i, j, k] : surface.triangles) {
    const SurfaceVertex &a = surface.vertices[i], &b = surface.vertices[j], &c = surface.vertices[k];
    const double longest =
        std::max({(b.X - a.X).squaredNorm(), (c.X - b.X).squaredNorm(), (a.X - c.X).squaredNorm()});
    ++figures.triangles;
    figures.without_area += !((b.X - a.X).cross(c.X - a.X).norm() > 1e-9 * longest);
    figures.needles += !(smallest_angle(a.X, b.X, c.X) >= 5.0 * EIGEN_PI / 180.0);
  }
  figures.flipped = count_flipped(surface);
  return figures;
}

}  // namespace cfem_cutting::random_cuts
