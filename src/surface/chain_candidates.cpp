#include "chain_candidates.h"

#include <algorithm>
#include <map>

#include "cfem_cutting/geometry/polyline.h"
#include "cfem_cutting/volume/inside.h"

namespace cfem_cutting {
namespace {

using Candidate = ChainCandidates::Candidate;

// Costs, in voxel edges of stretch.
constexpr double kShortPiece = 0.1;   // of a voxel: shorter pieces of the trace would give needles
constexpr double kDetour = 0.3;       // for a vertex whose cell the trace does not pass
constexpr double kOtherTissue = 1.0;  // for a vertex across a cut from the tissue where it would be

std::array<int, 3> key(const Vec3i& index) { return {index.x(), index.y(), index.z()}; }

/// Of a cell's groups those where a cut ends, else those with skin, but for those on other chains.
std::vector<int> eligible(const DualCell& cell) {
  std::vector<int> groups;
  const bool cut_ends = std::any_of(cell.groups.begin(), cell.groups.end(),
                                    [](const SheetGroup& group) { return group.cut_end; });
  for (std::size_t g = 0; g < cell.groups.size(); ++g) {
    const SheetGroup& group = cell.groups[g];
    if (group.chain < 0 && (cut_ends ? group.cut_end : group.skin)) groups.push_back(static_cast<int>(g));
  }
  return groups;
}

double along_in(const Polyline& points, const Vec3& X) {
  return points.size() < 2 ? 0.0 : arc_length(points, project(points, X));
}

Vec3 nearest_in(const Polyline& points, const Vec3& X) {
  return points.size() == 1 ? points[0] : project(points, X).point;
}

}  // namespace

ChainCandidates::ChainCandidates(const Contour& contour, const Trace& trace,
                                 const std::set<Diagonal>& avoided)
    : contour_(contour),
      h_(contour.volume().lattice().spacing.minCoeff()),
      walk_(walk_dual_cells(contour.volume().lattice(), trace.points)) {
  from_.push_back(0.0);
  for (const FrontPiece& piece : walk_) from_.push_back(from_.back() + piece.length);
  add_on_walk();
  add_beside();
  std::stable_sort(candidates_.begin(), candidates_.end(),
                   [](const Candidate& a, const Candidate& b) { return a.along < b.along; });
  join(avoided);
}

void ChainCandidates::add_on_walk() {
  passable_.assign(walk_.size(), false);
  for (std::size_t i = 0; i < walk_.size(); ++i)
    for (const Vec3i& index : cells_along(contour_.volume().lattice(), walk_[i])) {
      on_walk_.insert(key(index));
      const int c = contour_.find(index);
      if (c >= 0) add_in(contour_.cells()[c], c, i);
    }
}

void ChainCandidates::add_in(const DualCell& cell, int c, std::size_t i) {
  const Box room = room_in_cell(contour_.volume().lattice(), cell.index)
                       .merged(room_in_cell(contour_.volume().lattice(), walk_[i].cell));
  for (const int group : eligible(cell)) {
    const Vec3 X = project_within(walk_[i], cell.groups[group].minimum, room);
    const double stretch = (X - cell.groups[group].minimum).norm() / h_;
    const double shortness = std::max(0.0, 1.0 - walk_[i].length / (kShortPiece * h_));
    candidates_.push_back(make(c, group, i, X, 0.01 * stretch * stretch + kShortPiece * shortness));
    passable_[i] = true;
  }
}

/// In the cells around those that the trace passes: each group once, where it is stretched least.
void ChainCandidates::add_beside() {
  std::map<std::pair<int, int>, std::pair<double, Candidate>> best;  // by cell and group
  const auto consider = [&](int c, int group, std::size_t piece) {
    const Vec3& minimum = contour_.cells()[c].groups[group].minimum;
    const Vec3 X = nearest_in(walk_[piece].points, minimum);
    const double stretch = (X - minimum).norm() / h_;
    const auto [at, fresh] = best.try_emplace({c, group}, stretch, Candidate{});
    if (!fresh && at->second.first <= stretch) return;
    at->second = {stretch, make(c, group, piece, X, kDetour + stretch * stretch)};
  };
  for (std::size_t i = 0; i < walk_.size(); ++i)
    for (int n = 0; n < 27; ++n) {
      const Vec3i index = walk_[i].cell + Vec3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      const int c = on_walk_.count(key(index)) > 0 ? -1 : contour_.find(index);
      if (c < 0) continue;
      for (const int group : eligible(contour_.cells()[c])) consider(c, group, i);
    }
  for (const auto& entry : best) candidates_.push_back(entry.second.second);
}

Candidate ChainCandidates::make(int cell, int group, std::size_t piece, const Vec3& X, double cost) const {
  Candidate candidate;
  candidate.cell = cell;
  candidate.group = group;
  candidate.piece = static_cast<int>(piece);
  candidate.X = X;
  candidate.along = from_[piece] + along_in(walk_[piece].points, X);
  const int voxel = tissue_voxel_at(contour_.volume(), X);
  const bool elsewhere =
      voxel >= 0 && is_other_tissue(contour_.volume(), contour_.cells()[cell], group, voxel);
  candidate.cost = cost + (elsewhere ? kOtherTissue : 0.0);
  return candidate;
}

/// The sides of links at candidates' sheets.
std::set<LinkSide> ChainCandidates::sides() const {
  std::set<LinkSide> sides;
  for (const Candidate& candidate : candidates_) {
    const DualCell& cell = contour_.cells()[candidate.cell];
    for (LocalSide s = 0; s < kLocalSides; ++s)
      if (cell.has_side(s) && cell.sheets[cell.sheet_of_side[s]].group == candidate.group)
        sides.insert(kDirections * cell.voxel[s / 3] + direction_from(s / 3, s % 3));
  }
  return sides;
}

/// Whether a cut ends on both sides of a face, so that its sides can meet there.
bool ChainCandidates::is_in_slit(const Polygon& polygon, int i) const {
  const auto is_cut_end = [&](int corner) {
    return contour_.cells()[polygon.cell[corner]].groups[polygon.group(contour_, corner)].cut_end;
  };
  return polygon.severed && is_cut_end(i) && is_cut_end((i + 1) % 4);
}

/// By edges and diagonals of the surface.
void ChainCandidates::join(const std::set<Diagonal>& avoided) {
  joined_.assign(candidates_.size(), {});
  std::map<std::pair<int, int>, std::vector<int>> of_group;
  for (int n = 0; n < size(); ++n) of_group[{candidates_[n].cell, candidates_[n].group}].push_back(n);
  const auto group = [&](const Polygon& p, int i) { return std::pair(p.cell[i], p.group(contour_, i)); };
  const auto join = [&](const Polygon& p, int i, int j) {
    const auto a = of_group.find(group(p, i)), b = of_group.find(group(p, j));
    if (a == of_group.end() || b == of_group.end()) return;
    for (const int m : a->second)
      for (const int n : b->second) joined_[std::max(m, n)].push_back(std::min(m, n));
  };
  for (const LinkSide side : sides()) {
    const Polygon polygon = polygon_of(contour_, side);
    if (polygon.lone) continue;
    for (int i = 0; i < 4; ++i)
      if (!polygon.midpoint[i] || is_in_slit(polygon, i)) join(polygon, i, (i + 1) % 4);
    for (const int i : {0, 1})
      if (!polygon.fan && avoided.count(diagonal_between(group(polygon, i), group(polygon, i + 2))) == 0)
        join(polygon, i, i + 2);
  }
}

double ChainCandidates::left_out(int first, int last) const {
  double length = 0.0;
  for (int i = first; i < last; ++i)
    if (passable_[i]) length += walk_[i].length;
  return length / h_;
}

}  // namespace cfem_cutting
