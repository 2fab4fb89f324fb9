// The stages that cut: judge, sever.

#include <algorithm>

#include "simulation_state.h"

namespace cfem_cutting {

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
  unit.measure(volume, offsets, tracker.runs_near(), push(), block);
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
  const auto inherit = [&](NodeField& field) {
    if (field.cols() > 0) field = NodeField(field(Eigen::all, parent));
  };
  inherit(elastic.x);
  inherit(elastic.v);
  for (NodeField& v : elastic.past_v) inherit(v);
  inherit(reference);
  inherit(drift);
  pieces = find_pieces(volume);
  find_held();
  grips.move(model.mesh(), elapsed, {});
  refresh_reference();
}

/// The cut ends at the front now: the surface keeps its end there, and the blade binds there anew (before
/// this cut counts as an earlier one).
void Simulation::State::advance_cut_end() {
  extractor.freeze();
  if (immediate()) return;
  for (const Touch& touch : tracker.inside()) {
    if (!contact.covers(touch.along) && !is_in_earlier_cut(touch))
      bind({touch.X, touch.voxel}, touch.along, true);
  }
}

/// Takes from the trail what is cut now: what lies behind released contact points, and around severed links.
/// The rest is dented only and stays.
std::vector<SweptTriangle> Simulation::State::take_opened(const Fracture& fracture) {
  const std::vector<Dent> dents = find_dents();
  const double around = 0.75 * volume.lattice().spacing.minCoeff();
  std::vector<SweptTriangle> swept = trail.take();
  const auto is_opened = [&](const SweptTriangle& t) {
    const Vec3 X = t.centroid();
    const bool dented = std::any_of(dents.begin(), dents.end(), [&](const Dent& d) { return d.holds(X); });
    return !dented || std::any_of(fracture.severed.begin(), fracture.severed.end(),
                                  [&](const Crossing& c) { return (c.at.point - X).norm() < around; });
  };
  const auto uncut = std::stable_partition(swept.begin(), swept.end(), is_opened);
  trail.give_back({uncut, swept.end()});
  swept.erase(uncut, swept.end());
  return swept;
}

/// Figures of the new cut.
void Simulation::State::describe(const Fracture& fracture, FractureEvent& event) {
  event.unit = unit.number;
  event.links_severed = static_cast<std::uint32_t>(fracture.severed.size());
  const std::vector<SweptTriangle> swept = take_opened(fracture);
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
