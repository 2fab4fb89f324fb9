#include "cfem_cutting/ros/bag_reader.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2/buffer_core.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <filesystem>
#include <optional>
#include <set>

#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {
namespace {

std::string without_slash(const std::string& name) {
  const std::size_t first = name.find_first_not_of('/');
  return first == std::string::npos ? "" : name.substr(first);
}

bool is_static_tf(const std::string& topic) { return without_slash(topic) == "tf_static"; }
bool is_tf(const std::string& topic) { return without_slash(topic) == "tf" || is_static_tf(topic); }

/// A tool's pose in the frame that it was sent in.
struct SentPose {
  ros::Time stamp;
  std::string frame;
  Pose pose;
};

Pose to_pose(const geometry_msgs::Pose& message, const BagRequest& request) {
  const Eigen::Quaterniond rotation(message.orientation.w, message.orientation.x, message.orientation.y,
                                    message.orientation.z);
  const Vec3 position(message.position.x, message.position.y, message.position.z);
  if (!position.allFinite() || !(rotation.norm() > 1e-6))
    throw FileError(request.path + ": topic '" + request.topic +
                    "': a pose is not finite or has a zero quaternion");
  return Eigen::Translation3d(position) * rotation.normalized();
}

std::optional<SentPose> to_sent_pose(const rosbag::MessageInstance& message, const BagRequest& request) {
  if (const auto pose = message.instantiate<geometry_msgs::PoseStamped>())
    return SentPose{pose->header.stamp, without_slash(pose->header.frame_id), to_pose(pose->pose, request)};
  if (const auto transform = message.instantiate<geometry_msgs::TransformStamped>()) {
    geometry_msgs::Pose pose;
    pose.position.x = transform->transform.translation.x;
    pose.position.y = transform->transform.translation.y;
    pose.position.z = transform->transform.translation.z;
    pose.orientation = transform->transform.rotation;
    return SentPose{transform->header.stamp, without_slash(transform->header.frame_id),
                    to_pose(pose, request)};
  }
  return std::nullopt;
}

/// All transforms of the bag.
void read_transforms(const rosbag::Bag& bag, tf2::BufferCore& buffer) {
  rosbag::View view(bag, [](const rosbag::ConnectionInfo* c) { return is_tf(c->topic); });
  for (const rosbag::MessageInstance& message : view) {
    const auto transforms = message.instantiate<tf2_msgs::TFMessage>();
    if (!transforms) continue;
    for (geometry_msgs::TransformStamped transform : transforms->transforms) {
      transform.header.frame_id = without_slash(transform.header.frame_id);
      transform.child_frame_id = without_slash(transform.child_frame_id);
      buffer.setTransform(transform, "bag", is_static_tf(message.getTopic()));
    }
  }
}

[[noreturn]] void refuse_topic(const rosbag::Bag& bag, const BagRequest& request) {
  rosbag::View view(bag);
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) topics.insert(connection->topic);
  std::string list;
  for (const std::string& topic : topics) list += (list.empty() ? "" : ", ") + topic;
  throw FileError(request.path + ": no topic '" + request.topic + "'; it has " +
                  (list.empty() ? "none" : list));
}

std::vector<SentPose> read_sent_poses(const rosbag::Bag& bag, const BagRequest& request) {
  const std::string topic = without_slash(request.topic);
  rosbag::View view(bag, [&](const rosbag::ConnectionInfo* c) { return without_slash(c->topic) == topic; });
  if (view.size() == 0) refuse_topic(bag, request);
  std::vector<SentPose> poses;
  for (const rosbag::MessageInstance& message : view) {
    const std::optional<SentPose> pose = to_sent_pose(message, request);
    if (!pose)
      throw FileError(request.path + ": topic '" + request.topic + "' is " + message.getDataType() +
                      ": must be geometry_msgs/PoseStamped or geometry_msgs/TransformStamped");
    if (!pose->stamp.isZero()) poses.push_back(*pose);  // zero: invalid (CRTK)
  }
  return poses;
}

std::optional<Pose> look_up(const tf2::BufferCore& buffer, const std::string& target,
                            const std::string& source, const ros::Time& stamp, std::string& why_not) try {
  if (target == source) return Pose::Identity();
  return tf2::transformToEigen(buffer.lookupTransform(target, source, stamp));
} catch (const tf2::TransformException& error) {
  why_not = error.what();
  return std::nullopt;
}

Recording bring_to_tissue(const std::vector<SentPose>& poses, const tf2::BufferCore& buffer,
                          const BagRequest& request) {
  const std::string tissue = without_slash(request.tissue_frame);
  Recording recording;
  std::string why_not;
  for (const SentPose& sent : poses) {
    const double time = sent.stamp.toSec();
    if (const auto X_TS = look_up(buffer, tissue, sent.frame, sent.stamp, why_not))
      recording.tool.push_back({time, *X_TS * sent.pose});
    std::string ignored;
    for (const std::string& frame : request.frames) {
      PoseTrack& track = recording.frames[frame];
      const auto X_TF = look_up(buffer, tissue, without_slash(frame), sent.stamp, ignored);
      if (X_TF && (track.empty() || time > track.back().time)) track.push_back({time, *X_TF});
    }
  }
  const std::size_t lost = poses.size() - recording.tool.size();
  const std::string message = "topic '" + request.topic + "': " + std::to_string(lost) + " of " +
                              std::to_string(poses.size()) + " poses cannot be brought to frame '" + tissue +
                              "': " + why_not;
  if (recording.tool.empty()) throw FileError(request.path + ": " + message);
  if (lost > 0) recording.warnings.push_back(message);
  return recording;
}

/// Keeps the transforms of the whole bag, whatever its length.
ros::Duration cache_time(const rosbag::Bag& bag) {
  rosbag::View view(bag);
  const double length = view.size() == 0 ? 0.0 : (view.getEndTime() - view.getBeginTime()).toSec();
  return ros::Duration(length + 3600.0);
}

Recording read_open_bag(const rosbag::Bag& bag, const BagRequest& request) {
  const std::vector<SentPose> poses = read_sent_poses(bag, request);
  if (poses.empty())
    throw FileError(request.path + ": topic '" + request.topic + "': all stamps are zero (invalid)");
  tf2::BufferCore buffer(cache_time(bag));
  read_transforms(bag, buffer);
  return bring_to_tissue(poses, buffer, request);
}

}  // namespace

Recording read_bag(const BagRequest& request) {
  if (!std::filesystem::is_regular_file(request.path)) throw FileError(request.path + ": cannot be read");
  try {
    rosbag::Bag bag;
    bag.open(request.path, rosbag::bagmode::Read);
    return read_open_bag(bag, request);
  } catch (const ros::Exception& error) {
    throw FileError(request.path + ": truncated or unindexed; run `rosbag reindex` (" + error.what() + ")");
  }
}

}  // namespace cfem_cutting
