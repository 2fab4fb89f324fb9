// Forces, work and figures of a step.

#include <algorithm>

#include "simulation_state.h"

namespace cfem_cutting {
namespace {

/// The same wrench in the tool frame, about its origin.
Wrench in_tool_frame(const Wrench& spatial, const Pose& X_TB) {
  const Mat3 R_BT = X_TB.linear().transpose();
  return {R_BT * spatial.force, R_BT * (spatial.moment - X_TB.translation().cross(spatial.force))};
}

/// Work of a wrench on the tool while the tool moves, J.
double work(const Wrench& wrench, const Pose& motion) {
  const Eigen::AngleAxisd turn(motion.linear());
  const Vec3 rotation = turn.angle() * turn.axis();
  return wrench.force.dot(motion.translation()) + wrench.moment.dot(rotation);
}

}  // namespace

void Simulation::State::take_wrench() {
  const Wrench before = wrench;
  wrench = {};
  for (const EdgeContactPoint& p : contact.points()) {
    wrench.force -= p.force;
    wrench.moment -= p.on_edge.cross(p.force);
  }
  const double by_blade = -0.5 * (work(before, motion) + work(wrench, motion));
  unit.blade_work += by_blade;
  blade_work += by_blade;
  unit.peak_force = std::max(unit.peak_force, wrench.force.norm());
}

void Simulation::State::account(StepReport& report) {
  take_wrench();
  report.spatial = wrench;
  if (tracker.placed()) report.body = in_tool_frame(wrench, tracker.pose());
  for (const EdgeContactPoint& p : contact.points())
    if (p.active) report.contacts.push_back({p.on_edge, -p.force});
  if (report.phase != Phase::kFractured) report.phase = contact.pushes() ? Phase::kDeforming : Phase::kFree;
  report.unit = unit.number;
  report.largest_offset = unit.largest_offset;
  report.candidates = static_cast<std::uint32_t>(unit.candidates().size());
  report.links_severed = static_cast<std::uint32_t>(volume.severed_count());
  report.cut_area = cut_area;
  report.pieces = static_cast<std::uint32_t>(pieces.count());
  report.blade_work = blade_work;
}

}  // namespace cfem_cutting
