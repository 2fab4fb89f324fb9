#include "adaptation.h"

#include <algorithm>

#include "front_chain.h"

namespace cfem_cutting {
namespace {

/// Where traces come to a group twice, the shorter way counts.
void bind(SheetGroup& group, const ChainLink& link) {
  if (group.adapted && (link.X - group.minimum).norm() >= (*group.adapted - group.minimum).norm()) return;
  group.adapted = link.X;
  group.edge_end = link.edge_end;
}

}  // namespace

void adapt(Contour& contour, const FrontTrace& trace, bool moves) {
  for (DualCell& cell : contour.cells())
    for (SheetGroup& group : cell.groups) {
      group.adapted.reset();
      group.chain = -1;
      group.edge_end = EdgeEnd::kNone;
    }
  int number = 0;
  for (const Trace& part : trace) {
    ++number;
    for (const ChainLink& link : find_chain(contour, part)) {
      SheetGroup& group = contour.cells()[link.cell].groups[link.group];
      group.chain = link.continues ? ++number : number += 2;
      if (moves) bind(group, link);
    }
  }
}

void retract(Contour& contour, int cell, int group) {
  const Box room = room_in_cell(contour.volume().lattice(), contour.cells()[cell].index);
  SheetGroup& of_sheets = contour.cells()[cell].groups[group];
  std::optional<Vec3>& X = of_sheets.adapted ? of_sheets.adapted : of_sheets.frozen;
  if (X) X = X->cwiseMax(room.min()).cwiseMin(room.max());
}

void end_on_cut(Contour& contour, const SurfaceExtractor::NearestOnCut& nearest) {
  for (DualCell& cell : contour.cells()) {
    if (cell.groups.size() != 1 || !cell.groups[0].cut_end) continue;  // several may not pass each other
    SheetGroup& group = cell.groups[0];
    if (group.adapted || group.frozen) continue;
    const std::optional<Vec3> X = nearest(group.minimum);
    if (X) group.frozen = minimum_towards(*X, contour.volume(), cell, group);
  }
}

void freeze_cut_ends(Contour& contour) {
  for (DualCell& cell : contour.cells())
    for (SheetGroup& group : cell.groups)
      if (group.cut_end && group.adapted) group.frozen = group.adapted;
}

}  // namespace cfem_cutting
