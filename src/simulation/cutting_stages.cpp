// The stages that cut: sweep, judge, sever.

#include <algorithm>

#include "simulation_state.h"

namespace cfem_cutting {

void Simulation::State::sweep(const StepInput& input) {
  motion = Pose::Identity();
  bool anew = input.front_anew || !tracker.placed();
  for (const Pose& X_TB : input.path) {
    if (anew || travel(blade, tracker.pose(), X_TB) > config.blade.max_travel) {
      leave_tissue();
      tracker.place_anew(X_TB, *pull_back);
      motion = Pose::Identity();
      anew = false;
    }
    const Pose before = tracker.pose();
    for (const Pose& pose : tracker.subdivide(X_TB)) meet(tracker.move(pose, volume, *pull_back));
    motion = X_TB * before.inverse() * motion;
  }
}

/// Collects the links that a motion meets, and binds points of the front that came into tissue.
void Simulation::State::meet(const FrontMotion& moved) {
  trail.follow(moved.before, moved.after);
  unit.collect(find_crossings(volume, cfem_cutting::sweep(moved.before, moved.after)));
  if (immediate()) return;
  const bool first_touch = contact.empty();
  for (const Touch& touch : moved.touches) {
    if (contact.covers(touch.along) || is_in_earlier_cut(touch)) continue;
    const MaterialPoint place = pushed_in(touch);
    EdgeContactPoint point;
    point.X = place.X;
    point.voxel = place.voxel;
    point.along = touch.along;
    contact.bind(point);
  }
  if (first_touch && !contact.empty()) refresh_reference();
  const Vec3 forward = push();
  const double retreat = 0.5 * volume.lattice().spacing.minCoeff();
  contact.release_if([&](const EdgeContactPoint& p) {
    const Vec3 x_ref = model.mesh().embed(p.voxel, p.X).apply(reference);
    return forward.dot(project(tracker.front().points, x_ref).point - x_ref) < -retreat;
  });
  if (is_out()) come_out();
}

/// A cut that was there before this fracture goes on ahead of the edge.
bool Simulation::State::is_in_earlier_cut(const Touch& touch) const {
  const double near = 0.25 * volume.lattice().spacing.minCoeff();
  const auto ahead = (*pull_back)(touch.on_edge + near * push());
  return ahead && cut_surface.distance(ahead->X, near) <= near;
}

/// What the blade meets at a touch. Beside bound points it has pushed the tissue in as far as there.
MaterialPoint Simulation::State::pushed_in(const Touch& touch) const {
  const double reach = 3.0 * contact_spacing();
  Vec3 shift = Vec3::Zero();
  double weights = 0.0;
  for (const EdgeContactPoint& p : contact.points()) {
    const double gap = std::abs(p.along - touch.along);
    const std::optional<Vec3> on_front = tracker.material_at(p.along);
    if (touch.enters || gap >= reach || !on_front) continue;
    shift += (1.0 - gap / reach) * (p.X - *on_front);
    weights += 1.0 - gap / reach;
  }
  const MaterialPoint at_touch{touch.X, touch.voxel};
  if (weights == 0.0 || tissue_voxel_at(volume, touch.X) < 0) return at_touch;
  const Vec3 X = touch.X + shift / weights;
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

/// A bound point's offset: it rides on the blade, so where the tissue can't follow (at a held base) the
/// blade's way counts.
double Simulation::State::offset(const OffsetField& offsets, const EdgeContactPoint& p) {
  return p.active ? offsets.offset_at(p.voxel, p.X, p.on_edge) : offsets.offset(p.voxel, p.X);
}

double Simulation::State::contact_offset(const OffsetField& offsets) const {
  double largest = 0.0;
  for (const EdgeContactPoint& p : contact.points())
    if (p.active) largest = std::max(largest, offset(offsets, p));
  return largest;
}

Fracture Simulation::State::judge() {
  const OffsetField offsets = offset_field();
  unit.measure(volume, offsets, tracker.runs_inside(), push(), block);
  unit.largest_offset = contact_offset(offsets);
  Fracture fracture = decide(config.fracture, unit.candidates(), unit.largest_offset, block);
  // What still springs back from the last fracture is not loaded by the blade.
  const bool loaded = immediate() || contact.pushes() || is_out();
  fracture.happens = fracture.happens && loaded && advances(fracture, offsets);
  return fracture;
}

/// Whether a fracture would move the cut's end: sever a link, or carry a released contact point forward.
bool Simulation::State::advances(const Fracture& fracture, const OffsetField& offsets) const {
  if (!fracture.severed.empty()) return true;
  constexpr double kAdvance = 0.01;  // of a voxel
  const double least = kAdvance * volume.lattice().spacing.minCoeff();
  const std::vector<Touch> front = tracker.inside();
  return std::any_of(contact.points().begin(), contact.points().end(), [&](const EdgeContactPoint& p) {
    if (offset(offsets, p) <= config.fracture.release_offset) return false;
    return std::all_of(front.begin(), front.end(),
                       [&](const Touch& t) { return (t.X - p.X).norm() > least; });
  });
}

void Simulation::State::sever(const Fracture& fracture, StepReport& report) {
  FractureEvent event;
  const double energy_before = potential(elastic.x);
  const int pieces_before = pieces.count();
  if (fracture.advances) let_go();
  if (!fracture.severed.empty()) rebuild(fracture);
  if (fracture.advances) advance_cut_end();
  event.fracture_work = energy_before - potential(reference);
  describe(fracture, event);
  event.separated = pieces.count() > pieces_before;
  event.time = report.time;
  report.events.push_back(event);
  report.phase = Phase::kFractured;
  unit.begin_next(fracture.waiting);
}

/// Contact points with an offset above d1 are released, and all when the front has gone through the tissue.
void Simulation::State::let_go() {
  const OffsetField offsets = offset_field();
  const bool through = tracker.inside().empty();
  contact.release_if([&](const EdgeContactPoint& p) {
    return through || offset(offsets, p) > config.fracture.release_offset;
  });
}

void Simulation::State::rebuild(const Fracture& fracture) {
  for (const Crossing& crossing : fracture.severed) volume.sever(crossing.link, crossing.at);
  const std::vector<int> parent = model.update(volume);
  const auto inherit = [&](NodeField& field) { field = NodeField(field(Eigen::all, parent)); };
  inherit(elastic.x);
  inherit(elastic.v);
  inherit(reference);
  pieces = find_pieces(volume);
  find_held();
  grips.move(model.mesh(), elapsed, {});
  refresh_reference();
}

/// The cut ends at the front now: the surface keeps its end there, and the blade binds there anew.
void Simulation::State::advance_cut_end() {
  extractor.freeze();
  if (immediate()) return;
  for (const Touch& touch : tracker.inside()) {
    if (contact.covers(touch.along) || is_in_earlier_cut(touch)) continue;
    EdgeContactPoint point;
    point.X = touch.X;
    point.voxel = touch.voxel;
    point.along = touch.along;
    contact.bind(point);
  }
}

/// Figures of the new cut.
void Simulation::State::describe(const Fracture& fracture, FractureEvent& event) {
  event.unit = unit.number;
  event.links_severed = static_cast<std::uint32_t>(fracture.severed.size());
  const std::vector<SweptTriangle> swept = trail.take();
  event.area = cut_surface.add(volume, swept);
  event.largest_offset = unit.largest_offset;
  event.blade_work = unit.blade_work;
  event.peak_force = unit.peak_force;
  event.front = tracker.front().points;
  event.piece_volumes = pieces.volumes;
  Vec3 weighted_centre = Vec3::Zero();
  Vec3 normal = Vec3::Zero();
  double weight = 0.0;
  for (const SweptTriangle& t : swept) {
    const double area = t.normal().norm();
    weighted_centre += area / 3.0 * (t.corners[0] + t.corners[1] + t.corners[2]);
    normal += t.normal();
    weight += area;
  }
  if (weight > 0.0) event.centroid = weighted_centre / weight;
  if (normal.norm() > 0.0) event.normal = normal.normalized();
  cut_area += event.area;
}

}  // namespace cfem_cutting
