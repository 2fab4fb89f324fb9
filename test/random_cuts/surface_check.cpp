#include "surface_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace cfem_cutting::random_cuts {
namespace {

using Triangle = std::array<int, 3>;

/// Each edge must be used once in either direction.
bool edges_pair_up(const std::vector<Triangle>& triangles) {
  std::vector<std::pair<int, int>> edges, reversed;
  for (const Triangle& t : triangles)
    for (int i = 0; i < 3; ++i) {
      edges.emplace_back(t[i], t[(i + 1) % 3]);
      reversed.emplace_back(t[(i + 1) % 3], t[i]);
    }
  std::sort(edges.begin(), edges.end());
  std::sort(reversed.begin(), reversed.end());
  return edges == reversed && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

/// The edges opposite to each vertex must be one cycle.
bool vertices_have_one_fan(const std::vector<Triangle>& triangles) {
  std::map<int, std::map<int, int>> next_around;
  for (const Triangle& t : triangles)
    for (int i = 0; i < 3; ++i) next_around[t[i]][t[(i + 1) % 3]] = t[(i + 2) % 3];
  for (const auto& [vertex, next] : next_around) {
    const int first = next.begin()->first;
    std::size_t steps = 1;
    for (int at = next.at(first); at != first; at = next.at(at)) ++steps;
    if (steps != next.size()) return false;
  }
  return true;
}

/// The sense of three cells around a link, or of the triangle's corners, about an axis.
double turn(const Vec3& a, const Vec3& b, const Vec3& c, int axis) { return (b - a).cross(c - a)[axis]; }

/// Whether a triangle whose corners lie in three cells around one link turns about it other than the cells
/// do.
bool is_flipped(const SurfaceVertex& a, const SurfaceVertex& b, const SurfaceVertex& c) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.cell[axis] != b.cell[axis] || a.cell[axis] != c.cell[axis]) continue;
    const double cells = turn(a.cell.cast<double>(), b.cell.cast<double>(), c.cell.cast<double>(), axis);
    if (cells != 0.0) return cells * turn(a.X, b.X, c.X, axis) < 0.0;
  }
  return false;
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
  if (!edges_pair_up(triangles)) return "an edge isn't used once in either direction";
  if (!vertices_have_one_fan(triangles)) return "a vertex has more than one fan";
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
    figures.flipped += is_flipped(a, b, c);
    figures.needles += !(smallest_angle(a.X, b.X, c.X) >= 5.0 * EIGEN_PI / 180.0);
  }
  return figures;
}

}  // namespace cfem_cutting::random_cuts
