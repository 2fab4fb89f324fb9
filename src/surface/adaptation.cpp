#include "adaptation.h"

#include <algorithm>

namespace cfem_cutting {
namespace {

double length_of(const Polyline& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

/// Two traces may pass the same vertices: the longer one takes them.
std::vector<const Trace*> longest_first(const FrontTrace& trace) {
  std::vector<std::pair<double, const Trace*>> parts;
  for (const Trace& part : trace) parts.emplace_back(length_of(part.points), &part);
  std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<const Trace*> sorted;
  for (const auto& part : parts) sorted.push_back(part.second);
  return sorted;
}

using Nearest = SurfaceExtractor::NearestOnCut;

bool is_near(const Contour& contour, const Vec3& a, const Vec3& b) {
  constexpr double kNear = 0.02;  // of a voxel
  return (a - b).norm() < kNear * contour.volume().lattice().spacing.minCoeff();
}

/// From X to the cut and by turns to what `other` leads to, and back; nothing if there is no cut near.
template <typename Other>
std::optional<Vec3> to_cut_and(const Contour& contour, const Vec3& X, const Nearest& nearest,
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

}  // namespace

void adapt(Contour& contour, const FrontTrace& trace, bool moves, const std::set<Diagonal>& avoided) {
  for (DualCell& cell : contour.cells())
    for (SheetGroup& group : cell.groups) {
      group.adapted.reset();
      group.drawn_back.reset();
      group.chain = -1;
      group.edge_end = EdgeEnd::kNone;
    }
  int number = 0;
  for (const Trace* part : longest_first(trace)) {
    ++number;
    for (const ChainLink& link : find_chain(contour, *part, avoided)) {
      SheetGroup& group = contour.cells()[link.cell].groups[link.group];
      group.chain = link.continues ? ++number : number += 2;
      if (!moves) continue;
      group.adapted = link.X;
      group.edge_end = link.edge_end;
    }
  }
}

bool draw_back(Contour& contour, int cell, int group, const Nearest& nearest) {
  const Box room = room_in_cell(contour.volume().lattice(), contour.cells()[cell].index);
  SheetGroup& of_sheets = contour.cells()[cell].groups[group];
  const auto into_cell = [&](const Vec3& X) -> Vec3 { return X.cwiseMax(room.min()).cwiseMin(room.max()); };
  const Vec3 from = of_sheets.X();
  if (of_sheets.adapted) {
    of_sheets.drawn_back = into_cell(*of_sheets.adapted);
  } else if (of_sheets.drawn_back) {
    of_sheets.drawn_back = of_sheets.minimum;
  } else {
    of_sheets.drawn_back =
        into_cell(nearest ? to_cut_and(contour, from, nearest, into_cell).value_or(from) : from);
  }
  return of_sheets.X() != from;
}

void settle_on_cut(Contour& contour, const Nearest& nearest) {
  for (DualCell& cell : contour.cells()) {
    if (cell.groups.size() != 1 || !cell.groups[0].severed) continue;
    SheetGroup& group = cell.groups[0];
    const bool held = group.adapted && group.cut_end;
    if (group.settled || (held && !group.skin)) continue;
    const auto onto_its_skin = [&](const Vec3& X) { return onto_skin(X, contour.volume(), cell, group); };
    const Vec3 start = held ? group.X() : group.frozen.value_or(group.minimum);
    const std::optional<Vec3> X = to_cut_and(contour, start, nearest, onto_its_skin);
    group.settled = X.has_value();
    if (X && (held || !is_near(contour, *X, start))) group.frozen = X;
  }
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
