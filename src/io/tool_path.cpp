#include "cfem_cutting/io/tool_path.h"

#include <algorithm>

#include "cfem_cutting/blade/blade.h"
#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/io/files.h"

namespace cfem_cutting {
namespace {

Vec3 to_vec3(const YAML::Node& yaml, const std::string& name) {
  const auto values = yaml.as<std::vector<double>>();
  if (values.size() != 3) throw ConfigError(name + ": three numbers are needed");
  return {values[0], values[1], values[2]};
}

Eigen::Quaterniond from_rpy(const Vec3& rpy) {
  return Eigen::AngleAxisd(rpy.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Vec3::UnitY()) *
         Eigen::AngleAxisd(rpy.x(), Vec3::UnitX());
}

Pose make_pose(const Vec3& xyz, const Eigen::Quaterniond& rotation) {
  return Eigen::Translation3d(xyz) * rotation;
}

}  // namespace

ToolPath::ToolPath(const YAML::Node& yaml, const std::string& name) {
  const YAML::Node points = yaml["waypoints"];
  if (!yaml["frame"] || !points || !points.IsSequence() || points.size() == 0) {
    throw ConfigError(name + ": 'frame' and a list 'waypoints' are needed");
  }
  frame_ = yaml["frame"].as<std::string>();
  smooth_ = yaml["smooth"] && yaml["smooth"].as<bool>();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  for (const YAML::Node& point : points) {
    const std::string here = name + ".waypoints[" + std::to_string(waypoints_.size()) + "]";
    if (!point["t"] || !point["xyz"]) throw ConfigError(here + ": 't' and 'xyz' are needed");
    if (point["rpy"]) rotation = from_rpy(to_vec3(point["rpy"], here + ".rpy"));
    const double t = point["t"].as<double>();
    if (!waypoints_.empty() && t <= waypoints_.back().t) throw ConfigError(here + ".t: times must increase");
    waypoints_.push_back({t, to_vec3(point["xyz"], here + ".xyz"), rotation});
  }
}

// Catmull-Rom for uneven times: the velocity at a point is that of the way from its neighbour to the other.
Vec3 ToolPath::velocity(std::size_t i) const {
  if (i == 0 || i + 1 == waypoints_.size()) return Vec3::Zero();
  const Waypoint &before = waypoints_[i - 1], &after = waypoints_[i + 1];
  return (after.xyz - before.xyz) / (after.t - before.t);
}

Pose ToolPath::at(double time) const {
  const auto after = std::upper_bound(waypoints_.begin(), waypoints_.end(), time,
                                      [](double t, const Waypoint& waypoint) { return t < waypoint.t; });
  if (after == waypoints_.begin()) return make_pose(after->xyz, after->rotation);
  const std::size_t i = static_cast<std::size_t>(after - waypoints_.begin()) - 1;
  const Waypoint& a = waypoints_[i];
  if (after == waypoints_.end()) return make_pose(a.xyz, a.rotation);
  const double span = after->t - a.t, s = (time - a.t) / span;
  Pose pose = interpolate(make_pose(a.xyz, a.rotation), make_pose(after->xyz, after->rotation), s);
  if (smooth_) {  // cubic Hermite
    const double s2 = s * s, s3 = s2 * s;
    pose.translation() = (2 * s3 - 3 * s2 + 1) * a.xyz + (3 * s2 - 2 * s3) * after->xyz +
                         span * ((s3 - 2 * s2 + s) * velocity(i) + (s3 - s2) * velocity(i + 1));
  }
  return pose;
}

ToolPaths read_tool_paths(const std::string& file) {
  check_readable(file);
  try {
    const YAML::Node yaml = YAML::LoadFile(file);
    if (!yaml.IsMap() || !yaml["tool"]) throw ConfigError("'tool' is needed");
    ToolPaths paths{"tissue", 50.0, ToolPath(yaml["tool"], "tool"), {}};
    if (yaml["parent"]) paths.parent = yaml["parent"].as<std::string>();
    if (yaml["rate"]) paths.rate = yaml["rate"].as<double>();
    if (!(paths.rate > 0.0 && paths.rate <= 1e4))
      throw ConfigError("rate: must be above 0 and at most 10000 Hz");
    for (const YAML::Node& other : yaml["others"]) {
      paths.others.emplace_back(other, "others[" + std::to_string(paths.others.size()) + "]");
    }
    return paths;
  } catch (const YAML::Exception& error) {
    throw ConfigError(file + ": " + error.what());
  } catch (const ConfigError& error) {
    throw ConfigError(file + ": " + error.what());
  }
}

}  // namespace cfem_cutting
