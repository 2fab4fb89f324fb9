#include "cfem_cutting/ros/tool_path_player.h"

#include <geometry_msgs/PoseStamped.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cmath>
#include <filesystem>
#include <iostream>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/io/tool_path.h"
#include "cfem_cutting/ros/conversions.h"
#include "cfem_cutting/ros/parameters.h"

namespace cfem_cutting {
namespace {

class Player {
 public:
  explicit Player(ToolPaths paths) : paths_(std::move(paths)) {
    poses_ = ros::NodeHandle().advertise<geometry_msgs::PoseStamped>("tool/measured_cp", 1000);
  }

  void wait_for_subscriber() const {
    while (ros::ok() && poses_.getNumSubscribers() == 0) ros::WallDuration(0.02).sleep();
    ros::WallDuration(0.3).sleep();  // tf's listeners connect too
  }

  /// Stamps are start + i / rate, whenever the sending is done.
  void play(const ros::Time& start) {
    const auto last = std::llround(paths_.tool.duration() * paths_.rate);
    for (long long i = 0; i <= last && ros::ok(); ++i) {
      const double t = static_cast<double>(i) / paths_.rate;
      const ros::Time stamp = start + ros::Duration(t);
      ros::Time::sleepUntil(stamp);
      send(t, stamp);
      ros::spinOnce();
    }
  }

  double duration() const { return paths_.tool.duration() + 1.0 / paths_.rate; }

 private:
  geometry_msgs::TransformStamped transform(const ToolPath& path, double t, const ros::Time& stamp) const {
    geometry_msgs::TransformStamped message;
    message.header.stamp = stamp;
    message.header.frame_id = paths_.parent;
    message.child_frame_id = path.frame();
    message.transform = to_transform(path.at(t));
    return message;
  }

  void send(double t, const ros::Time& stamp) {
    std::vector<geometry_msgs::TransformStamped> transforms{transform(paths_.tool, t, stamp)};
    for (const ToolPath& other : paths_.others) transforms.push_back(transform(other, t, stamp));
    broadcaster_.sendTransform(transforms);
    geometry_msgs::PoseStamped pose;
    pose.header = transforms.front().header;
    pose.pose.position = to_point(paths_.tool.at(t).translation());
    pose.pose.orientation = transforms.front().transform.rotation;
    poses_.publish(pose);
  }

  ToolPaths paths_;
  ros::Publisher poses_;
  tf2_ros::TransformBroadcaster broadcaster_;
};

void play_all() {
  ros::NodeHandle settings("~");
  const std::string file = settings.param<std::string>("path", "");
  if (file.empty()) throw ConfigError("the parameter ~path, a file of config/paths, is needed");
  const bool repeat = settings.param("repeat", false);
  Player player(read_tool_paths(std::filesystem::absolute(ros_path_resolver()(file))));
  if (settings.param("wait_for_subscriber", true)) player.wait_for_subscriber();
  while (ros::ok() && ros::Time::now().isZero()) ros::WallDuration(0.02).sleep();
  ros::Time start = ros::Time::now();
  do {
    player.play(start);
    start += ros::Duration(player.duration());
  } while (repeat && ros::ok());
  ros::WallDuration(0.5).sleep();  // the last messages are on their way
  if (settings.param("stay", false)) ros::waitForShutdown();
}

}  // namespace

int run_tool_path_player(int argc, char** argv) {
  ros::init(argc, argv, "tool_path_player");
  ros::NodeHandle node;
  try {
    play_all();
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "tool_path_player: " << error.what() << std::endl;
    return 2;
  }
}

}  // namespace cfem_cutting
