// The material curve on which the surface meets the blade's edge.

#include <algorithm>
#include <cmath>
#include <limits>

#include "cfem_cutting/volume/link_way.h"
#include "simulation_state.h"

namespace cfem_cutting {
namespace {

// Along the edge, of contact points' spacing: where a dent ends; and how near a point is to the one before to
// be left out, as tissue that slides brings them together and past each other.
constexpr double kDentReach = 4.0, kCrowded = 0.25;
// At most, of tissue along the edge: its length at rest over that of the edge beside it.
constexpr double kStretch = 1.5;
constexpr double kFar = std::numeric_limits<double>::infinity();

/// A walk from a material point on, over links, severed ones too: not into other tissue that only touches.
class Walk {
 public:
  Walk(const VoxelVolume& volume, const Vec3& from, int voxel) : volume_(volume), at_(from), voxel_(voxel) {}

  /// Goes straight on, in steps of a sixteenth or a voxel, until tissue ends (found by bisection).
  Vec3 along(const Vec3& way) {
    const double voxels = way.cwiseQuotient(volume_.lattice().spacing).cwiseAbs().sum();
    const int steps = std::max(16, static_cast<int>(std::ceil(voxels)));
    for (int i = 0; i < steps; ++i) {
      if (step(way / steps)) continue;
      bisect(way / steps);
      break;
    }
    return at_;
  }

 private:
  bool step(const Vec3& way) {
    const int next = tissue_voxel_at(volume_, at_ + way);
    if (next < 0 || !are_joined(volume_, voxel_, next, LinkKind::kAny)) return false;
    at_ += way;
    voxel_ = next;
    return true;
  }

  void bisect(Vec3 way) {
    constexpr int kBisections = 16;
    for (int i = 0; i < kBisections; ++i) step(way *= 0.5);
  }

