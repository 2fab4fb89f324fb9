#include "dual_cell.h"

#include <algorithm>
#include <numeric>

#include "cfem_cutting/volume/link_way.h"
#include "error_function.h"

namespace cfem_cutting {
namespace {

void find_sides(const VoxelVolume& volume, DualCell& cell) {
  for (int corner = 0; corner < 8; ++corner) {
    const int v = volume.find(cell.index + Vec3i(corner & 1, corner >> 1 & 1, corner >> 2));
    const bool tissue = v >= 0 && volume.voxel(v).linked();
    cell.voxel[corner] = tissue ? v : -1;
    if (!tissue) continue;
    for (int axis = 0; axis < 3; ++axis)
      if (volume.voxel(v).link[direction_from(corner, axis)] != LinkState::kIntact)
        cell.sides |= SideMask{1} << (3 * corner + axis);
  }
}

/// Follows the arcs from a side through the cell's faces until they close.
Sheet trace_sheet(const DualCell& cell, LocalSide first) {
  Sheet sheet;
  sheet.voxel = cell.voxel[first / 3];
  LocalSide side = first;
  int normal_axis = (first % 3 + 1) % 3;
  do {
    sheet.sides |= SideMask{1} << side;
    side = cell.arc_end(side, normal_axis);
    normal_axis = 3 - side % 3 - normal_axis;  // the side's other face
  } while (side != first);
  return sheet;
}

void find_sheets(DualCell& cell) {
  cell.sheet_of_side.fill(-1);
  for (LocalSide side = 0; side < kLocalSides; ++side) {
    if (!cell.has_side(side) || cell.sheet_of_side[side] >= 0) continue;
    const Sheet sheet = trace_sheet(cell, side);
    for (LocalSide s = side; s < kLocalSides; ++s)
      if (sheet.sides >> s & 1) cell.sheet_of_side[s] = static_cast<int>(cell.sheets.size());
    cell.sheets.push_back(sheet);
  }
}

/// One number for all sheets that severed links join, by relabelling: a cell has eight sheets at most.
std::vector<int> join_across_cuts(const DualCell& cell) {
  std::vector<int> label(cell.sheets.size());
  std::iota(label.begin(), label.end(), 0);
  for (LocalSide side = 0; side < kLocalSides; ++side) {
    if (!cell.has_side(side) || !cell.has_side(across(side))) continue;
    const int a = label[cell.sheet_of_side[side]];
    const int b = label[cell.sheet_of_side[across(side)]];
    std::replace(label.begin(), label.end(), std::max(a, b), std::min(a, b));
  }
  return label;
}

void describe_group(const DualCell& cell, SheetGroup& group) {
  for (LocalSide side = 0; side < kLocalSides; ++side) {
    if (!(group.sides >> side & 1)) continue;
    const bool severed = cell.has_side(across(side));
    (severed ? group.severed : group.skin) = true;
    if (severed && cell.sheet_of_side[side] == cell.sheet_of_side[across(side)]) group.cut_end = true;
  }
}

void group_sheets(DualCell& cell) {
  const std::vector<int> label = join_across_cuts(cell);
  std::vector<int> group_of_label(label.size(), -1);
  for (std::size_t s = 0; s < cell.sheets.size(); ++s) {
    int& group = group_of_label[label[s]];
    if (group < 0) {
      group = static_cast<int>(cell.groups.size());
      cell.groups.emplace_back();
    }
    cell.sheets[s].group = group;
    cell.groups[group].sides |= cell.sheets[s].sides;
  }
  for (SheetGroup& group : cell.groups) describe_group(cell, group);
}

struct Planes {
  ErrorFunction skin, cut;
};

/// A severed link counts once.
Planes planes_of(const VoxelVolume& volume, const DualCell& cell, const SheetGroup& group) {
  Planes planes;
  for (LocalSide side = 0; side < kLocalSides; ++side) {
    if (!(group.sides >> side & 1)) continue;
    const bool severed = cell.has_side(across(side));
    if (severed && across(side) < side) continue;
    (severed ? planes.cut : planes.skin)
        .add(volume.crossing(cell.voxel[side / 3], direction_from(side / 3, side % 3)));
  }
  return planes;
}

/// Of several groups in a cell, minima may lie beyond each other; means don't.
Vec3 place(const VoxelVolume& volume, const DualCell& cell, const SheetGroup& group) {
  const Planes planes = planes_of(volume, cell, group);
  const Box room = room_in_cell(volume.lattice(), cell.index);
  return cell.groups.size() > 1 ? mean(planes.skin, planes.cut, room)
                                : minimum(planes.skin, planes.cut, room);
}

}  // namespace

Box room_in_cell(const Lattice& lattice, const Vec3i& index) {
  constexpr double kMargin = 0.005;  // of a cell's edge
  const Vec3 low = lattice.centre(index);
  const Vec3 margin = kMargin * lattice.spacing;
  return {low + margin, low + lattice.spacing - margin};
}

LocalSide DualCell::arc_end(LocalSide side, int normal_axis) const {
  int corner = side / 3;
  int axis = 3 - side % 3 - normal_axis;
  while (intact(corner, axis)) {
    corner ^= 1 << axis;
    axis = 3 - axis - normal_axis;
  }
  return 3 * corner + axis;
}

bool is_other_tissue(const VoxelVolume& volume, const DualCell& cell, int group, int voxel) {
  for (LocalSide side = 0; side < kLocalSides; ++side) {
    const bool bounds = cell.groups[group].sides >> side & 1;
    if (bounds && !are_parted(volume, cell.voxel[side / 3], voxel)) return false;
  }
  return true;
}

Vec3 onto_skin(const Vec3& X, const VoxelVolume& volume, const DualCell& cell, const SheetGroup& group) {
  const ErrorFunction skin = planes_of(volume, cell, group).skin;
  return skin.empty() ? X : Vec3(X + skin.way_to_minimum(X, kCrease));
}

DualCell contour_cell(const VoxelVolume& volume, const Vec3i& index) {
  DualCell cell;
  cell.index = index;
  find_sides(volume, cell);
  find_sheets(cell);
  group_sheets(cell);
  for (SheetGroup& group : cell.groups) group.minimum = place(volume, cell, group);
  return cell;
}

}  // namespace cfem_cutting
