#include "cfem_cutting/geometry/self_crossings.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace cfem_cutting {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = std::array<int, 3>;

/// Triangles between places: vertices at one place are one, and of the two faces of a closed cut only one is
/// left.
struct Soup {
  std::vector<Point> places;
  std::vector<Triangle> triangles;

  explicit Soup(const TriangleMesh& mesh) {
    std::map<Point, int> place_at;
    std::vector<int> place;
    for (const Vec3& X : mesh.vertices) {
      const auto [at, fresh] = place_at.emplace(Point(X.x(), X.y(), X.z()), places.size());
      if (fresh) places.push_back(at->first);
      place.push_back(at->second);
    }
    std::set<Triangle> known;
    for (const auto& [a, b, c] : mesh.triangles) {
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

/// Calls visit(t, u) for triangles whose bounding boxes overlap: a sweep along x.
template <typename Visit>
void for_overlapping(const Soup& soup, Visit visit) {
  std::vector<CGAL::Bbox_3> boxes;
  for (int t = 0; t < static_cast<int>(soup.triangles.size()); ++t) boxes.push_back(soup.triangle(t).bbox());
  std::vector<int> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int t, int u) { return boxes[t].xmin() < boxes[u].xmin(); });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].xmin() <= boxes[order[i]].xmax(); ++j)
      if (CGAL::do_overlap(boxes[order[i]], boxes[order[j]])) visit(order[i], order[j]);
}

}  // namespace

int count_self_crossings(const TriangleMesh& mesh) {
  const Soup soup(mesh);
  std::set<int> crossing;
  for_overlapping(soup, [&](int t, int u) {
    if (cross(soup, t, u)) crossing.insert({t, u});
  });
  return static_cast<int>(crossing.size());
}

}  // namespace cfem_cutting
