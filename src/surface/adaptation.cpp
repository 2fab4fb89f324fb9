#include "adaptation.h"

#include <algorithm>
#include <limits>

#include "front_walk.h"

namespace cfem_cutting {
namespace {

/// Shorter pieces of the trace, in voxel edges, would give needles; their cells are left out where the chain
/// of vertices can go on over the diagonal of a quad …
constexpr double kShortPiece = 0.1;
/// … and at the trace's ends.
constexpr double kShortEnd = 0.01;

/// A piece of the trace with the sheets that it moves.
struct Bound {
  FrontPiece piece;
  int cell;   ///< in Contour::cells()
  int group;  ///< in DualCell::groups
};

/// The nearest group of those where a cut ends, else of those with skin; −1: only faces of an open cut, or
/// nothing.
int choose_group(const DualCell& cell, const FrontPiece& piece, const Box& room) {
  int best = -1;
  double best_distance = std::numeric_limits<double>::infinity();
  for (const bool cut_end : {true, false}) {
    for (std::size_t g = 0; g < cell.groups.size(); ++g) {
      const SheetGroup& group = cell.groups[g];
      if (!(cut_end ? group.cut_end : group.skin)) continue;
      const double distance = (project_within(piece, group.minimum, room) - group.minimum).norm();
      if (distance >= best_distance) continue;
      best = static_cast<int>(g);
      best_distance = distance;
    }
    if (best >= 0) return best;
  }
  return best;
}

std::vector<Bound> find_bound(const Contour& contour, const Polyline& polyline) {
  const Lattice& lattice = contour.volume().lattice();
  std::vector<Bound> bound;
  for (FrontPiece& piece : walk_dual_cells(lattice, polyline)) {
    const int cell = contour.find(piece.cell);
    const Box room = room_in_cell(lattice, piece.cell);
    const int group = cell < 0 ? -1 : choose_group(contour.cells()[cell], piece, room);
    if (group >= 0) bound.push_back({std::move(piece), cell, group});
  }
  return bound;
}

bool leaves_tissue(const VoxelVolume& volume, const Vec3i& index, int direction) {
  const int v = volume.find(index);
  return v >= 0 && volume.voxel(v).linked() && volume.voxel(v).link[direction] != LinkState::kIntact;
}

/// Whether two cells share just a link, and that link has a quad: its diagonal can join their vertices.
bool share_quad(const VoxelVolume& volume, const Vec3i& a, const Vec3i& b) {
  const Vec3i apart = (a - b).cwiseAbs();
  if (apart.maxCoeff() != 1 || apart.sum() != 2) return false;
  int axis = 0;
  apart.minCoeff(&axis);
  const Vec3i lower = a.cwiseMax(b);
  return leaves_tissue(volume, lower, 2 * axis + 1) ||
         leaves_tissue(volume, lower + Vec3i::Unit(axis), 2 * axis);
}

std::vector<Bound> without_short(const Contour& contour, std::vector<Bound> bound) {
  const double h = contour.volume().lattice().spacing.minCoeff();
  std::vector<Bound> kept;
  for (std::size_t i = 0; i < bound.size(); ++i) {
    const double length = bound[i].piece.length;
    const bool at_end = kept.empty() || i + 1 == bound.size();
    const bool dispensable =
        at_end ? length < kShortEnd * h && bound.size() > 1
               : length < kShortPiece * h &&
                     share_quad(contour.volume(), kept.back().piece.cell, bound[i + 1].piece.cell);
    if (!dispensable) kept.push_back(std::move(bound[i]));
  }
  return kept;
}

/// Where a trace comes back to a cell, the shorter way counts.
void bind(SheetGroup& group, const FrontPiece& piece, const Box& room) {
  const Vec3 X = project_within(piece, group.minimum, room);
  if (!group.adapted || (X - group.minimum).norm() < (*group.adapted - group.minimum).norm())
    group.adapted = X;
}

}  // namespace

void adapt(Contour& contour, const FrontTrace& trace) {
  for (DualCell& cell : contour.cells())
    for (SheetGroup& group : cell.groups) group.adapted.reset();
  for (const Polyline& polyline : trace)
    for (const Bound& b : without_short(contour, find_bound(contour, polyline)))
      bind(contour.cells()[b.cell].groups[b.group], b.piece,
           room_in_cell(contour.volume().lattice(), b.piece.cell));
}

bool holds_crease(const DualCell& cell) {
  return std::any_of(cell.groups.begin(), cell.groups.end(),
                     [](const SheetGroup& group) { return group.cut_end || group.skin; });
}

void freeze_cut_ends(Contour& contour) {
  for (DualCell& cell : contour.cells())
    for (SheetGroup& group : cell.groups)
      if (group.cut_end && group.adapted) group.frozen = group.adapted;
}

}  // namespace cfem_cutting
