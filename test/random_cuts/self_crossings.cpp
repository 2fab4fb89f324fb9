#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <map>
#include <set>

#include "surface_check.h"

namespace cfem_cutting::random_cuts {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = std::array<int, 3>;

/// Triangles between places: vertices at one place are one, and of the two faces of a closed cut only one is
/// left.
struct Soup {
  std::vector<Point> places;
  std::vector<Triangle> triangles;

  explicit Soup(const TissueSurface& surface) {
    std::map<Point, int> place_at;
    std::vector<int> place;
    for (const SurfaceVertex& v : surface.vertices) {
      const auto [at, fresh] = place_at.emplace(Point(v.X.x(), v.X.y(), v.X.z()), places.size());
      if (fresh) places.push_back(at->first);
      place.push_back(at->second);
    }
    std::set<Triangle> known;
    for (const auto& [a, b, c] : surface.triangles) {
      const Triangle t{place[a], place[b], place[c]};
      Triangle sorted = t;
      std::sort(sorted.begin(), sorted.end());
      if (known.insert(sorted).second) triangles.push_back(t);
    }
  }

  Kernel::Triangle_3 triangle(int t) const {
    const auto& [a, b, c] = triangles[t];
    return {places[a], places[b], places[c]};
  }
};

/// Turns a triangle's corners so that those which another has too come first.
Triangle common_first(Triangle t, const Triangle& other) {
  std::stable_partition(t.begin(), t.end(),
                        [&](int v) { return std::find(other.begin(), other.end(), v) != other.end(); });
  return t;
}

/// Whether two triangles meet in more than a common corner or edge.
bool cross(const Soup& soup, int t, int u) {
  const Triangle a = common_first(soup.triangles[t], soup.triangles[u]);
  const Triangle b = common_first(soup.triangles[u], soup.triangles[t]);
  const auto at = [&](int place) { return soup.places[place]; };
  const auto common =
      std::count_if(a.begin(), a.end(), [&](int v) { return std::find(b.begin(), b.end(), v) != b.end(); });
  if (common == 0) return CGAL::do_intersect(soup.triangle(t), soup.triangle(u));
  if (common == 1)
    return CGAL::do_intersect(soup.triangle(t), Kernel::Segment_3(at(b[1]), at(b[2]))) ||
           CGAL::do_intersect(soup.triangle(u), Kernel::Segment_3(at(a[1]), at(a[2])));
  return CGAL::coplanar(at(a[0]), at(a[1]), at(a[2]), at(b[2])) &&
         CGAL::coplanar_orientation(at(a[0]), at(a[1]), at(a[2]), at(b[2])) == CGAL::POSITIVE;
}

}  // namespace

std::int64_t count_self_crossings(const TissueSurface& surface) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;
  const Soup soup(surface);
  std::vector<Box> boxes;
  for (int t = 0; t < static_cast<int>(soup.triangles.size()); ++t)
    boxes.emplace_back(soup.triangle(t).bbox(), t);
  std::set<int> crossing;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    if (cross(soup, a.info(), b.info())) crossing.insert({a.info(), b.info()});
  });
  return static_cast<std::int64_t>(crossing.size());
}

}  // namespace cfem_cutting::random_cuts
