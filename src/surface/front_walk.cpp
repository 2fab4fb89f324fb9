#include "front_walk.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cfem_cutting/geometry/polyline.h"

namespace cfem_cutting {
namespace {

/// Cells: rounding that still counts as on a boundary.
constexpr double kOnBoundary = 1e-9;

/// Cells: how near a face a piece runs along it.
constexpr double kAlongFace = 0.05;

/// Part of a piece's length at which projections keep off its ends.
constexpr double kEndMargin = 0.05;

/// In units of cells, the boundaries at whole numbers.
Vec3 to_cells(const Lattice& lattice, const Vec3& X) {
  return (X - lattice.origin).cwiseQuotient(lattice.spacing).array() - 0.5 + kOnBoundary;
}

/// Positions in the segment, ascending from 0 to 1, where it passes from cell to cell.
std::vector<double> boundaries(const Vec3& from, const Vec3& to) {
  std::vector<double> at{0.0, 1.0};
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax(from[axis], to[axis]);
    for (double plane = std::ceil(low); plane <= high; plane += 1.0)
      if (low < high) at.push_back(std::clamp((plane - from[axis]) / (to[axis] - from[axis]), 0.0, 1.0));
  }
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

void append(std::vector<FrontPiece>& pieces, const Vec3i& cell, const Vec3& from, const Vec3& to) {
  if (pieces.empty() || pieces.back().cell != cell) {
    pieces.emplace_back();
    pieces.back().cell = cell;
    pieces.back().points.push_back(from);
  }
  pieces.back().points.push_back(to);
  pieces.back().length += (to - from).norm();
}

void walk_segment(const Lattice& lattice, const Vec3& a, const Vec3& b, std::vector<FrontPiece>& pieces) {
  const Vec3 from = to_cells(lattice, a);
  const Vec3 to = to_cells(lattice, b);
  const std::vector<double> at = boundaries(from, to);
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const Vec3 p = a + at[i] * (b - a);
    const Vec3 q = i + 2 == at.size() ? b : Vec3(a + at[i + 1] * (b - a));
    if (p == q) continue;
    const Vec3 middle = from + 0.5 * (at[i] + at[i + 1]) * (to - from);
    append(pieces, middle.array().floor().cast<int>(), p, q);
  }
}

/// The nearest point of a piece, off the ends at which the polyline goes on.
Vec3 project_between_ends(const FrontPiece& piece, const Vec3& query) {
  if (piece.points.size() == 1) return piece.points[0];
  const PolylineProjection nearest = project(piece.points, query);
  const double along = arc_length(piece.points, nearest);
  const double margin = kEndMargin * piece.length;
  const double low = piece.first ? 0.0 : margin;
  const double high = piece.last ? piece.length : piece.length - margin;
  return along < low || along > high ? point_along(piece.points, std::clamp(along, low, high))
                                     : nearest.point;
}

/// The part of segment ab in a box, from and to positions on it (empty if from > to).
std::pair<double, double> part_in(const Box& box, const Vec3& a, const Vec3& b) {
  double from = 0.0, to = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = b[axis] - a[axis];
    const double low = box.min()[axis] - a[axis], high = box.max()[axis] - a[axis];
    if (way == 0.0 && (low > 0.0 || high < 0.0)) return {1.0, 0.0};
    if (way == 0.0) continue;
    from = std::max(from, std::min(low / way, high / way));
    to = std::min(to, std::max(low / way, high / way));
  }
  return {from, to};
}

/// The point nearest to a query of a polyline's part in a box, if there is one.
std::optional<Vec3> nearest_in(const Box& box, const Polyline& points, const Vec3& query) {
  std::optional<Vec3> nearest;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 &a = points[i], &b = points[i + 1];
    const auto [from, to] = part_in(box, a, b);
    if (from > to) continue;
    const double t = (query - a).dot(b - a) / (b - a).squaredNorm();
    const Vec3 X = a + std::clamp(t, from, to) * (b - a);
    if (!nearest || (X - query).norm() < (*nearest - query).norm()) nearest = X;
  }
  return nearest;
}

}  // namespace

Vec3i dual_cell_at(const Lattice& lattice, const Vec3& X) {
  return to_cells(lattice, X).array().floor().cast<int>();
}

std::vector<FrontPiece> walk_dual_cells(const Lattice& lattice, const Polyline& polyline) {
  std::vector<FrontPiece> pieces;
  if (polyline.size() == 1) pieces.push_back({dual_cell_at(lattice, polyline[0]), polyline});
  for (std::size_t i = 0; i + 1 < polyline.size(); ++i)
    walk_segment(lattice, polyline[i], polyline[i + 1], pieces);
  if (!pieces.empty()) pieces.front().first = pieces.back().last = true;
  return pieces;
}

std::vector<Vec3i> cells_along(const Lattice& lattice, const FrontPiece& piece) {
  std::vector<Vec3i> cells{piece.cell};
  if (piece.length < 2.0 * kAlongFace * lattice.spacing.minCoeff()) return cells;
  for (int axis = 0; axis < 3; ++axis) {
    const auto runs_along = [&](int face) {
      return std::all_of(piece.points.begin(), piece.points.end(), [&](const Vec3& X) {
        return std::abs(to_cells(lattice, X)[axis] - piece.cell[axis] - face) < kAlongFace;
      });
    };
    const int way = runs_along(0) ? -1 : runs_along(1) ? 1 : 0;
    for (std::size_t i = 0, count = cells.size(); way != 0 && i < count; ++i)
      cells.push_back(cells[i] + way * Vec3i::Unit(axis));
  }
  return cells;
}

Vec3 project_within(const FrontPiece& piece, const Vec3& query, const Box& room) {
  Vec3 nearest = project_between_ends(piece, query);
  if (room.contains(nearest)) return nearest;
  const std::optional<Vec3> in_room = nearest_in(room, piece.points, query);
  return in_room ? *in_room : Vec3(nearest.cwiseMax(room.min()).cwiseMin(room.max()));
}

}  // namespace cfem_cutting
