#include "cfem_cutting/ros/tool_tracker.h"

#include <ros/console.h>

#include <algorithm>

#include "cfem_cutting/ros/conversions.h"

namespace cfem_cutting {
namespace {

constexpr std::uint32_t kPoseQueue = 10000;  // messages that wait for their callback
constexpr double kLosslessPatience = 5.0;    // s, for tf
constexpr double kLosslessMemory = 600.0;    // s, of tf
constexpr double kRealtimeMemory = 10.0;     // s
constexpr double kWarnEvery = 5.0;           // s

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<std::string> followed_frames(const TissueConfig& tissue) {
  std::vector<std::string> frames;
  for (const GripConfig& grip : tissue.fixed) {
    if (!grip.follow.empty()) frames.push_back(grip.follow);
  }
  return frames;
}

template <typename Message, typename Receive>
ros::Subscriber subscribe(ros::NodeHandle& node, Receive receive) {
  const boost::function<void(const typename Message::ConstPtr&)> callback = [receive](const auto& m) {
    receive(*m);
  };
  return node.subscribe<Message>("tool/measured_cp", kPoseQueue, callback, ros::VoidConstPtr(),
                                 ros::TransportHints().tcpNoDelay());
}

}  // namespace

ToolTracker::ToolTracker(ros::NodeHandle& node, const Config& config)
    : tissue_frame_(frame_name(config.simulation.tissue.frame)),
      config_(config.node),
      followed_(followed_frames(config.simulation.tissue)),
      patience_(config.node.timing == Timing::kLossless ? kLosslessPatience
                                                        : std::max(0.1, config.node.max_lag)),
      tf_(node, config.node.timing == Timing::kLossless ? kLosslessMemory : kRealtimeMemory,
          [this](const tf2_msgs::TFMessage& message) { receive_tf(message); }) {
  if (config_.pose_input == PoseInput::kPose) {
    subscriber_ = subscribe<geometry_msgs::PoseStamped>(node, [this](const auto& m) { receive_pose(m); });
  } else if (config_.pose_input == PoseInput::kTransform) {
    subscriber_ =
        subscribe<geometry_msgs::TransformStamped>(node, [this](const auto& m) { receive_transform(m); });
  }
}

std::string ToolTracker::source() const {
  if (config_.pose_input == PoseInput::kTf) return "poses of the frame " + config_.tool_frame + " in tf";
  return "poses on " + subscriber_.getTopic();
}

void ToolTracker::refuse_pose(const std::string& fault) {
  queue_.count_invalid();
  ROS_WARN_THROTTLE(kWarnEvery, "Left out %s; the last one's %s", source().c_str(), fault.c_str());
}

void ToolTracker::receive_pose(const geometry_msgs::PoseStamped& message) {
  Pose pose;
  if (to_pose(message.pose, pose)) {
    offer(message.header, pose);
  } else {
    refuse_pose(fault_of(message.pose));
  }
}

void ToolTracker::receive_transform(const geometry_msgs::TransformStamped& message) {
  Pose pose;
  if (to_pose(message.transform, pose)) {
    offer(message.header, pose);
  } else {
    refuse_pose(fault_of(message.transform));
  }
}

// Every transform of the tool frame is a pose; where a frame above it moves instead, every newest one is.
void ToolTracker::receive_tf(const tf2_msgs::TFMessage& message) {
  if (config_.pose_input == PoseInput::kTf) {
    const std::string tool_frame = frame_name(config_.tool_frame);
    std_msgs::Header header;
    header.frame_id = tool_frame;
    for (const geometry_msgs::TransformStamped& transform : message.transforms) {
      if (frame_name(transform.child_frame_id) != tool_frame || transform.header.stamp.isZero()) continue;
      tool_frame_is_direct_ = true;
      header.stamp = transform.header.stamp;
      offer(header, Pose::Identity());
    }
    if (!tool_frame_is_direct_ && tf_.find_newest(tissue_frame_, tool_frame, header.stamp) &&
        !header.stamp.isZero() && header.stamp != newest_tf_) {
      newest_tf_ = header.stamp;
      offer(header, Pose::Identity());
    }
  }
  place_all();
}

void ToolTracker::offer(const std_msgs::Header& header, const Pose& pose) {
  if (header.stamp.isZero())
    ROS_WARN_THROTTLE(kWarnEvery, "Left out %s with the stamp 0: must be the time of the pose",
                      source().c_str());
  const std::uint64_t late = queue_.counts().out_of_order;
  queue_.push({header.stamp, frame_name(header.frame_id), pose, std::chrono::steady_clock::now()});
  if (queue_.counts().out_of_order > late)
    ROS_WARN_THROTTLE(kWarnEvery, "Left out %s at %.3f s: must be later than the pose before",
                      source().c_str(), header.stamp.toSec());
  place_all();
}

PoseQueue::Placing ToolTracker::place(ReceivedPose& pose) const {
  const std::optional<Pose> X_TF = tf_.find(tissue_frame_, pose.frame, pose.stamp);
  if (X_TF) {
    pose.pose = *X_TF * pose.pose;
    pose.frame = tissue_frame_;
    return PoseQueue::Placing::kPlaced;
  }
  if (seconds_since(pose.arrival) <= patience_) return PoseQueue::Placing::kWait;
  ROS_WARN_THROTTLE(kWarnEvery, "Left out %s: tf has no transform from '%s' to '%s' at %.3f s",
                    source().c_str(), pose.frame.c_str(), tissue_frame_.c_str(), pose.stamp.toSec());
  return PoseQueue::Placing::kGiveUp;
}

void ToolTracker::place_all() {
  queue_.place([this](ReceivedPose& pose) { return place(pose); });
}

std::optional<ReceivedPose> ToolTracker::take() {
  place_all();
  return queue_.take();
}

std::map<std::string, Pose> ToolTracker::grips(double time) const {
  std::map<std::string, Pose> poses;
  std::string unknown;
  for (const std::string& frame : followed_) {
    std::optional<Pose> X_TF = tf_.find(tissue_frame_, frame_name(frame), ros::Time(std::max(time, 0.0)));
    ros::Time stamp;
    if (!X_TF) {
      X_TF = tf_.find_newest(tissue_frame_, frame_name(frame), stamp);
      if (!X_TF) unknown += (unknown.empty() ? "'" : ", '") + frame + "'";
      if (stamp.toSec() > time) X_TF.reset();  // it is not there yet
    }
    if (X_TF) poses[frame] = *X_TF;
  }
  if (!unknown.empty())
    ROS_WARN_DELAYED_THROTTLE(kWarnEvery,
                              "tissue.fixed: follow: tf has no transform from %s to '%s': the region stays",
                              unknown.c_str(), tissue_frame_.c_str());
  return poses;
}

bool ToolTracker::grips_are_late(double time) const {
  return std::any_of(followed_.begin(), followed_.end(), [&](const std::string& frame) {
    if (tf_.find(tissue_frame_, frame_name(frame), ros::Time(std::max(time, 0.0)))) return false;
    ros::Time stamp;
    return !tf_.find_newest(tissue_frame_, frame_name(frame), stamp) || stamp.toSec() < time;
  });
}

}  // namespace cfem_cutting
