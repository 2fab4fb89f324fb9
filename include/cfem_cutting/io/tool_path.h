#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// Poses of one frame through time.
///
///     frame: scalpel            # the frame that moves
///     smooth: true              # Catmull-Rom through the points; otherwise straight from point to point
///     waypoints:
///       - {t: 0.0, xyz: [0, 0, 0.06], rpy: [0, 0, 0]}   # s, m, rad; rpy as in URDF, kept from the point
///       before
class ToolPath {
 public:
  /// @throw ConfigError names what is missing, or a time that does not increase
  ToolPath(const YAML::Node& yaml, const std::string& name);

  const std::string& frame() const { return frame_; }
  double duration() const { return waypoints_.back().t; }  ///< s

  /// Pose at a time since the start (s); held at both ends.
  Pose at(double time) const;

 private:
  struct Waypoint {
    double t;
    Vec3 xyz;
    Eigen::Quaterniond rotation;
  };
  Vec3 velocity(std::size_t i) const;

  std::string frame_;
  bool smooth_ = false;
  std::vector<Waypoint> waypoints_;
};

/// A tool's path and those of frames that move with it in time (graspers), as in config/paths.
struct ToolPaths {
  std::string parent = "tissue";  ///< frame of all poses
  double rate = 50.0;             ///< Hz
  ToolPath tool;
  std::vector<ToolPath> others;
};

/// @throw ConfigError, FileError
ToolPaths read_tool_paths(const std::string& file);

}  // namespace cfem_cutting
