#include "mesher.h"

#include <algorithm>

namespace cfem_cutting {
namespace {

/// The axis square to the face between the i-th and the next of the cells around a link.
int face_axis(int direction, int i) { return (direction / 2 + 1 + i % 2) % 3; }

/// Whether a further arc of the face from cell a to cell b joins the same two sheets as the arc of `side`.
bool arc_repeats(const DualCell& a, const DualCell& b, LocalSide side, int normal_axis) {
  const auto in_b = [&](LocalSide s) { return 3 * (s / 3 ^ (1 << normal_axis)) + s % 3; };
  const LocalSide end = a.arc_end(side, normal_axis);
  for (LocalSide s = 0; s < kLocalSides; ++s) {
    const bool in_face = s % 3 != normal_axis && ((s / 3 ^ side / 3) >> normal_axis & 1) == 0;
    if (!in_face || s == side || s == end || !a.has_side(s)) continue;
    if (a.sheet_of_side[s] == a.sheet_of_side[side] &&
        b.sheet_of_side[in_b(s)] == b.sheet_of_side[in_b(side)])
      return true;
  }
  return false;
}

/// A number for the end of an arc at a side, in a cell's face.
std::int64_t arc_end_key(const DualCell& cell, LocalSide side, int normal_axis) {
  const int corner = side / 3;
  const std::int64_t link_side = kDirections * cell.voxel[corner] + direction_from(corner, side % 3);
  return kDirections * link_side + direction_from(corner, 3 - side % 3 - normal_axis);
}

bool same_sheet_across(const DualCell& cell, LocalSide side) {
  return cell.sheet_of_side[side] == cell.sheet_of_side[across(side)];
}

/// Shape of a triangle, positive if it is counter-clockwise about an axis: twice its area over its longest
/// edge squared; else its projected area, m².
double shape(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  const Vec3 area = (b - a).cross(c - a);
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  constexpr double kFlat = 1e-9;
  return area[axis] > kFlat * longest ? area.norm() / longest : area[axis] - kFlat * longest;
}

}  // namespace

void Mesher::build(const Contour& contour) {
  surface_ = {};
  quads_.clear();
  anchors_.clear();
  midpoint_of_arc_.clear();
  std::array<int, 8> none;
  none.fill(-1);
  vertex_of_sheet_.assign(contour.cells().size(), none);
  surface_.triangles.reserve(2 * contour.sides().size());
  surface_.cut.reserve(2 * contour.sides().size());
  surface_.label.reserve(2 * contour.sides().size());
  quads_.reserve(contour.sides().size());
  for (const LinkSide side : contour.sides()) add_polygon(contour, polygon_of(contour, side));
}

Mesher::Polygon Mesher::polygon_of(const Contour& contour, LinkSide side) const {
  Polygon polygon{side / kDirections, side % kDirections, {}, {}, {}};
  const std::array<Vec3i, 4> around = contour.cells_around(polygon.voxel, polygon.direction);
  for (int i = 0; i < 4; ++i) {
    const Vec3i corner = contour.volume().voxel(polygon.voxel).index - around[i];
    polygon.cell[i] = contour.find(around[i]);
    polygon.side[i] = 3 * (corner.x() + 2 * (corner.y() + 2 * corner.z())) + polygon.direction / 2;
    polygon.sheet[i] = contour.cells()[polygon.cell[i]].sheet_of_side[polygon.side[i]];
  }
  return polygon;
}

/// A severed link with no severed neighbour isn't drawn: its sheets hold nothing but its two sides. Polygons
/// with midpoints, and those that would share a diagonal with the link's other side, become fans.
void Mesher::add_polygon(const Contour& contour, const Polygon& polygon) {
  bool lone = true;
  std::array<bool, 4> shared;
  for (int i = 0; i < 4; ++i) {
    const DualCell& cell = contour.cells()[polygon.cell[i]];
    const SideMask both = SideMask{1} << polygon.side[i] | SideMask{1} << across(polygon.side[i]);
    lone = lone && cell.sheets[polygon.sheet[i]].sides == both;
    shared[i] = same_sheet_across(cell, polygon.side[i]);
  }
  if (lone) return;

  std::vector<int> rim;
  for (int i = 0; i < 4; ++i) {
    const DualCell& cell = contour.cells()[polygon.cell[i]];
    const DualCell& next = contour.cells()[polygon.cell[(i + 1) % 4]];
    rim.push_back(sheet_vertex(contour, polygon.cell[i], polygon.sheet[i]));
    if (arc_repeats(cell, next, polygon.side[i], face_axis(polygon.direction, i)))
      rim.push_back(midpoint(contour, polygon, i));
  }
  const bool diagonal_shared = (shared[0] && shared[2]) || (shared[1] && shared[3]);
  if (rim.size() == 4 && !diagonal_shared)
    add_quad(contour, polygon, rim);
  else
    add_fan(contour, polygon, rim);
}

void Mesher::add_quad(const Contour& contour, const Polygon& polygon, const std::vector<int>& corners) {
  quads_.push_back({{corners[0], corners[1], corners[2], corners[3]},
                    polygon.direction,
                    static_cast<int>(surface_.triangles.size())});
  for (int i : {1, 2}) add_triangle(contour, polygon, corners[0], corners[i], corners[i + 1]);
}

/// Around a vertex of its own where the link meets the surface: positive, as each corner stays in its cell.
void Mesher::add_fan(const Contour& contour, const Polygon& polygon, const std::vector<int>& rim) {
  const int centre = add_fixed_vertex(contour.volume().crossing(polygon.voxel, polygon.direction).point,
                                      polygon.voxel, contour.cells()[polygon.cell[0]].index);
  for (std::size_t i = 0; i < rim.size(); ++i)
    add_triangle(contour, polygon, centre, rim[i], rim[(i + 1) % rim.size()]);
}

int Mesher::sheet_vertex(const Contour& contour, int cell, int sheet) {
  int& vertex = vertex_of_sheet_[cell][sheet];
  if (vertex >= 0) return vertex;
  const DualCell& dual = contour.cells()[cell];
  const int group = dual.sheets[sheet].group;
  vertex = add_fixed_vertex(dual.groups[group].X(), dual.sheets[sheet].voxel, dual.index);
  anchors_[vertex] = {cell, group};
  return vertex;
}

/// Halfway between the ends of the polygon's arc in its i-th face.
int Mesher::midpoint(const Contour& contour, const Polygon& polygon, int i) {
  const DualCell& cell = contour.cells()[polygon.cell[i]];
  const int normal_axis = face_axis(polygon.direction, i);
  const LocalSide side = polygon.side[i];
  const LocalSide end = cell.arc_end(side, normal_axis);
  const std::int64_t key =
      std::min(arc_end_key(cell, side, normal_axis), arc_end_key(cell, end, normal_axis));
  const auto found = midpoint_of_arc_.find(key);
  if (found != midpoint_of_arc_.end()) return found->second;
  const auto crossing = [&](LocalSide s) {
    return contour.volume().crossing(cell.voxel[s / 3], direction_from(s / 3, s % 3)).point;
  };
  const int vertex =
      add_fixed_vertex(0.5 * (crossing(side) + crossing(end)), cell.voxel[side / 3], cell.index);
  midpoint_of_arc_.emplace(key, vertex);
  return vertex;
}

int Mesher::add_fixed_vertex(const Vec3& X, int voxel, const Vec3i& cell) {
  surface_.vertices.push_back({X, voxel, cell});
  anchors_.push_back({-1, -1});
  return static_cast<int>(surface_.vertices.size()) - 1;
}

/// @param a, b, c counter-clockwise about the axis of the polygon's link
void Mesher::add_triangle(const Contour& contour, const Polygon& polygon, int a, int b, int c) {
  const Voxel& voxel = contour.volume().voxel(polygon.voxel);
  surface_.triangles.push_back(polygon.direction % 2 ? std::array<int, 3>{a, b, c}
                                                     : std::array<int, 3>{a, c, b});
  surface_.cut.push_back(voxel.link[polygon.direction] == LinkState::kSevered ? 1 : 0);
  surface_.label.push_back(static_cast<std::uint8_t>(voxel.label));
}

void Mesher::place(const Contour& contour, bool all) {
  std::vector<bool> moved(surface_.vertices.size(), all);
  for (std::size_t v = 0; v < surface_.vertices.size(); ++v) {
    if (anchors_[v].cell < 0) continue;
    SurfaceVertex& vertex = surface_.vertices[v];
    const SheetGroup& group = contour.cells()[anchors_[v].cell].groups[anchors_[v].group];
    const bool on_front = group.adapted.has_value();
    if (vertex.on_front == on_front && vertex.X == group.X()) continue;
    vertex.X = group.X();
    vertex.on_front = on_front;
    moved[v] = true;
  }
  for (const Quad& quad : quads_) {
    const auto& [a, b, c, d] = quad.corners;
    if (moved[a] || moved[b] || moved[c] || moved[d]) split(quad);
  }
}

void Mesher::split(const Quad& quad) {
  const auto& [a, b, c, d] = quad.corners;
  const auto write = [&](int offset, int p, int q, int r) {
    surface_.triangles[quad.first_triangle + offset] =
        quad.direction % 2 ? std::array<int, 3>{p, q, r} : std::array<int, 3>{p, r, q};
  };
  const bool second = prefers_second_diagonal(quad);
  second ? write(0, b, c, d) : write(0, a, b, c);
  second ? write(1, b, d, a) : write(1, a, c, d);
}

/// Both triangles must be positive about the link. Among such, the diagonal of a chain of vertices on the
/// front that leaves out a corner, else the better shaped triangles.
bool Mesher::prefers_second_diagonal(const Quad& quad) const {
  const auto vertex = [&](int i) -> const SurfaceVertex& { return surface_.vertices[quad.corners[i]]; };
  const auto worst = [&](int i) {
    const Vec3 &p = vertex(i).X, &q = vertex(i + 1).X, &r = vertex(i + 2).X, &s = vertex((i + 3) % 4).X;
    const int axis = quad.direction / 2;
    return std::min(shape(p, q, r, axis), shape(p, r, s, axis));
  };
  const auto chain = [&](int i) {
    return vertex(i).on_front && vertex(i + 2).on_front && !vertex(1 - i).on_front && !vertex(3 - i).on_front;
  };
  const double first_shape = worst(0), second_shape = worst(1);
  if (chain(0) && first_shape > 0.0) return false;
  if (chain(1) && second_shape > 0.0) return true;
  constexpr double kTie = 1e-9;
  return second_shape > first_shape + kTie;
}

}  // namespace cfem_cutting
