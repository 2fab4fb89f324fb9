#include "settling.h"

namespace cfem_cutting {
namespace {

bool is_near(const Contour& contour, const Vec3& a, const Vec3& b) {
  constexpr double kNear = 0.02;  // of a voxel
  return (a - b).norm() < kNear * contour.volume().lattice().spacing.minCoeff();
}

/// From X to the cut and by turns to what `other` leads to, and back; nothing if there is no cut near.
template <typename Other>
std::optional<Vec3> to_cut_and(const Contour& contour, const Vec3& X, const NearestOnCut& nearest,
                               const Other& other) {
  constexpr int kTurns = 8;
  std::optional<Vec3> at = nearest(X);
  for (int i = 1; i < kTurns && at; ++i) {
    const std::optional<Vec3> next = nearest(other(*at));
    if (!next || is_near(contour, *at, *next)) break;
    at = next;
  }
  return at;
}

Vec3 into(const Box& room, const Vec3& X) { return X.cwiseMax(room.min()).cwiseMin(room.max()); }

/// Where a midpoint may lie: in its cells' common face.
Box room_in_face(const Contour& contour, const Mesher::Midpoint& midpoint, const Vec3& X) {
  Box room = room_in_cell(contour.volume().lattice(), contour.cells()[midpoint.cell].index);
  room.min()[midpoint.normal_axis] = room.max()[midpoint.normal_axis] = X[midpoint.normal_axis];
  return room;
}

/// Where a group's vertex would be in its cell: if it is not on the trace, on the cut as far as that goes.
Vec3 into_cell(const Contour& contour, int cell, const SheetGroup& group, const NearestOnCut& nearest) {
  const Box room = room_in_cell(contour.volume().lattice(), contour.cells()[cell].index);
  const auto inside = [&](const Vec3& X) { return into(room, X); };
  if (group.adapted || !nearest) return inside(group.X());
  return inside(to_cut_and(contour, group.X(), nearest, inside).value_or(group.X()));
}

}  // namespace

void settle_on_cut(Contour& contour, const NearestOnCut& nearest) {
  for (DualCell& cell : contour.cells()) {
    if (cell.groups.size() != 1 || !cell.groups[0].severed) continue;
    SheetGroup& group = cell.groups[0];
    const bool held = group.adapted && group.cut_end;
    if (held ? !group.skin : group.settled) continue;
    const auto onto_its_skin = [&](const Vec3& X) { return onto_skin(X, contour.volume(), cell, group); };
    const Vec3 start = held ? group.X() : group.frozen.value_or(group.minimum);
    const std::optional<Vec3> X = to_cut_and(contour, start, nearest, onto_its_skin);
    group.settled = X.has_value();
    if (X && (held || !is_near(contour, *X, start))) group.frozen = X;
  }
}

void settle_midpoints(const Contour& contour, Mesher& mesher, const NearestOnCut& nearest) {
  for (int m = 0; m < static_cast<int>(mesher.midpoints().size()); ++m) {
    const Mesher::Midpoint& midpoint = mesher.midpoints()[m];
    const DualCell& cell = contour.cells()[midpoint.cell];
    const SheetGroup& group = cell.groups[midpoint.group];
    if (!midpoint.at_cut || cell.groups.size() != 1) continue;
    const Vec3 start = midpoint.X;
    const Box room = room_in_face(contour, midpoint, start);
    const auto onto_its_skin = [&](const Vec3& X) {
      return into(room, onto_skin(X, contour.volume(), cell, group));
    };
    const std::optional<Vec3> X = to_cut_and(contour, start, nearest, onto_its_skin);
    if (X) mesher.move(m, into(room, *X));
  }
}

bool draw_back(Contour& contour, int cell, int group, const NearestOnCut& nearest) {
  SheetGroup& of_sheets = contour.cells()[cell].groups[group];
  const int most_times = of_sheets.adapted ? 2 : 3;
  if (of_sheets.times_drawn_back == most_times) return false;
  const int times = ++of_sheets.times_drawn_back;
  const Vec3 in_cell = into_cell(contour, cell, of_sheets, nearest);
  const Vec3 halfway = 0.5 * (of_sheets.X() + in_cell);
  of_sheets.drawn_back = times == 1 ? halfway : times == 2 ? in_cell : of_sheets.minimum;
  return true;
}

}  // namespace cfem_cutting
