#include "cfem_cutting/ros/bag_reader.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2/buffer_core.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <fstream>
#include <limits>
#include <optional>
#include <set>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/io/files.h"
#include "cfem_cutting/ros/conversions.h"
#include "cfem_cutting/ros/pose_queue.h"

namespace cfem_cutting {
namespace {

std::string without_slash(const std::string& name) {
  const std::size_t first = name.find_first_not_of('/');
  return first == std::string::npos ? "" : name.substr(first);
}

bool is_static_tf(const std::string& topic) { return without_slash(topic) == "tf_static"; }
bool is_tf(const std::string& topic) { return without_slash(topic) == "tf" || is_static_tf(topic); }

/// By the node's rules.
/// @return false if the message is of another type
bool push(const rosbag::MessageInstance& message, PoseQueue& queue) {
  std_msgs::Header header;
  Pose pose;
  bool valid = false;
  if (const auto stamped = message.instantiate<geometry_msgs::PoseStamped>()) {
    header = stamped->header;
    valid = to_pose(stamped->pose, pose);
  } else if (const auto transform = message.instantiate<geometry_msgs::TransformStamped>()) {
    header = transform->header;
    valid = to_pose(transform->transform, pose);
  } else {
    return false;
  }
  if (valid) {
    queue.push({header.stamp, without_slash(header.frame_id), pose, {}});
  } else {
    queue.count_invalid();
  }
  return true;
}

/// All transforms of the bag.
/// @return the stamps of those that move
std::set<ros::Time> read_transforms(const rosbag::Bag& bag, tf2::BufferCore& buffer) {
  std::set<ros::Time> stamps;
  rosbag::View view(bag, [](const rosbag::ConnectionInfo* c) { return is_tf(c->topic); });
  for (const rosbag::MessageInstance& message : view) {
    const auto transforms = message.instantiate<tf2_msgs::TFMessage>();
    if (!transforms) continue;
    for (geometry_msgs::TransformStamped transform : transforms->transforms) {
      Pose pose;
      if (!to_pose(transform.transform, pose)) continue;
      transform.header.frame_id = without_slash(transform.header.frame_id);
      transform.child_frame_id = without_slash(transform.child_frame_id);
      buffer.setTransform(transform, "bag", is_static_tf(message.getTopic()));
      if (!is_static_tf(message.getTopic())) stamps.insert(transform.header.stamp);
    }
  }
  return stamps;
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

void read_poses(const rosbag::Bag& bag, const BagRequest& request, PoseQueue& queue) {
  const std::string topic = without_slash(request.topic);
  rosbag::View view(bag, [&](const rosbag::ConnectionInfo* c) { return without_slash(c->topic) == topic; });
  if (view.size() == 0) refuse_topic(bag, request);
  for (const rosbag::MessageInstance& message : view)
    if (!push(message, queue))
      throw FileError(request.path + ": topic '" + request.topic + "' is " + message.getDataType() +
                      ": must be geometry_msgs/PoseStamped or geometry_msgs/TransformStamped");
}

std::optional<Pose> look_up(const tf2::BufferCore& buffer, const std::string& target,
                            const std::string& source, const ros::Time& stamp, std::string& why_not) try {
  if (target == source) return Pose::Identity();
  return tf2::transformToEigen(buffer.lookupTransform(target, source, stamp));
} catch (const tf2::TransformException& error) {
  why_not = error.what();
  return std::nullopt;
}

/// What the node counts in its diagnostics.
std::string list_unused(const PoseCounts& counts, const std::string& tissue, const std::string& why_not) {
  std::string list;
  const auto add = [&](std::uint64_t count, const std::string& what) {
    if (count > 0) list += (list.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(counts.no_stamp, "without a stamp");
  add(counts.invalid, "not finite, absurdly far away or without a unit quaternion");
  add(counts.received - counts.used - counts.no_stamp - counts.invalid - counts.no_transform, "out of order");
  add(counts.no_transform, "that cannot be brought to frame '" + tissue + "' (" + why_not + ")");
  return list;
}

/// Places the poses, and takes them in their order.
Recording bring_to_tissue(PoseQueue& queue, const tf2::BufferCore& buffer, const BagRequest& request) {
  const std::string tissue = without_slash(request.tissue_frame);
  std::string why_not;
  queue.place([&](ReceivedPose& pose) {
    const auto X_TF = look_up(buffer, tissue, pose.frame, pose.stamp, why_not);
    if (!X_TF) return PoseQueue::Placing::kGiveUp;
    pose.pose = *X_TF * pose.pose;
    return PoseQueue::Placing::kPlaced;
  });
  Recording recording;
  while (const std::optional<ReceivedPose> pose = queue.take())
    recording.tool.push_back({pose->stamp.toSec(), pose->pose});
  const PoseCounts counts = queue.counts();
  const std::string message = "topic '" + request.topic + "': of " + std::to_string(counts.received) +
                              " poses are not used: " + list_unused(counts, tissue, why_not);
  if (recording.tool.empty()) throw FileError(request.path + ": " + message);
  if (counts.used < counts.received) recording.warnings.push_back(message);
  return recording;
}

/// A followed frame, at the times of all transforms in the bag.
PoseTrack follow(const std::string& frame, const std::set<ros::Time>& stamps, const tf2::BufferCore& buffer,
                 const BagRequest& request) {
  PoseTrack track;
  std::string ignored;
  for (const ros::Time& stamp : stamps)
    if (const auto X_TF =
            look_up(buffer, without_slash(request.tissue_frame), without_slash(frame), stamp, ignored))
      track.push_back({stamp.toSec(), *X_TF});
  return track;
}

/// Keeps the transforms of the whole bag, whatever its length.
ros::Duration cache_time(const rosbag::Bag& bag) {
  rosbag::View view(bag);
  const double length = view.size() == 0 ? 0.0 : (view.getEndTime() - view.getBeginTime()).toSec();
  return ros::Duration(length + 3600.0);
}

Recording read_open_bag(const rosbag::Bag& bag, const BagRequest& request) {
  PoseQueue queue(std::numeric_limits<std::size_t>::max());
  read_poses(bag, request, queue);
  tf2::BufferCore buffer(cache_time(bag));
  const std::set<ros::Time> stamps = read_transforms(bag, buffer);
  Recording recording = bring_to_tissue(queue, buffer, request);
  for (const std::string& frame : request.frames)
    recording.frames[frame] = follow(frame, stamps, buffer, request);
  return recording;
}

/// Whatever follows: a bag may have been cut off.
void check_beginning(const std::string& path) {
  check_readable(path);
  const std::string wanted = "#ROS";  // #ROSBAG V2.0, or #ROSRECORD in older ones
  std::string beginning(wanted.size(), ' ');
  std::ifstream(path, std::ios::binary).read(&beginning[0], static_cast<std::streamsize>(wanted.size()));
  if (beginning != wanted) throw FileError(path + ": is no bag: must begin with #ROSBAG");
}

}  // namespace

Recording read_bag(const BagRequest& request) {
  check_beginning(request.path);
  try {
    rosbag::Bag bag;
    bag.open(request.path, rosbag::bagmode::Read);
    return read_open_bag(bag, request);
  } catch (const ros::Exception& error) {
    throw FileError(request.path + ": truncated or unindexed; run `rosbag reindex` (" + error.what() + ")");
  }
}

}  // namespace cfem_cutting
