#include "cfem_cutting/cutting/crossings.h"

#include <algorithm>
#include <cmath>

#include "cfem_cutting/geometry/predicates.h"

namespace cfem_cutting {
namespace {

int sign(double value) { return (value > 0.0) - (value < 0.0); }

/// A triangle's view along one axis k: coordinates (u, v) = axes (k + 1, k + 2) mod 3, a right-handed pair.
struct Projection {
  int axis;
  int u() const { return (axis + 1) % 3; }
  int v() const { return (axis + 2) % 3; }
  Eigen::Vector2d operator()(const Vec3& p) const { return {p[u()], p[v()]}; }
};

/// Which side of the directed line p q a lattice point c lies on, c being shifted by (ε, ε², ε³). With δ the
/// shift, orient2d(p, q, c + δ) = orient2d(p, q, c) − δ_u (q_v − p_v) + δ_v (q_u − p_u); of δ_u and δ_v the
/// one of the smaller axis is infinitely larger. 0 only if p and q coincide in this view.
int side_of_edge(const Projection& view, const Vec3& p, const Vec3& q, const Vec3& c) {
  const int exact = orient2d(view(p), view(q), view(c));
  if (exact != 0) return exact;
  const int by_u = -sign(q[view.v()] - p[view.v()]);
  const int by_v = sign(q[view.u()] - p[view.u()]);
  const bool u_first = view.u() < view.v();
  const int first = u_first ? by_u : by_v;
  return first != 0 ? first : (u_first ? by_v : by_u);
}

/// Whether the lattice line through c along the view's axis, shifted, meets the triangle.
bool line_meets(const Projection& view, const SweptTriangle& t, const Vec3& c) {
  const int a = side_of_edge(view, t.corners[0], t.corners[1], c);
  const int b = side_of_edge(view, t.corners[1], t.corners[2], c);
  return a != 0 && a == b && b == side_of_edge(view, t.corners[2], t.corners[0], c);
}

/// Which side of the triangle's plane a shifted lattice point lies on: orient3d is linear in its last point,
/// so ties are decided by the first component of the plane's normal that isn't zero.
int side_of_plane(const SweptTriangle& t, const Vec3& c) {
  const int exact = orient3d(t.corners[0], t.corners[1], t.corners[2], c);
  if (exact != 0) return exact;
  for (int axis = 0; axis < 3; ++axis) {
    const Projection view{axis};
    const int component = orient2d(view(t.corners[0]), view(t.corners[1]), view(t.corners[2]));
    if (component != 0) return component;
  }
  return 0;
}

class CrossingFinder {
 public:
  CrossingFinder(const VoxelVolume& volume, std::vector<Crossing>& found) : volume_(volume), found_(found) {}

  void meet(const SweptTriangle& triangle) {
    const Box box = bounds(triangle);
    for (int axis = 0; axis < 3; ++axis) meet_along(Projection{axis}, triangle, box);
  }

 private:
  static Box bounds(const SweptTriangle& t) {
    Box box;
    for (const Vec3& corner : t.corners) box.extend(corner);
    return box;
  }

  /// Voxels whose centres may lie within a layer of the box.
  Vec3i first(const Vec3& low) const { return (volume_.lattice().voxel_at(low).array() - 1).max(0).matrix(); }
  Vec3i last(const Vec3& high) const {
    return (volume_.lattice().voxel_at(high).array() + 1).min(volume_.lattice().size.array() - 1).matrix();
  }

  void meet_along(const Projection& view, const SweptTriangle& triangle, const Box& box) {
    const Vec3i low = first(box.min());
    const Vec3i high = last(box.max());
    Vec3i index = low;
    for (index[view.v()] = low[view.v()]; index[view.v()] <= high[view.v()]; ++index[view.v()]) {
      for (index[view.u()] = low[view.u()]; index[view.u()] <= high[view.u()]; ++index[view.u()]) {
        index[view.axis] = low[view.axis];
        if (line_meets(view, triangle, volume_.lattice().centre(index)))
          meet_line(view.axis, triangle, index, high);
      }
    }
  }

  /// The one link of a lattice line that the plane passes through, if it is intact.
  void meet_line(int axis, const SweptTriangle& triangle, Vec3i index, const Vec3i& high) {
    int before = side_of_plane(triangle, volume_.lattice().centre(index));
    for (; index[axis] < high[axis]; ++index[axis]) {
      const Vec3i next = index + Vec3i::Unit(axis);
      const int after = side_of_plane(triangle, volume_.lattice().centre(next));
      if (before != after) return add(axis, triangle, index);
      before = after;
    }
  }

  void add(int axis, const SweptTriangle& triangle, const Vec3i& index) {
    const int voxel = volume_.find(index);
    if (voxel < 0 || !volume_.voxel(voxel).linked()) return;
    const int direction = 2 * axis + 1;
    const Voxel& v = volume_.voxel(voxel);
    if (v.neighbour[direction] < 0 || v.link[direction] != LinkState::kIntact) return;
    const double twice_area = triangle.normal().norm();
    const Vec3 normal = twice_area > 0.0 ? Vec3(triangle.normal() / twice_area) : Vec3::Unit(axis);
    SurfacePoint at{volume_.centre(voxel), normal};
    const double slope = normal[axis];
    const double h = volume_.lattice().spacing[axis];
    const double way = slope != 0.0 ? (triangle.corners[0] - at.point).dot(normal) / slope : 0.5 * h;
    at.point[axis] += std::clamp(way, 0.0, h);
    found_.push_back({{voxel, axis}, at});
  }

  const VoxelVolume& volume_;
  std::vector<Crossing>& found_;
};

}  // namespace

std::vector<Crossing> find_crossings(const VoxelVolume& volume, const std::vector<SweptTriangle>& sweep) {
  std::vector<Crossing> crossings;
  CrossingFinder finder(volume, crossings);
  for (const SweptTriangle& triangle : sweep) finder.meet(triangle);
  std::stable_sort(crossings.begin(), crossings.end(),
                   [](const auto& a, const auto& b) { return a.link < b.link; });
  const auto same = [](const Crossing& a, const Crossing& b) { return a.link == b.link; };
  crossings.erase(std::unique(crossings.begin(), crossings.end(), same), crossings.end());
  return crossings;
}

}  // namespace cfem_cutting
