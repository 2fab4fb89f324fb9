#include "cfem_cutting/ros/tf_input.h"

#include <tf2/exceptions.h>

#include "cfem_cutting/ros/conversions.h"

namespace cfem_cutting {

TfInput::TfInput(ros::NodeHandle& node, double memory, Listener listener)
    : buffer_(ros::Duration(memory)), listener_(std::move(listener)) {
  constexpr std::uint32_t queue = 1000;
  const auto hints = ros::TransportHints().tcpNoDelay();
  using Message = tf2_msgs::TFMessage::ConstPtr;
  const boost::function<void(const Message&)> on_dynamic = [this](const Message& m) { receive(*m, false); };
  const boost::function<void(const Message&)> on_static = [this](const Message& m) { receive(*m, true); };
  dynamic_ = node.subscribe<tf2_msgs::TFMessage>("/tf", queue, on_dynamic, ros::VoidConstPtr(), hints);
  static_ = node.subscribe<tf2_msgs::TFMessage>("/tf_static", queue, on_static, ros::VoidConstPtr(), hints);
}

void TfInput::receive(const tf2_msgs::TFMessage& message, bool is_static) {
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    Pose pose;
    if (!to_pose(transform.transform, pose)) continue;
    if (buffer_.setTransform(transform, "tf", is_static) || is_static) continue;
    buffer_.clear();  // older than all it remembers of this frame
    buffer_.setTransform(transform, "tf", is_static);
  }
  listener_(message);
}

std::optional<Pose> TfInput::look_up(const std::string& A, const std::string& B, const ros::Time& time,
                                     ros::Time& stamp) const {
  if (A == B) return Pose::Identity();
  if (A.empty() || B.empty()) return std::nullopt;
  try {
    const geometry_msgs::TransformStamped transform = buffer_.lookupTransform(A, B, time);
    stamp = transform.header.stamp;
    Pose X_AB;
    if (to_pose(transform.transform, X_AB)) return X_AB;
  } catch (const tf2::TransformException&) {
  }
  return std::nullopt;
}

std::optional<Pose> TfInput::find(const std::string& A, const std::string& B, const ros::Time& time) const {
  ros::Time stamp;
  return look_up(A, B, time, stamp);
}

std::optional<Pose> TfInput::find_newest(const std::string& A, const std::string& B, ros::Time& stamp) const {
  return look_up(A, B, ros::Time(0), stamp);
}

}  // namespace cfem_cutting
