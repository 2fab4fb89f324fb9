#include "polygon.h"

namespace cfem_cutting {
namespace {

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

bool same_sheet_across(const DualCell& cell, LocalSide side) {
  return cell.sheet_of_side[side] == cell.sheet_of_side[across(side)];
}

}  // namespace

/// Polygons with midpoints, and those that would share a diagonal with the link's other side, become fans.
Polygon polygon_of(const Contour& contour, LinkSide side) {
  Polygon polygon{side / kDirections, side % kDirections, {}, {}, {}, {}, true, false, false};
  polygon.severed = contour.volume().voxel(polygon.voxel).link[polygon.direction] == LinkState::kSevered;
  const std::array<Vec3i, 4> around = contour.cells_around(polygon.voxel, polygon.direction);
  std::array<bool, 4> shared;
  for (int i = 0; i < 4; ++i) {
    const Vec3i corner = contour.volume().voxel(polygon.voxel).index - around[i];
    polygon.cell[i] = contour.find(around[i]);
    polygon.side[i] = 3 * (corner.x() + 2 * (corner.y() + 2 * corner.z())) + polygon.direction / 2;
    const DualCell& cell = contour.cells()[polygon.cell[i]];
    polygon.sheet[i] = cell.sheet_of_side[polygon.side[i]];
    const SideMask both = SideMask{1} << polygon.side[i] | SideMask{1} << across(polygon.side[i]);
    polygon.lone = polygon.lone && cell.sheets[polygon.sheet[i]].sides == both;
    shared[i] = same_sheet_across(cell, polygon.side[i]);
  }
  polygon.fan = (shared[0] && shared[2]) || (shared[1] && shared[3]);
  for (int i = 0; i < 4; ++i) {
    const DualCell& next = contour.cells()[polygon.cell[(i + 1) % 4]];
    polygon.midpoint[i] =
        arc_repeats(contour.cells()[polygon.cell[i]], next, polygon.side[i], face_axis(polygon.direction, i));
    polygon.fan = polygon.fan || polygon.midpoint[i];
  }
  return polygon;
}

}  // namespace cfem_cutting
