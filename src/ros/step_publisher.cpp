#include "cfem_cutting/ros/step_publisher.h"

#include <geometry_msgs/WrenchStamped.h>
#include <std_msgs/String.h>

#include "cfem_cutting/ros/conversions.h"

namespace cfem_cutting {
namespace {
// Bounded, or a subscriber that never reads would fill the memory; a second's worth of steps or more.
constexpr std::uint32_t kEventQueue = 1000;
constexpr std::uint32_t kStepQueue = 1000;
constexpr std::uint32_t kWrenchQueue = 100;
}  // namespace

StepPublisher::StepPublisher(ros::NodeHandle& node, const std::string& tissue_frame,
                             const std::string& tool_frame)
    : tissue_frame_(tissue_frame), tool_frame_(tool_frame) {
  events_ = node.advertise<FractureEventMessage>("fracture_events", kEventQueue);
  forces_ = node.advertise<ContactForces>("contact_forces", kStepQueue);
  reports_ = node.advertise<StepReportMessage>("step_report", kStepQueue);
  body_wrench_ = node.advertise<geometry_msgs::WrenchStamped>("tool/body/measured_cf", kWrenchQueue);
  spatial_wrench_ = node.advertise<geometry_msgs::WrenchStamped>("tool/spatial/measured_cf", kWrenchQueue);
  state_ = node.advertise<std_msgs::String>("operating_state_name", 10, true);
}

void StepPublisher::publish_wrenches(const StepReport& report) {
  geometry_msgs::WrenchStamped message;
  message.header = make_header(tool_frame_, report.time);
  message.wrench = to_wrench(report.body);
  body_wrench_.publish(message);
  message.header.frame_id = tissue_frame_;
  message.wrench = to_wrench(report.spatial);
  spatial_wrench_.publish(message);
}

void StepPublisher::publish(const StepReport& report, double lag, double skipped) {
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  publish_wrenches(report);
  for (const FractureEvent& event : report.events) events_.publish(to_message(event, tissue_frame_));
  forces_.publish(to_contact_forces(report, tissue_frame_));
  reports_.publish(to_message(report, tissue_frame_, lag, skipped));
}

void StepPublisher::publish_zero_wrench(double time) {
  StepReport nothing;
  nothing.time = time;
  const std::lock_guard lock(mutex_);
  if (!closed_) publish_wrenches(nothing);
}

void StepPublisher::close(double time) {
  publish_zero_wrench(time);
  const std::lock_guard lock(mutex_);
  closed_ = true;
}

void StepPublisher::publish_state(const std::string& state) {
  std_msgs::String message;
  message.data = state;
  state_.publish(message);
}

}  // namespace cfem_cutting
