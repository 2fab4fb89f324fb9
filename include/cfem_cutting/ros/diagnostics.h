#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/steady_timer.h>

#include "cfem_cutting/ros/step_loop.h"

namespace cfem_cutting {

/// Publishes how the input and the simulation are doing on /diagnostics, once a second of the steady clock.
class Diagnostics {
 public:
  Diagnostics(ros::NodeHandle& node, const StepLoop& loop, const ToolTracker& tracker, double max_lag);

  void publish() { updater_.force_update(); }

 private:
  void report_input(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void report_simulation(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  const StepLoop& loop_;
  const ToolTracker& tracker_;
  double max_lag_;
  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;
};

}  // namespace cfem_cutting
