#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <ros/node_handle.h>

#include <map>
#include <string>
#include <vector>

#include "cfem_cutting/io/config_reader.h"
#include "cfem_cutting/ros/pose_queue.h"
#include "cfem_cutting/ros/tf_input.h"

namespace cfem_cutting {

/// Brings the tool's poses, from a topic or from tf, to the tissue frame, and keeps them until they are used.
/// Poses that are no use (no stamp, not a number, out of order, in a frame that nobody knows) are counted and
/// left out.
class ToolTracker {
 public:
  ToolTracker(ros::NodeHandle& node, const Config& config);

  /// The next pose in the tissue frame, if one is there.
  std::optional<ReceivedPose> take();

  /// X_TF of followed frames at a time (s); a frame that tf has not seen is left out.
  std::map<std::string, Pose> grips(double time) const;

  /// Whether tf may yet bring the followed frames at that time: worth waiting for when every step counts.
  bool grips_are_late(double time) const;

  /// Where poses come from, for people.
  std::string source() const;

  /// How many publish poses on the topic: of more than one they mix. With poses from tf 0.
  int publishers() const { return static_cast<int>(subscriber_.getNumPublishers()); }

  void clear() { queue_.clear(); }
  bool has_poses() const { return queue_.has_placed(); }
  PoseCounts counts() const { return queue_.counts(); }
  double newest_stamp() const { return queue_.newest_stamp(); }
  double silence() const { return queue_.silence(); }

  /// How long a pose waits for its transform, s.
  double patience() const { return patience_; }

 private:
  void refuse_pose(const std::string& fault);
  void receive_pose(const geometry_msgs::PoseStamped& message);
  void receive_transform(const geometry_msgs::TransformStamped& message);
  void receive_tf(const tf2_msgs::TFMessage& message);
  void offer(const std_msgs::Header& header, const Pose& pose);
  PoseQueue::Placing place(ReceivedPose& pose) const;
  void place_all();

  std::string tissue_frame_;
  NodeConfig config_;
  std::vector<std::string> followed_;
  double patience_;
  bool tool_frame_is_direct_ = false;  // tf carries the tool frame itself, not only a frame above it
  ros::Time newest_tf_;
  PoseQueue queue_;
  TfInput tf_;
  ros::Subscriber subscriber_;
};

}  // namespace cfem_cutting
