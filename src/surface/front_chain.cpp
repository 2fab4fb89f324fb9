#include "front_chain.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "cfem_cutting/geometry/polyline.h"
#include "cfem_cutting/volume/inside.h"
#include "front_walk.h"
#include "polygon.h"

namespace cfem_cutting {
namespace {

// What a chain costs, in voxel edges of stretch.
constexpr double kShortPiece = 0.1;   // of a voxel: shorter pieces of the trace would give needles
constexpr double kDetour = 0.3;       // for a vertex whose cell the trace does not pass
constexpr double kOtherTissue = 1.0;  // for a vertex across a cut from the tissue where it would be
constexpr double kBreak = 3.0;        // for vertices that nothing joins
constexpr double kUncovered = 5.0;    // for each voxel of the trace's length, where one vertex stands for all
constexpr double kNearest = 0.005;    // of a voxel, between vertices
constexpr double kWidestGap = 1.0;    // in voxels, that is closed where the surface joins no vertices

/// A group that may become part of the chain.
struct Node {
  int cell = -1, group = -1;
  int piece = 0;          // of the walk, the nearest
  Vec3 X = Vec3::Zero();  // m, on the trace
  double along = 0.0;     // m, on the trace
  double cost = 0.0;
  double start = 0.0;  // of the chain's part so far if it begins here
  // Of the best chain of two or more that ends here:
  double total = std::numeric_limits<double>::infinity();
  int before = -1;
  bool continues = false;

  bool begins() const { return start <= total; }
  double best() const { return std::min(start, total); }
};

class ChainFinder {
 public:
  ChainFinder(const Contour& contour, const Trace& trace, const std::set<Diagonal>& avoided)
      : contour_(contour),
        trace_(trace),
        avoided_(avoided),
        h_(contour.volume().lattice().spacing.minCoeff()),
        walk_(walk_dual_cells(contour.volume().lattice(), trace.points)) {
    double from = 0.0;
    for (const FrontPiece& piece : walk_) {
      from_.push_back(from);
      from += piece.length;
    }
    from_.push_back(from);
  }

  std::vector<ChainLink> find() {
    add_nodes_on_walk();
    add_nodes_beside();
    std::stable_sort(nodes_.begin(), nodes_.end(),
                     [](const Node& a, const Node& b) { return a.along < b.along; });
    join_nodes();
    return chain_to(best_end());
  }

 private:
  /// Of a cell's groups those where a cut ends, else those with skin, but for those on other chains.
  std::vector<int> eligible(const DualCell& cell) const {
    std::vector<int> groups;
    const bool cut_ends = std::any_of(cell.groups.begin(), cell.groups.end(),
                                      [](const SheetGroup& group) { return group.cut_end; });
    for (std::size_t g = 0; g < cell.groups.size(); ++g) {
      const SheetGroup& group = cell.groups[g];
      if (group.chain < 0 && (cut_ends ? group.cut_end : group.skin)) groups.push_back(static_cast<int>(g));
    }
    return groups;
  }

  void add_nodes_on_walk() {
    passable_.assign(walk_.size(), false);
    for (std::size_t i = 0; i < walk_.size(); ++i)
      for (const Vec3i& index : cells_along(contour_.volume().lattice(), walk_[i])) {
        on_walk_.insert(key(index));
        const int c = contour_.find(index);
        if (c >= 0) add_nodes_in(contour_.cells()[c], c, i);
      }
  }

  void add_nodes_in(const DualCell& cell, int c, std::size_t i) {
    const Box room = room_in_cell(contour_.volume().lattice(), cell.index)
                         .merged(room_in_cell(contour_.volume().lattice(), walk_[i].cell));
    for (const int group : eligible(cell)) {
      const Vec3 X = project_within(walk_[i], cell.groups[group].minimum, room);
      const double stretch = (X - cell.groups[group].minimum).norm() / h_;
      const double shortness = std::max(0.0, 1.0 - walk_[i].length / (kShortPiece * h_));
      nodes_.push_back(make(c, group, i, X, 0.01 * stretch * stretch + kShortPiece * shortness));
      passable_[i] = true;
    }
  }

