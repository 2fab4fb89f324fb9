#include "front_chain.h"

#include <algorithm>
#include <limits>

#include "cfem_cutting/geometry/polyline.h"
#include "chain_candidates.h"

namespace cfem_cutting {
namespace {

using Candidate = ChainCandidates::Candidate;

// What a chain costs, in voxel edges of stretch, besides its candidates.
constexpr double kBreak = 3.0;      // for vertices that nothing joins
constexpr double kGap = 10.0;       // for each voxel between them, but for the first half
constexpr double kBeyond = 3.0;     // for each voxel beyond the first and the last, but for half of one
constexpr double kUncovered = 5.0;  // for each voxel of the trace's length, where one vertex stands for all
constexpr double kNearest = 0.005;  // of a voxel, between vertices
constexpr double kWidestGap = 1.0;  // in voxels, that is closed where the surface joins no vertices

/// Of the best chain that ends at a candidate.
struct Best {
  double start = 0.0;  // if the chain begins here
  // Of two vertices or more:
  double total = std::numeric_limits<double>::infinity();
  int before = -1;
  bool continues = false;

  bool begins() const { return start <= total; }
  double least() const { return std::min(start, total); }
};

class ChainFinder {
 public:
  ChainFinder(const Contour& contour, const Trace& trace, const std::set<Diagonal>& avoided)
      : trace_(trace),
        avoided_(avoided),
        h_(contour.volume().lattice().spacing.minCoeff()),
        candidates_(contour, trace, avoided),
        best_(candidates_.size()) {}

  std::vector<ChainLink> find() { return chain_to(best_end()); }

 private:
  /// Dynamic programming: candidates ascend along the trace, and so do chains.
  int best_end() {
    int end = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int n = 0; n < candidates_.size(); ++n) {
      const Candidate& candidate = candidates_[n];
      Best& best = best_[n];
      best.start = candidate.cost + candidates_.left_out(0, candidate.piece) + beyond(candidate.along);
      for (const int m : candidates_.joined_before(n)) follow(m, n, 0.0, true);
      for (int m = 0; m < n; ++m) follow(m, n, gap(candidate.along - candidates_[m].along), false);
      const double tail = candidates_.left_out(candidate.piece + 1, candidates_.piece_count()) +
                          beyond(candidates_.length() - candidate.along);
      const double alone = best.start + kUncovered * candidates_.length() / h_;
      const double total = tail + std::min(best.total, alone);
      if (total >= least) continue;
      end = n;
      least = total;
      alone_ = alone < best.total;
    }
    return end;
  }

  /// Of a length, m, of the trace that a vertex at its end has to be stretched over.
  double beyond(double length) const {
    return 0.5 * length / h_ + kBeyond * std::max(0.0, length / h_ - 0.5);
  }

  /// Of a length, m, of the trace that has no surface.
  double gap(double length) const { return kBreak + length / h_ + kGap * std::max(0.0, length / h_ - 0.5); }

  void follow(int m, int n, double cost, bool continues) {
    const Candidate &before = candidates_[m], &candidate = candidates_[n];
    if (candidate.along - before.along < kNearest * h_) return;
    const double total =
        best_[m].least() + candidate.cost + cost + candidates_.left_out(before.piece + 1, candidate.piece);
    if (total >= best_[n].total || is_passed(m, candidate)) return;
    best_[n].total = total;
    best_[n].before = m;
    best_[n].continues = continues;
  }

  /// Whether the best chain to m has the candidate's vertex already: a trace that turns back comes by it
  /// twice.
  bool is_passed(int m, const Candidate& candidate) const {
    for (;; m = best_[m].before) {
      if (candidates_[m].cell == candidate.cell && candidates_[m].group == candidate.group) return true;
      if (best_[m].begins()) return false;
    }
  }

  static void put_at_end(ChainLink& link, const Vec3& X, EdgeEnd edge_end) {
    link.X = X;
    link.edge_end = edge_end;
  }

  std::vector<ChainLink> chain_to(int end) const {
    std::vector<ChainLink> chain;
    std::vector<double> along;
    if (end < 0) return chain;
    int first = end;
    for (bool begins = alone_;; first = best_[first].before, begins = best_[first].begins()) {
      const Candidate& candidate = candidates_[first];
      chain.push_back(
          {candidate.cell, candidate.group, candidate.X, EdgeEnd::kNone, !begins && best_[first].continues});
      along.push_back(candidate.along);
      if (begins) break;
    }
    const bool alone = chain.size() == 1, to_tip = goes_to_tip(along.front());
    if (!alone || to_tip)
      put_at_end(chain.front(), trace_.points.back(), trace_.tip ? EdgeEnd::kTip : EdgeEnd::kNone);
    if (!alone || !to_tip)
      put_at_end(chain.back(), trace_.points.front(), trace_.heel ? EdgeEnd::kHeel : EdgeEnd::kNone);
    std::reverse(chain.begin(), chain.end());
    std::reverse(along.begin(), along.end());
    close_gaps(along, chain);
    return chain;
  }

  /// To which end of the trace a lone vertex goes: to one in tissue, where the dent is deepest, or the
  /// nearer.
  bool goes_to_tip(double along) const {
    return trace_.tip != trace_.heel ? trace_.tip : 2.0 * along >= candidates_.length();
  }

  /// Neighbours that nothing joins meet halfway, where each goes on the other way; the trace's ends stay.
  /// @param along m, of the links on the trace
  void close_gaps(const std::vector<double>& along, std::vector<ChainLink>& chain) const {
    const std::size_t count = chain.size();
    for (std::size_t i = 1; i < count; ++i) {
      const bool first = i == 1, last = i + 1 == count;
      const bool alone =
          (first && last) || (!first && !chain[i - 1].continues) || (!last && !chain[i + 1].continues);
      if (alone || !is_gap(chain[i - 1], chain[i])) continue;
      const Vec3 middle = point_along(trace_.points, 0.5 * (along[i - 1] + along[i]));
      const Vec3 X = first ? chain[i - 1].X : last ? chain[i].X : middle;
      chain[i - 1].X = chain[i].X = X;
    }
  }

  /// A short one, and none that a triangle beside it would be turned to close.
  bool is_gap(const ChainLink& before, const ChainLink& after) const {
    const bool avoided =
        avoided_.count(diagonal_between({before.cell, before.group}, {after.cell, after.group})) > 0;
    return !after.continues && !avoided && (after.X - before.X).norm() <= kWidestGap * h_;
  }

  const Trace& trace_;
  const std::set<Diagonal>& avoided_;
  double h_;  // m, a voxel's edge
  ChainCandidates candidates_;
  std::vector<Best> best_;
  bool alone_ = false;  // the chain is a single vertex
};

}  // namespace

std::vector<ChainLink> find_chain(const Contour& contour, const Trace& trace,
                                  const std::set<Diagonal>& avoided) {
  return ChainFinder(contour, trace, avoided).find();
}

}  // namespace cfem_cutting
