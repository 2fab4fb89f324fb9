// The material curve on which the surface meets the blade's edge.

#include <algorithm>
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

/// The part of a segment from a point in tissue on that is in the same tissue, tested in steps of 1/16: not
/// in other tissue that only touches it.
Vec3 go_in_tissue(const VoxelVolume& volume, const Vec3& from, const Vec3& way) {
  constexpr int kSteps = 16, kBisections = 16;
  int voxel = tissue_voxel_at(volume, from);
  double in = 0.0, out = 0.0;
  const auto goes_to = [&](double part) {
    const int next = tissue_voxel_at(volume, from + part * way);
    const bool goes_on = voxel >= 0 && next >= 0 && are_joined(volume, voxel, next, true);
    if (goes_on) voxel = next;
    (goes_on ? in : out) = part;
    return goes_on;
  };
  for (int i = 1; i <= kSteps && goes_to(static_cast<double>(i) / kSteps);) ++i;
  for (int i = 0; i < kBisections && out > in; ++i) goes_to(0.5 * (in + out));
  return from + in * way;
}

const Vec3& nearer_to(const Vec3& query, const Vec3& a, const Vec3& b) {
  return (a - query).norm() <= (b - query).norm() ? a : b;
}

/// As near each other in the tissue as on the edge: two parts of it may lie side by side under the blade.
bool are_near(const EdgeContactPoint& a, const EdgeContactPoint& b, double spacing) {
  return (b.X - a.X).norm() < 3.0 * std::max(b.along - a.along, spacing);
}

/// There is no tissue between them, but a cut that may gape.
bool is_cut_between(const VoxelVolume& volume, const EdgeContactPoint& a, const EdgeContactPoint& b) {
  return are_joined(volume, a.voxel, b.voxel, true) && !are_joined(volume, a.voxel, b.voxel);
}

}  // namespace

/// The blade pushes at it; or it would if the tissue had come to rest, as after a fracture.
bool Simulation::State::holds(const EdgeContactPoint& p) const {
  if (p.active) return true;
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
    X = nearer_to(last.X + beyond, go_in_tissue(volume, last.X, beyond), go_in_tissue(volume, end->X, dent));
  }
  (step > 0 ? trace.tip : trace.heel) = end && end->edge_ends;
  if ((!end || (!end->edge_ends && !end->goes_on)) && tissue_voxel_at(volume, X) >= 0) {
    const double rest = kStretch * tracker.length_beyond(last.along, step) - (X - last.X).norm();
    const double reach = std::clamp(rest, 0.0, 2.0 * contact_spacing());
    X = go_in_tissue(volume, X, reach * tracker.material_tangent(last.along, step));
  }
  if (step * (along_edge(X, last.voxel) - along_edge(last.X, last.voxel)) < 0.0) return;
  if ((X - last.X).norm() > 1e-6 * volume.lattice().spacing.minCoeff()) points.push_back(X);
  if (step < 0) std::reverse(points.begin(), points.end());
  trace.points.insert(trace.points.end(), points.begin(), points.end());
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
    const bool goes_on = last && pieces.piece_of_voxel[last->voxel] == pieces.piece_of_voxel[p.voxel] &&
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

/// Arc length where the edge is beside tissue now, m.
/// @param voxel that X follows if it is not in tissue
double Simulation::State::along_edge(const Vec3& X, int voxel) const {
  const int at_X = tissue_voxel_at(volume, X);
  const Polyline& edge = tracker.front().points;
  const Vec3 x = model.mesh().embed(at_X >= 0 ? at_X : voxel, X).apply(elastic.x);
  return arc_length(edge, project(edge, x));
}

/// Where the edge lies between contact points on the trace now.
std::vector<EdgePart> Simulation::State::held_parts() const {
  std::vector<EdgePart> parts;
  for (const auto& [a, b] : held) parts.push_back({along_edge(a.X, a.voxel), along_edge(b.X, b.voxel)});
  return parts;
}

}  // namespace cfem_cutting