  /// The cells around those that the trace passes.
  void add_nodes_beside() {
    std::map<std::array<int, 3>, std::pair<double, Node>> best;  // by cell and group
    for (std::size_t i = 0; i < walk_.size(); ++i)
      for (int n = 0; n < 27; ++n) {
        const Vec3i index = walk_[i].cell + Vec3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
        const int c = on_walk_.count(key(index)) > 0 ? -1 : contour_.find(index);
        if (c < 0) continue;
        for (const int group : eligible(contour_.cells()[c])) consider(c, group, i, best);
      }
    for (const auto& entry : best) nodes_.push_back(entry.second.second);
  }

  void consider(int c, int group, std::size_t piece,
                std::map<std::array<int, 3>, std::pair<double, Node>>& best) const {
    const Vec3& minimum = contour_.cells()[c].groups[group].minimum;
    const Polyline& points = walk_[piece].points;
    const Vec3 X = points.size() == 1 ? points[0] : project(points, minimum).point;
    const double stretch = (X - minimum).norm() / h_;
    const auto [at, fresh] = best.try_emplace({c, group, 0}, stretch, Node{});
    if (!fresh && at->second.first <= stretch) return;
    at->second = {stretch, make(c, group, piece, X, kDetour + stretch * stretch)};
  }

  Node make(int cell, int group, std::size_t piece, const Vec3& X, double cost) const {
    Node node;
    node.cell = cell;
    node.group = group;
    node.piece = static_cast<int>(piece);
    node.X = X;
    node.along = from_[piece] + along_in(walk_[piece].points, X);
    const int voxel = tissue_voxel_at(contour_.volume(), X);
    const bool elsewhere =
        voxel >= 0 && is_other_tissue(contour_.volume(), contour_.cells()[cell], group, voxel);
    node.cost = cost + (elsewhere ? kOtherTissue : 0.0);
    return node;
  }

  static double along_in(const Polyline& points, const Vec3& X) {
    if (points.size() < 2) return 0.0;
    return arc_length(points, project(points, X));
  }

  /// Edges and diagonals of the surface between nodes.
  void join_nodes() {
    joined_.assign(nodes_.size(), {});
    std::map<std::pair<int, int>, std::vector<int>> nodes_of;
    std::set<LinkSide> sides;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      nodes_of[{nodes_[n].cell, nodes_[n].group}].push_back(static_cast<int>(n));
      const DualCell& cell = contour_.cells()[nodes_[n].cell];
      for (LocalSide s = 0; s < kLocalSides; ++s)
        if (cell.has_side(s) && cell.sheets[cell.sheet_of_side[s]].group == nodes_[n].group)
          sides.insert(kDirections * cell.voxel[s / 3] + direction_from(s / 3, s % 3));
    }
    const auto join = [&](const Polygon& p, int i, int j) {
      const auto a = nodes_of.find({p.cell[i], p.group(contour_, i)});
      const auto b = nodes_of.find({p.cell[j], p.group(contour_, j)});
      if (a == nodes_of.end() || b == nodes_of.end()) return;
      for (const int m : a->second)
        for (const int n : b->second) joined_[std::max(m, n)].push_back(std::min(m, n));
    };
    for (const LinkSide side : sides) {
      const Polygon polygon = polygon_of(contour_, side);
      if (polygon.lone) continue;
      for (int i = 0; i < 4; ++i)
        if (!polygon.midpoint[i]) join(polygon, i, (i + 1) % 4);
      for (const int i : {0, 1})
        if (!polygon.fan && !is_avoided(polygon, i)) join(polygon, i, i + 2);
    }
  }

