#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// Listens to /tf and /tf_static and tells when something has come in, so that poses need not be polled for.
/// When the stamps of a frame run backwards farther than the buffer remembers (a bag that is played again),
/// it starts afresh.
class TfInput {
 public:
  /// Called after a message is in the buffer.
  using Listener = std::function<void(const tf2_msgs::TFMessage&)>;

  /// @param memory s, how long transforms are kept
  TfInput(ros::NodeHandle& node, double memory, Listener listener);

  /// X_AB at a time, or nothing where it is not known.
  std::optional<Pose> find(const std::string& A, const std::string& B, const ros::Time& time) const;

  /// The newest X_AB and its stamp (zero: static).
  std::optional<Pose> find_newest(const std::string& A, const std::string& B, ros::Time& stamp) const;

 private:
  void receive(const tf2_msgs::TFMessage& message, bool is_static);
  std::optional<Pose> look_up(const std::string& A, const std::string& B, const ros::Time& time,
                              ros::Time& stamp) const;

  tf2::BufferCore buffer_;
  Listener listener_;
  ros::Subscriber dynamic_, static_;
};

}  // namespace cfem_cutting
