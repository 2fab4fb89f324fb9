#include "diagonals.h"

#include <algorithm>
#include <cstdlib>

#include "cfem_cutting/geometry/predicates.h"

namespace cfem_cutting {

double shape_about_axis(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  const Vec3 area = (b - a).cross(c - a);
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  constexpr double kFlat = 1e-9;
  return area[axis] > kFlat * longest ? area.norm() / longest : area[axis] - kFlat * longest;
}

/// The worse of a quad's two triangles about its link, on the diagonal from corner i.
double Diagonals::worse_shape(const LinkQuad& quad, int i) const {
  const auto at = [&](int k) -> const Vec3& { return X(quad.corners[k % 4]); };
  const int axis = quad.direction() / 2;
  return std::min(shape_about_axis(at(i), at(i + 1), at(i + 2), axis),
                  shape_about_axis(at(i), at(i + 2), at(i + 3), axis));
}

bool Diagonals::is_on_chain(const LinkQuad& quad, int i) const {
  const int a = chain_[quad.corners[i]], b = chain_[quad.corners[i + 2]];
  return a >= 0 && b >= 0 && std::abs(a - b) == 1;
}

bool Diagonals::chain_misses(const LinkQuad& quad, int i) const {
  return is_on_chain(quad, i) && !(worse_shape(quad, i) > 0.0);
}

bool Diagonals::prefers_second(const LinkQuad& quad) const {
  const double first_shape = worse_shape(quad, 0), second_shape = worse_shape(quad, 1);
  if (is_on_chain(quad, 0) && first_shape > 0.0) return false;
  if (is_on_chain(quad, 1) && second_shape > 0.0) return true;
  if (surface_.cut[quad.first_triangle] && first_shape > 0.0 && second_shape > 0.0) {
    const int first_meetings = meetings_with_skin(quad, 0), second_meetings = meetings_with_skin(quad, 1);
    if (first_meetings != second_meetings) return second_meetings < first_meetings;
  }
  constexpr double kTie = 1e-9;
  return second_shape > first_shape + kTie;
}

/// Of the triangles on the diagonal from corner i, and of those of its twin.
int Diagonals::meetings_with_skin(const LinkQuad& quad, int i) const {
  const auto of = [&](const std::array<int, 4>& v) {
    return meetings_with_skin({v[i], v[i + 1], v[i + 2]}) +
           meetings_with_skin({v[i], v[i + 2], v[(i + 3) % 4]});
  };
  return of(quad.corners) + (quad.twin >= 0 ? of(parts_.quad(quad.twin).corners) : 0);
}

int Diagonals::meetings_with_skin(const std::array<int, 3>& triangle) const {
  int count = 0;
  for (const int corner : triangle) {
    for (const int part : parts_.at(corner)) {
      const MeshParts::Triangles beside = parts_.triangles(part);
      if (surface_.cut[beside.first]) continue;
      for (int t = beside.first; t < beside.end; ++t) count += meet(triangle, surface_.triangles[t]);
    }
  }
  return count;
}

/// Whether two triangles with one corner in common have more than it.
bool Diagonals::meet(const std::array<int, 3>& t, const std::array<int, 3>& u) const {
  int in_common = 0, i = 0, j = 0;
  for (int k = 0; k < 3; ++k) {
    const auto found = std::find(u.begin(), u.end(), t[k]);
    if (found == u.end()) continue;
    ++in_common;
    i = k;
    j = static_cast<int>(found - u.begin());
  }
  return in_common == 1 &&
         (goes_through(t[(i + 1) % 3], t[(i + 2) % 3], u) || goes_through(u[(j + 1) % 3], u[(j + 2) % 3], t));
}

bool Diagonals::goes_through(int from, int to, const std::array<int, 3>& triangle) const {
  const Vec3 &p = X(from), &q = X(to), &a = X(triangle[0]), &b = X(triangle[1]), &c = X(triangle[2]);
  if (orient3d(a, b, c, p) == orient3d(a, b, c, q)) return false;
  const std::array<int, 3> turns{orient3d(p, q, a, b), orient3d(p, q, b, c), orient3d(p, q, c, a)};
  const auto [least, most] = std::minmax_element(turns.begin(), turns.end());
  return *least >= 0 || *most <= 0;
}

}  // namespace cfem_cutting
