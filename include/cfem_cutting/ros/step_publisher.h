#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <mutex>
#include <string>

#include "cfem_cutting/ros/messages.h"
#include "cfem_cutting/simulation/reports.h"

namespace cfem_cutting {

/// Publishes what each step reports. Thread-safe.
class StepPublisher {
 public:
  /// @param tool_frame of the wrench in the tool's body
  StepPublisher(ros::NodeHandle& node, const std::string& tissue_frame, const std::string& tool_frame);

  /// @param lag, skipped s
  void publish(const StepReport& report, double lag, double skipped);

  /// Haptic drivers hold the last wrench; this one lets go.
  /// @param time s, its stamp
  void publish_zero_wrench(double time);

  /// A last zero wrench; nothing is published after it.
  void close(double time);

  /// ENABLED, PAUSED or FAULT, latched.
  void publish_state(const std::string& state);

 private:
  void publish_wrenches(const StepReport& report);

  std::string tissue_frame_, tool_frame_;
  std::mutex mutex_;
  bool closed_ = false;
  ros::Publisher events_, forces_, reports_, body_wrench_, spatial_wrench_, state_;
};

}  // namespace cfem_cutting
