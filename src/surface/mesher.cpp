#include "mesher.h"

#include <algorithm>
#include <numeric>

#include "cfem_cutting/volume/inside.h"

namespace cfem_cutting {
namespace {

/// A number for the end of an arc at a side, in a cell's face.
std::int64_t arc_end_key(const DualCell& cell, LocalSide side, int normal_axis) {
  const int corner = side / 3;
  const std::int64_t link_side = kDirections * cell.voxel[corner] + direction_from(corner, side % 3);
  return kDirections * link_side + direction_from(corner, 3 - side % 3 - normal_axis);
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
  fan_triangles_.clear();
  anchors_.clear();
  chain_.clear();
  adapted_.clear();
  direction_.clear();
  midpoints_.clear();
  midpoint_of_arc_.clear();
  std::array<int, 8> none;
  none.fill(-1);
  vertex_of_sheet_.assign(contour.cells().size(), none);
  surface_.triangles.reserve(2 * contour.sides().size());
  surface_.cut.reserve(2 * contour.sides().size());
  surface_.label.reserve(2 * contour.sides().size());
  quads_.reserve(contour.sides().size());
  for (const LinkSide side : contour.sides()) add_polygon(contour, polygon_of(contour, side));
  for (const Quad& quad : quads_) split(quad);
  find_pieces();
}

/// Per vertex the quads and fans' triangles that it is a corner of.
void Mesher::find_pieces() {
  const auto for_corners = [&](const auto& work) {
    int piece = 0;
    for (const Quad& quad : quads_) {
      for (const int v : quad.corners) work(v, piece);
      ++piece;
    }
    for (const int t : fan_triangles_) {
      for (const int v : surface_.triangles[t]) work(v, piece);
      ++piece;
    }
  };
  first_piece_.assign(surface_.vertices.size() + 1, 0);
  for_corners([&](int v, int) { ++first_piece_[v + 1]; });
  std::partial_sum(first_piece_.begin(), first_piece_.end(), first_piece_.begin());
  pieces_.resize(first_piece_.back());
  std::vector<int> next(first_piece_.begin(), first_piece_.end() - 1);
  for_corners([&](int v, int piece) { pieces_[next[v]++] = piece; });
}

/// Those at the vertices of cells, ascending.
std::vector<int> Mesher::pieces_at(const std::vector<int>& cells) const {
  std::vector<char> flags(quads_.size() + fan_triangles_.size(), 0);
  for (const int cell : cells)
    for (const int v : vertex_of_sheet_[cell])
      if (v >= 0)
        for (int i = first_piece_[v]; i < first_piece_[v + 1]; ++i) flags[pieces_[i]] = 1;
  std::vector<int> pieces;
  for (std::size_t piece = 0; piece < flags.size(); ++piece)
    if (flags[piece]) pieces.push_back(static_cast<int>(piece));
  return pieces;
}

void Mesher::add_polygon(const Contour& contour, const Polygon& polygon) {
  if (polygon.lone) return;
  std::vector<int> rim;
  for (int i = 0; i < 4; ++i) {
    rim.push_back(sheet_vertex(contour, polygon.cell[i], polygon.sheet[i]));
    if (polygon.midpoint[i]) rim.push_back(midpoint(contour, polygon, i));
  }
  polygon.fan ? add_fan(contour, polygon, rim) : add_quad(contour, polygon, rim);
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
  for (std::size_t i = 0; i < rim.size(); ++i) {
    fan_triangles_.push_back(static_cast<int>(surface_.triangles.size()));
    add_triangle(contour, polygon, centre, rim[i], rim[(i + 1) % rim.size()]);
  }
}

int Mesher::sheet_vertex(const Contour& contour, int cell, int sheet) {
  int& vertex = vertex_of_sheet_[cell][sheet];
  if (vertex >= 0) return vertex;
  const DualCell& dual = contour.cells()[cell];
  const int group = dual.sheets[sheet].group;
  const Anchor anchor{cell, group, dual.sheets[sheet].voxel};
  vertex = add_fixed_vertex(dual.groups[group].X(), voxel_of(contour, anchor), dual.index);
  anchors_[vertex] = anchor;
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
  midpoints_.push_back({vertex, polygon.cell[i], polygon.group(contour, i), normal_axis,
                        cell.has_side(across(side)) || cell.has_side(across(end))});
  return vertex;
}

int Mesher::add_fixed_vertex(const Vec3& X, int voxel, const Vec3i& cell) {
  surface_.vertices.push_back({X, voxel, cell});
  chain_.push_back(-1);
  adapted_.push_back(0);
  anchors_.push_back({-1, -1, voxel});
  return static_cast<int>(surface_.vertices.size()) - 1;
}

/// @param a, b, c counter-clockwise about the axis of the polygon's link
void Mesher::add_triangle(const Contour& contour, const Polygon& polygon, int a, int b, int c) {
  const Voxel& voxel = contour.volume().voxel(polygon.voxel);
  surface_.triangles.push_back(polygon.direction % 2 ? std::array<int, 3>{a, b, c}
                                                     : std::array<int, 3>{a, c, b});
  direction_.push_back(polygon.direction);
  surface_.cut.push_back(voxel.link[polygon.direction] == LinkState::kSevered ? 1 : 0);
  surface_.label.push_back(static_cast<std::uint8_t>(voxel.label));
}

void Mesher::place(const Contour& contour, const std::vector<int>& cells) {
  std::vector<char> moved(surface_.vertices.size(), 0);
  for (const int cell : cells)
    for (const int v : vertex_of_sheet_[cell])
      if (v >= 0 && move(contour, v)) moved[v] = 1;
  const int quads = static_cast<int>(quads_.size());
  for (const int piece : pieces_at(cells)) {
    if (piece >= quads) break;
    const auto& [a, b, c, d] = quads_[piece].corners;
    if (moved[a] || moved[b] || moved[c] || moved[d]) split(quads_[piece]);
  }
}

/// To where its group is.
/// @return whether anything changed that quads depend on
bool Mesher::move(const Contour& contour, int v) {
  SurfaceVertex& vertex = surface_.vertices[v];
  const SheetGroup& group = contour.cells()[anchors_[v].cell].groups[anchors_[v].group];
  vertex.cut_end = group.cut_end;
  adapted_[v] = group.adapted || group.frozen;
  vertex.voxel = voxel_of(contour, anchors_[v]);
  if (chain_[v] == group.chain && vertex.edge_end == group.edge_end && vertex.X == group.X()) return false;
  vertex.X = group.X();
  vertex.on_front = group.chain >= 0;
  vertex.edge_end = group.edge_end;
  chain_[v] = group.chain;
  return true;
}

/// What a vertex follows. A virtual intersection point may be far from its cell: where its sheet alone is
/// there (a crease, or a cut's end), it goes with the tissue at its place, as the blade's contact point does.
int Mesher::voxel_of(const Contour& contour, const Anchor& anchor) {
  const DualCell& cell = contour.cells()[anchor.cell];
  const SheetGroup& group = cell.groups[anchor.group];
  const auto is_in_group = [&](const Sheet& sheet) { return sheet.group == anchor.group; };
  const bool moved = group.adapted || group.frozen;
  if (!moved || std::count_if(cell.sheets.begin(), cell.sheets.end(), is_in_group) > 1) return anchor.voxel;
  const int voxel = tissue_voxel_at(contour.volume(), group.X());
  return voxel >= 0 ? voxel : anchor.voxel;
}

bool Mesher::is_turned(int triangle) const {
  const auto& [a, b, c] = surface_.triangles[triangle];
  const Vec3 &A = surface_.vertices[a].X, &B = surface_.vertices[b].X, &C = surface_.vertices[c].X;
  const int direction = direction_[triangle];
  return !(direction % 2 ? shape(A, B, C, direction / 2) > 0.0 : shape(A, C, B, direction / 2) > 0.0);
}

std::vector<Anchor> Mesher::turned(const std::vector<int>& cells) const {
  std::vector<Anchor> anchors;
  const auto take = [&](const auto& corners) {
    for (const int v : corners)
      if (adapted_[v]) anchors.push_back(anchors_[v]);
  };
  const int quads = static_cast<int>(quads_.size());
  for (const int piece : pieces_at(cells)) {
    if (piece < quads) {  // the corner opposite may have left no better diagonal
      const Quad& quad = quads_[piece];
      if (is_turned(quad.first_triangle) || is_turned(quad.first_triangle + 1)) take(quad.corners);
    } else {
      const int triangle = fan_triangles_[piece - quads];
      if (is_turned(triangle)) take(surface_.triangles[triangle]);
    }
  }
  const auto key = [](const Anchor& a) { return std::pair(a.cell, a.group); };
  std::sort(anchors.begin(), anchors.end(),
            [&](const Anchor& a, const Anchor& b) { return key(a) < key(b); });
  anchors.erase(std::unique(anchors.begin(), anchors.end(),
                            [&](const Anchor& a, const Anchor& b) { return key(a) == key(b); }),
                anchors.end());
  return anchors;
}

std::vector<std::pair<Anchor, Anchor>> Mesher::missed_diagonals(const std::vector<int>& cells) const {
  std::vector<std::pair<Anchor, Anchor>> missed;
  const int quads = static_cast<int>(quads_.size());
  for (const int piece : pieces_at(cells)) {
    if (piece >= quads) break;
    const Quad& quad = quads_[piece];
    for (const int i : {0, 1})
      if (is_on_chain(quad, i) && !(worse_shape(quad, i) > 0.0))
        missed.emplace_back(anchors_[quad.corners[i]], anchors_[quad.corners[i + 2]]);
  }
  return missed;
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

/// The worse of a quad's two triangles about its link, on the diagonal from corner i.
double Mesher::worse_shape(const Quad& quad, int i) const {
  const auto X = [&](int k) -> const Vec3& { return surface_.vertices[quad.corners[k % 4]].X; };
  const int axis = quad.direction / 2;
  return std::min(shape(X(i), X(i + 1), X(i + 2), axis), shape(X(i), X(i + 2), X(i + 3), axis));
}

/// Whether the chain of vertices on the front takes the diagonal from corner i.
bool Mesher::is_on_chain(const Quad& quad, int i) const {
  const int a = chain_[quad.corners[i]], b = chain_[quad.corners[i + 2]];
  return a >= 0 && b >= 0 && std::abs(a - b) == 1;
}

/// Both triangles must be positive about the link. Among such, the diagonal of a chain of vertices on the
/// front that leaves out a corner, else the better shaped triangles.
bool Mesher::prefers_second_diagonal(const Quad& quad) const {
  const double first_shape = worse_shape(quad, 0), second_shape = worse_shape(quad, 1);
  if (is_on_chain(quad, 0) && first_shape > 0.0) return false;
  if (is_on_chain(quad, 1) && second_shape > 0.0) return true;
  constexpr double kTie = 1e-9;
  return second_shape > first_shape + kTie;
}

}  // namespace cfem_cutting