  bool is_avoided(const Polygon& p, int i) const {
    const auto group = [&](int k) { return std::pair(p.cell[k], p.group(contour_, k)); };
    return avoided_.count(diagonal_between(group(i), group(i + 2))) > 0;
  }

  /// Lengths of pieces between two that could have had a vertex.
  double left_out(int first, int last) const {
    double length = 0.0;
    for (int i = first; i < last; ++i)
      if (passable_[i]) length += walk_[i].length;
    return length / h_;
  }

  /// Dynamic programming: nodes ascend along the trace, and so do chains.
  int best_end() {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int n = 0; n < static_cast<int>(nodes_.size()); ++n) {
      Node& node = nodes_[n];
      node.start = node.cost + left_out(0, node.piece) + 0.5 * node.along / h_;
      for (const int m : joined_[n]) follow(m, n, 0.0, true);
      for (int m = 0; m < n; ++m) follow(m, n, kBreak + (node.along - nodes_[m].along) / h_, false);
      const int last = static_cast<int>(walk_.size());
      const double tail = left_out(node.piece + 1, last) + 0.5 * (from_.back() - node.along) / h_;
      const double alone = node.start + kUncovered * from_.back() / h_;
      const double total = tail + std::min(node.total, alone);
      if (total >= least) continue;
      best = n;
      least = total;
      alone_ = alone < node.total;
    }
    return best;
  }

  void follow(int m, int n, double cost, bool continues) {
    const Node& before = nodes_[m];
    Node& node = nodes_[n];
    if (node.along - before.along < kNearest * h_) return;
    const double total = before.best() + node.cost + cost + left_out(before.piece + 1, node.piece);
    if (total >= node.total || is_passed(m, node)) return;
    node.total = total;
    node.before = m;
    node.continues = continues;
  }

  /// Whether the best chain to m has the node's vertex already: a trace that turns back comes by it twice.
  bool is_passed(int m, const Node& node) const {
    for (;; m = nodes_[m].before) {
      if (nodes_[m].cell == node.cell && nodes_[m].group == node.group) return true;
      if (nodes_[m].begins()) return false;
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
    for (bool begins = alone_;; first = nodes_[first].before, begins = nodes_[first].begins()) {
      const Node& node = nodes_[first];
      chain.push_back({node.cell, node.group, node.X, EdgeEnd::kNone, !begins && node.continues});
      along.push_back(node.along);
      if (begins) break;
    }
    const double head = nodes_[first].along, tail = from_.back() - nodes_[end].along;
    const bool alone = chain.size() == 1;
    if (!alone || tail <= head)
      put_at_end(chain.front(), trace_.points.back(), trace_.tip ? EdgeEnd::kTip : EdgeEnd::kNone);
    if (!alone || tail > head)
      put_at_end(chain.back(), trace_.points.front(), trace_.heel ? EdgeEnd::kHeel : EdgeEnd::kNone);
    std::reverse(chain.begin(), chain.end());
    std::reverse(along.begin(), along.end());
    close_gaps(along, chain);
    return chain;
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

  static std::array<int, 3> key(const Vec3i& index) { return {index.x(), index.y(), index.z()}; }

  const Contour& contour_;
  const Trace& trace_;
  const std::set<Diagonal>& avoided_;
  double h_;
  std::vector<FrontPiece> walk_;
  std::vector<double> from_;  // m, along the trace, where each piece begins; and the end
  std::vector<bool> passable_;
  std::set<std::array<int, 3>> on_walk_;
  std::vector<Node> nodes_;
  bool alone_ = false;                    // the chain is a single vertex
  std::vector<std::vector<int>> joined_;  // nodes before
};

}  // namespace

std::vector<ChainLink> find_chain(const Contour& contour, const Trace& trace,
                                  const std::set<Diagonal>& avoided) {
  return ChainFinder(contour, trace, avoided).find();
}

}  // namespace cfem_cutting
