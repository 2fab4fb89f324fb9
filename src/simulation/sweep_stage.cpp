// The stage that sweeps: what the blade meets on its way, and what it leaves.

#include <algorithm>
#include <cmath>

#include "simulation_state.h"

namespace cfem_cutting {

bool Simulation::State::is_jump(const Pose& from, const Pose& to) const {
  return travel(blade, from, to) > config.blade.max_travel;
}

void Simulation::State::sweep(const StepInput& input) {
  motion = Pose::Identity();
  bool anew = input.front_anew || !tracker.placed();
  for (const Pose& X_TB : input.path) {
    if (anew || is_jump(tracker.pose(), X_TB)) {
      leave_tissue();
      place_anew(X_TB);
      motion = Pose::Identity();
      anew = false;
    }
    const Pose before = tracker.pose();
    for (const Pose& pose : tracker.subdivide(X_TB)) meet(tracker.move(pose, volume, *pull_back));
    motion = X_TB * before.inverse() * motion;
  }
}

/// In tissue that is still moving, a front that is set into it stands where it will have come to rest.
void Simulation::State::place_anew(const Pose& X_TB) {
  tracker.place_anew(X_TB, *pull_back);
  if (immediate() || tracker.inside().empty()) return;
  refresh_reference();
  tracker.place_anew(X_TB, *pull_back);
}

/// Collects the links that a motion meets, and binds points of the front that came into tissue.
void Simulation::State::meet(const FrontMotion& moved) {
  trail.follow(moved.before, moved.after);
  unit.collect(find_crossings(volume, cfem_cutting::sweep(moved.before, moved.after)));
  if (immediate()) return;
  const bool first_touch = contact.empty();
  const std::vector<Dent> dents = find_dents();
  for (const Touch& touch : moved.touches) {
    if (contact.covers(touch.along) || is_in_earlier_cut(touch)) continue;
    const MaterialPoint place = pushed_in(touch, dents);
    if (!is_in_earlier_cut(touch, place.X - touch.X)) bind(place, touch.along, false);
  }
  if (first_touch && !contact.empty()) refresh_reference();
  release_left_points();
  if (is_out()) come_out();
}

void Simulation::State::bind(const MaterialPoint& place, double along, bool at_cut_end) {
  EdgeContactPoint point;
  point.X = place.X;
  point.voxel = place.voxel;
  point.along = along;
  point.at_cut_end = at_cut_end;
  contact.bind(point);
}

/// The blade has drawn back from them; what it had swept beyond is not cut.
void Simulation::State::release_left_points() {
  const double retreat = 0.5 * volume.lattice().spacing.minCoeff();
  contact.release_if([&](const EdgeContactPoint& p) {
    const bool left = pushed_by_front(p) < -retreat;
    if (left) forget_dent(p);
    return left;
  });
}

/// How far the edge is beyond a contact point at rest, m.
double Simulation::State::pushed_by_front(const EdgeContactPoint& p) const {
  const Vec3 x_ref = model.mesh().embed(p.voxel, p.X).apply(reference);
  return push().dot(project(tracker.front().points, x_ref).point - x_ref);
}

void Simulation::State::forget_dent(const EdgeContactPoint& p) {
  const std::optional<Vec3> on_front = tracker.material_at(p.along);
  if (!on_front) return;
  const Vec3 beyond = (p.X - *on_front).normalized();
  const Dent dent{p.along, p.X, 2.0 * block * beyond, dent_radius()};
  trail.drop_if([&](const SweptTriangle& t) { return dent.holds(t.centroid()); });
}

std::vector<Dent> Simulation::State::find_dents() const {
  std::vector<Dent> dents;
  for (const EdgeContactPoint& p : contact.points()) {
    const std::optional<Vec3> on_front = tracker.material_at(p.along);
    if (!on_front || *on_front == p.X || pushed_by_front(p) <= 0.0) continue;
    dents.push_back({p.along, p.X, *on_front - p.X, dent_radius()});
  }
  return dents;
}

/// A cut that was there before this fracture goes on ahead of the edge.
/// @param way m, in the tissue, from the touch to what the blade meets there
bool Simulation::State::is_in_earlier_cut(const Touch& touch, const Vec3& way) const {
  const double near = 0.25 * volume.lattice().spacing.minCoeff();
  const auto ahead = (*pull_back)(touch.on_edge + near * push());
  return ahead && cut_surface.distance(ahead->X + way, near) <= near;
}

/// What the blade meets at a touch. Beside dents it has pushed the tissue in as far as there.
MaterialPoint Simulation::State::pushed_in(const Touch& touch, const std::vector<Dent>& dents) const {
  MaterialPoint at_touch{touch.X, touch.voxel};
  if (touch.enters || tissue_voxel_at(volume, touch.X) < 0) return at_touch;
  const double reach = 3.0 * contact_spacing();
  Vec3 way = Vec3::Zero();
  double weights = 0.0;
  for (const Dent& dent : dents) {
    const double weight = std::max(0.0, 1.0 - std::abs(dent.along - touch.along) / reach);
    way += weight * dent.way;
    weights += weight;
  }
  if (weights == 0.0) return at_touch;
  const Vec3 X = touch.X - way / weights;
  const int voxel = tissue_voxel_at(volume, X);
  if (voxel >= 0) return {X, voxel};
  const Entry entry = find_entry(volume, X, touch.X);
  return {entry.X, entry.voxel};
}

/// Beyond the tissue, or back from it. What the front has gone through is severed now, the rest waits no
/// more.
void Simulation::State::come_out() {
  unit.drop_if([&](const Candidate& c) {
    const int voxel = c.crossing.link.voxel;
    const Vec3 x_ref = model.mesh().embed(voxel, volume.centre(voxel)).apply(reference);
    return push().dot(project(tracker.front().points, x_ref).point - x_ref) <= 0.0;
  });
  unit.leave_behind();
  if (unit.candidates().empty()) trail.drop();
}

void Simulation::State::leave_tissue() {
  contact.clear();
  unit.drop();
  trail.drop();
}

}  // namespace cfem_cutting