  const VoxelVolume& volume_;
  Vec3 at_;
  int voxel_;
};

const Vec3& nearer_to(const Vec3& query, const Vec3& a, const Vec3& b) {
  return (a - query).norm() <= (b - query).norm() ? a : b;
}

/// As near each other in the tissue as on the edge: two parts of it may lie side by side under the blade.
bool are_near(const EdgeContactPoint& a, const EdgeContactPoint& b, double spacing) {
  return (b.X - a.X).norm() < 3.0 * std::max(b.along - a.along, spacing);
}

/// There is no tissue between them, but a cut that may gape.
bool is_cut_between(const VoxelVolume& volume, const EdgeContactPoint& a, const EdgeContactPoint& b) {
  return are_joined(volume, a.voxel, b.voxel, LinkKind::kAny) &&
         !are_joined(volume, a.voxel, b.voxel, LinkKind::kIntact);
}

}  // namespace

/// The blade pushes at it; or it would if the tissue had come to rest, as after a fracture; or the cut has
/// just ended there, from where the tissue may spring ahead.
bool Simulation::State::holds(const EdgeContactPoint& p) const {
  if (p.active || p.at_cut_end) return true;
  return pushed_by_front(p) >= -1e-3 * volume.lattice().spacing.minCoeff();
}

/// On a long way to its end, through an earlier cut, the trace follows the edge: a dent that moved the tissue
/// at the contact point moves it less and less far from there.
Polyline Simulation::State::follow_edge(const FrontEnd& end, const Vec3& dent) const {
  const double reach = kDentReach * contact_spacing();
  Polyline points;
  const double near = 0.25 * volume.lattice().spacing.minCoeff();
  const auto is_cut = [&](const Vec3& X) { return cut_surface.distance(X, near) <= near; };
  if ((end.X - end.X_at_start).norm() <= reach || std::none_of(end.way.begin(), end.way.end(), is_cut))
    return points;
  for (const Vec3& X : end.way) {
    const double part = std::max(0.0, 1.0 - (X - end.X_at_start).norm() / reach);
    if (tissue_voxel_at(volume, X + part * dent) >= 0) points.push_back(X + part * dent);
  }
  return points;
}

/// The trace goes on from a contact point to where the edge ends or leaves the tissue: there the front, or
/// the skin or cut's end that it has pushed in as far as at the contact point; and straight on as long as
/// there are edge and tissue, which in motion may reach farther along the edge than at rest. It does not go
/// on where tissue is folded so that this leads back along the edge.
/// @param until m, arc length at which another trace begins
void Simulation::State::extend(const EdgeContactPoint& last, double until, int step, Trace& trace) const {
  const std::optional<FrontEnd> end = tracker.end_beyond(last.along, until, step, volume);
  Polyline points;
  Vec3 X = last.X;
  if (end) {
    const Vec3 beyond = end->X - end->X_at_start, dent = last.X - end->X_at_start;
    points = follow_edge(*end, dent);
    X = Walk(volume, last.X, last.voxel).along(beyond);
    const int voxel = tissue_voxel_at(volume, end->X);
    if (voxel >= 0 && is_same_piece(voxel, last.voxel))
      X = nearer_to(last.X + beyond, X, Walk(volume, end->X, voxel).along(dent));
  }
  if ((!end || (!end->edge_ends && !end->goes_on)) && tissue_voxel_at(volume, X) >= 0) {
    const double rest = kStretch * tracker.length_beyond(last.along, step) - (X - last.X).norm();
    const double reach = std::clamp(rest, 0.0, 2.0 * contact_spacing());
    const int voxel = tissue_voxel_at(volume, X);
    X = Walk(volume, X, voxel).along(reach * tracker.material_tangent(last.along, step));
  }
  if (leads_back(last, X, step)) return;
  (step > 0 ? trace.tip : trace.heel) = end && end->edge_ends;
  if ((X - last.X).norm() > 1e-6 * volume.lattice().spacing.minCoeff()) points.push_back(X);
  if (step < 0) std::reverse(points.begin(), points.end());
  trace.points.insert(trace.points.end(), points.begin(), points.end());
}

bool Simulation::State::is_same_piece(int voxel, int other) const {
  return pieces.piece_of_voxel[voxel] == pieces.piece_of_voxel[other];
}

/// Whether the way from a contact point to X goes back along the edge, as the tissue is now.
bool Simulation::State::leads_back(const EdgeContactPoint& from, const Vec3& X, int step) const {
  const int voxel = tissue_voxel_at(volume, X);
  const double way = along_edge(X, voxel >= 0 ? voxel : from.voxel) - along_edge(from.X, from.voxel);
  constexpr double kSquare = 0.01;  // of contact points' spacing: less is square to the edge
  return step * way < -kSquare * contact_spacing();
}

bool Simulation::State::in_tissue_between(const EdgeContactPoint& a, const EdgeContactPoint& b) const {
  const std::optional<FrontEnd> end = tracker.end_beyond(a.along, b.along, 1, volume);
  return end && end->goes_on;
}

FrontTrace Simulation::State::front_trace() {
  held.clear();
  if (immediate()) {
    const std::vector<Polyline> runs = tracker.runs_inside();
    return {runs.begin(), runs.end()};
  }
  FrontTrace trace;
  const EdgeContactPoint* last = nullptr;
  bool interrupted = false;
  for (const EdgeContactPoint& p : contact.points()) {
    interrupted = interrupted || !holds(p);
    if (!holds(p) || (last && p.along - last->along < kCrowded * contact_spacing())) continue;
    const bool holds_between = last && !interrupted && p.along - last->along < 3.0 * contact_spacing();
    const bool goes_on = last && is_same_piece(last->voxel, p.voxel) &&
                         are_near(*last, p, contact_spacing()) &&
                         (holds_between || in_tissue_between(*last, p));
    if (!goes_on) {
      if (last) extend(*last, p.along, 1, trace.back());
      trace.emplace_back();
      extend(p, last ? last->along : -kFar, -1, trace.back());
    } else if (holds_between && !is_cut_between(volume, *last, p)) {
      held.push_back({{last->X, last->voxel}, {p.X, p.voxel}});
    }
    trace.back().points.push_back(p.X);
    last = &p;
    interrupted = false;
  }
  if (last) extend(*last, kFar, 1, trace.back());
  return trace;
}

/// Arc length at the place of the edge that is nearest to tissue now, m.
double Simulation::State::along_edge(const Vec3& X, int voxel) const {
  const Polyline& edge = tracker.front().points;
  return arc_length(edge, project(edge, model.mesh().embed(voxel, X).apply(elastic.x)));
}

/// Where the edge lies between contact points on the trace now.
std::vector<EdgePart> Simulation::State::held_parts() const {
  std::vector<EdgePart> parts;
  for (const auto& [a, b] : held) parts.push_back({along_edge(a.X, a.voxel), along_edge(b.X, b.voxel)});
  return parts;
}

}  // namespace cfem_cutting
