#include "mesher.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <utility>

#include "cfem_cutting/volume/inside.h"

namespace cfem_cutting {
namespace {

/// The side at a severed link's other end, −1 for other links.
LinkSide side_across(const VoxelVolume& volume, LinkSide side) {
  const Voxel& voxel = volume.voxel(side / kDirections);
  const int direction = side % kDirections;
  if (voxel.link[direction] != LinkState::kSevered) return -1;
  return kDirections * voxel.neighbour[direction] + opposite(direction);
}

/// A number for the end of an arc at a side, in a cell's face.
std::int64_t arc_end_key(const DualCell& cell, LocalSide side, int normal_axis) {
  const int corner = side / 3;
  const std::int64_t link_side = kDirections * cell.voxel[corner] + direction_from(corner, side % 3);
  return kDirections * link_side + direction_from(corner, 3 - side % 3 - normal_axis);
}

bool chain_goes_on(const SheetGroup& from, const SheetGroup& to) {
  return from.adapted && to.adapted && std::abs(from.chain - to.chain) == 1;
}

}  // namespace

void Mesher::build(const Contour& contour) {
  surface_ = {};
  parts_.clear();
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
  parts_.reserve(contour.sides().size());
  for (const LinkSide side : contour.sides()) add_polygon(contour, polygon_of(contour, side));
  parts_.pair_up([&](LinkSide side) { return side_across(contour.volume(), side); });
  parts_.sort_by_vertex(static_cast<int>(surface_.vertices.size()), surface_.triangles);
  for (const bool cut : {false, true})
    for (int part = 0; part < parts_.quad_count(); ++part)
      if (is_cut(part) == cut && parts_.quad(part).twin < part) split(part);
}

/// Those at the vertices of cells, ascending.
std::vector<int> Mesher::parts_at(const std::vector<int>& cells) const {
  std::vector<int> parts;
  part_is_taken_.resize(parts_.size(), 0);
  for (const int cell : cells)
    for (const int v : vertex_of_sheet_[cell]) {
      if (v < 0) continue;
      for (const int part : parts_.at(v))
        if (!std::exchange(part_is_taken_[part], 1)) parts.push_back(part);
    }
  for (const int part : parts) part_is_taken_[part] = 0;
  std::sort(parts.begin(), parts.end());
  return parts;
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
  parts_.add({{corners[0], corners[1], corners[2], corners[3]},
              kDirections * polygon.voxel + polygon.direction,
              static_cast<int>(surface_.triangles.size())});
  for (int i : {1, 2}) add_triangle(contour, polygon, corners[0], corners[i], corners[i + 1]);
}

/// Around a vertex of its own where the link meets the surface: positive, as each corner stays in its cell.
void Mesher::add_fan(const Contour& contour, const Polygon& polygon, const std::vector<int>& rim) {
  const int centre = add_fixed_vertex(contour.volume().crossing(polygon.voxel, polygon.direction).point,
                                      polygon.voxel, contour.cells()[polygon.cell[0]].index);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    parts_.add_fan_triangle(static_cast<int>(surface_.triangles.size()));
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
  const Vec3 X = 0.5 * (crossing(side) + crossing(end));
  const int vertex = add_fixed_vertex(X, cell.voxel[side / 3], cell.index);
  const int next = (i + 1) % 4;
  midpoint_of_arc_.emplace(key, vertex);
  midpoints_.push_back({vertex, X, polygon.cell[i], polygon.group(contour, i), polygon.cell[next],
                        polygon.group(contour, next), normal_axis,
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
  std::vector<int> moved;
  for (const int cell : cells)
    for (const int v : vertex_of_sheet_[cell])
      if (v >= 0 && move(contour, v)) moved.push_back(v);
  for (const Midpoint& midpoint : midpoints_)
    if (move(contour, midpoint)) moved.push_back(midpoint.vertex);
  split_around(moved);
}

/// Splits the quads at vertices, the skin first, and those of cuts that the skin there may go through.
void Mesher::split_around(const std::vector<int>& moved) {
  std::set<int> skin, cut_quads;  // of twins the later
  const auto take = [&](int part) {
    if (parts_.is_quad(part) && is_cut(part)) cut_quads.insert(std::max(part, parts_.quad(part).twin));
  };
  for (const int v : moved)
    for (const int part : parts_.at(v)) is_cut(part) ? take(part) : void(skin.insert(part));
  for (const int part : skin) {
    if (parts_.is_quad(part)) split(part);
    const MeshParts::Triangles triangles = parts_.triangles(part);
    for (int t = triangles.first; t < triangles.end; ++t)
      for (const int v : surface_.triangles[t])
        for (const int beside : parts_.at(v)) take(beside);
  }
  for (const int part : cut_quads) split(part);
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

/// Where a chain goes through a slit from cell to cell, the slit's sides lie on the chain.
bool Mesher::move(const Contour& contour, const Midpoint& midpoint) {
  SurfaceVertex& vertex = surface_.vertices[midpoint.vertex];
  const SheetGroup& group = contour.cells()[midpoint.cell].groups[midpoint.group];
  const SheetGroup& next = contour.cells()[midpoint.next_cell].groups[midpoint.next_group];
  const bool on_chain = midpoint.at_cut && chain_goes_on(group, next);
  const Vec3 X = on_chain ? Vec3(0.5 * (group.X() + next.X())) : midpoint.X;
  if (vertex.on_front == on_chain && vertex.X == X) return false;
  vertex.X = X;
  vertex.on_front = vertex.cut_end = on_chain;
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
  return voxel >= 0 && !is_other_tissue(contour.volume(), cell, anchor.group, voxel) ? voxel : anchor.voxel;
}

bool Mesher::is_turned(int triangle) const {
  const auto& [a, b, c] = surface_.triangles[triangle];
  const Vec3 &A = surface_.vertices[a].X, &B = surface_.vertices[b].X, &C = surface_.vertices[c].X;
  const int direction = direction_[triangle];
  return !(direction % 2 ? shape_about_axis(A, B, C, direction / 2) > 0.0
                         : shape_about_axis(A, C, B, direction / 2) > 0.0);
}

std::vector<Anchor> Mesher::turned(const std::vector<int>& cells) const {
  std::vector<Anchor> anchors;
  const auto take = [&](const auto& corners) {
    for (const int v : corners)
      if (adapted_[v]) anchors.push_back(anchors_[v]);
  };
  for (const int part : parts_at(cells)) {
    if (parts_.is_quad(part)) {  // the corner opposite may have left no better diagonal
      const LinkQuad& quad = parts_.quad(part);
      if (is_turned(quad.first_triangle) || is_turned(quad.first_triangle + 1)) take(quad.corners);
    } else {
      const int triangle = parts_.triangles(part).first;
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
  for (const int part : parts_at(cells)) {
    if (!parts_.is_quad(part)) break;
    const LinkQuad& quad = parts_.quad(part);
    for (const int i : {0, 1})
      if (diagonals().chain_misses(quad, i))
        missed.emplace_back(anchors_[quad.corners[i]], anchors_[quad.corners[i + 2]]);
  }
  return missed;
}

/// On both sides of a cut alike: twins have their corners in the same cells, in the same order.
void Mesher::split(int part) {
  const LinkQuad& quad = parts_.quad(part);
  const bool second = diagonals().prefers_second(quad);
  write(quad, second);
  if (quad.twin >= 0) write(parts_.quad(quad.twin), second);
}

void Mesher::write(const LinkQuad& quad, bool second_diagonal) {
  const auto& [a, b, c, d] = quad.corners;
  const auto write = [&](int offset, int p, int q, int r) {
    surface_.triangles[quad.first_triangle + offset] =
        quad.direction() % 2 ? std::array<int, 3>{p, q, r} : std::array<int, 3>{p, r, q};
  };
  second_diagonal ? write(0, b, c, d) : write(0, a, b, c);
  second_diagonal ? write(1, b, d, a) : write(1, a, c, d);
}

}  // namespace cfem_cutting
