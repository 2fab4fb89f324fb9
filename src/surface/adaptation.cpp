#include "adaptation.h"

#include <algorithm>

namespace cfem_cutting {
namespace {

double length_of(const Trace& trace) { return trace.points.empty() ? 0.0 : arc_lengths(trace.points).back(); }

/// Two traces may pass the same vertices: the longer one takes them.
std::vector<const Trace*> longest_first(const FrontTrace& trace) {
  std::vector<const Trace*> sorted;
  sorted.reserve(trace.size());
  for (const Trace& part : trace) sorted.push_back(&part);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Trace* a, const Trace* b) { return length_of(*a) > length_of(*b); });
  return sorted;
}

}  // namespace

void adapt(Contour& contour, const FrontTrace& trace, bool moves, const std::set<Diagonal>& avoided,
           std::vector<int>& cells) {
  for (const int cell : cells)
    for (SheetGroup& group : contour.cells()[cell].groups) {
      group.adapted.reset();
      group.drawn_back.reset();
      group.times_drawn_back = 0;
      group.chain = -1;
      group.edge_end = EdgeEnd::kNone;
    }
  int number = 0;
  for (const Trace* part : longest_first(trace)) {
    ++number;
    for (const ChainLink& link : find_chain(contour, *part, avoided)) {
      SheetGroup& group = contour.cells()[link.cell].groups[link.group];
      cells.push_back(link.cell);
      group.chain = link.continues ? ++number : number += 2;
      if (!moves) continue;
      group.adapted = link.X;
      group.edge_end = link.edge_end;
    }
  }
}

bool follows_trace(const DualCell& cell) {
  return std::any_of(cell.groups.begin(), cell.groups.end(), [](const SheetGroup& group) {
    return group.chain >= 0 || group.adapted || group.times_drawn_back > 0;
  });
}

void freeze_cut_ends(Contour& contour, bool at_skin) {
  for (DualCell& cell : contour.cells())
    for (SheetGroup& group : cell.groups)
      if (group.cut_end && group.adapted && (at_skin || !group.skin)) {
        group.frozen = group.X();
        group.settled = false;
      }
}

}  // namespace cfem_cutting
