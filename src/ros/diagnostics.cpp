#include "cfem_cutting/ros/diagnostics.h"

#include <ros/console.h>

namespace cfem_cutting {
namespace {

using diagnostic_updater::DiagnosticStatusWrapper;
using Level = diagnostic_msgs::DiagnosticStatus;

constexpr double kWarnEvery = 10.0;  // s, on the console

std::uint64_t skipped_poses(const PoseCounts& counts) {
  return counts.invalid + counts.no_stamp + counts.out_of_order + counts.no_transform + counts.thinned;
}

}  // namespace

Diagnostics::Diagnostics(ros::NodeHandle& node, const StepLoop& loop, const ToolTracker& tracker,
                         double max_lag)
    : loop_(loop), tracker_(tracker), max_lag_(max_lag) {
  updater_.setHardwareID("none");
  updater_.add("tool input", [this](DiagnosticStatusWrapper& status) { report_input(status); });
  updater_.add("simulation", [this](DiagnosticStatusWrapper& status) { report_simulation(status); });
  const ros::SteadyTimerCallback tick = [this](const ros::SteadyTimerEvent&) { publish(); };
  timer_ = node.createSteadyTimer(ros::WallDuration(1.0), tick);
}

void Diagnostics::report_input(DiagnosticStatusWrapper& status) const {
  const PoseCounts counts = tracker_.counts();
  if (loop_.status().stale) {
    status.summary(Level::WARN, counts.received == 0 ? "no poses yet" : "no new poses");
  } else {
    status.summary(Level::OK, "poses come in");
  }
  if (skipped_poses(counts) > 0) {
    status.mergeSummaryf(Level::WARN, "%lu poses left out",
                         static_cast<unsigned long>(skipped_poses(counts)));
  }
  if (tracker_.publishers() > 1) {
    status.mergeSummary(Level::WARN, "several publishers mix");
    ROS_WARN_THROTTLE(kWarnEvery, "The %s come from %d publishers and mix: there must be one",
                      tracker_.source().c_str(), tracker_.publishers());
  }
  status.add("publishers", tracker_.publishers());
  status.add("received", counts.received);
  status.add("used", counts.used);
  status.add("invalid", counts.invalid);
  status.add("no_stamp", counts.no_stamp);
  status.add("out_of_order", counts.out_of_order);
  status.add("no_transform", counts.no_transform);
  status.add("thinned", counts.thinned);
  status.add("time_jumps", counts.time_jumps);
}

void Diagnostics::report_simulation(DiagnosticStatusWrapper& status) const {
  const LoopStatus loop = loop_.status();
  if (loop.state == OperatingState::kFault) {
    status.summary(Level::ERROR, loop.fault);
  } else {
    status.summary(Level::OK, name_of(loop.state));
  }
  if (loop.lag > max_lag_) status.mergeSummary(Level::WARN, "behind the poses");
  if (loop.skipped > 0.0) status.mergeSummary(Level::WARN, "left time out to keep up");
  if (loop.inverted_elements > 0) status.mergeSummary(Level::WARN, "inverted elements");
  status.add("state", name_of(loop.state));
  status.add("steps", loop.steps);
  status.add("fracture_events", loop.events);
  status.add("lag_s", loop.lag);
  status.add("skipped_s", loop.skipped);
  status.add("jumps", loop.jumps);
  status.add("inverted_elements", loop.inverted_elements);
  status.add("steps_not_converged", loop.not_converged);
}

}  // namespace cfem_cutting
