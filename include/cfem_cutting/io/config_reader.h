#pragma once

#include <yaml-cpp/yaml.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cfem_cutting/simulation/simulation.h"
#include "cfem_cutting/volume/shapes.h"

namespace cfem_cutting {

enum class PoseInput { kPose, kTransform, kTf };
enum class Timing { kLossless, kRealtime };

/// The `node.` keys; not used offline.
struct NodeConfig {
  PoseInput pose_input = PoseInput::kPose;
  std::string tool_frame = "tool";
  Timing timing = Timing::kRealtime;
  double max_lag = 0.1;         ///< s
  double input_timeout = 0.25;  ///< s
  double marker_rate = 20.0;    ///< Hz
  std::string output_dir = "~/.ros/cfem_cutting";
  bool reset_on_loop = false;
};

struct Config {
  SimulationConfig simulation;
  NodeConfig node;
};

/// Reads and checks a whole configuration: unknown keys, wrong types, values out of range and contradictions
/// are refused. Numbers may be integers, reals or numeric strings.
/// @throw ConfigError one line: key, value, rule
Config read_config(const YAML::Node& yaml);

/// Reads a YAML file, with `key.path=value` overrides (value is YAML).
/// @throw ConfigError, FileError
Config read_config_file(const std::string& path, const std::vector<std::string>& overrides);

/// One documented key of the schema, for generated documentation and tests against drift.
struct KeyDoc {
  std::string key, default_value, unit, rule, description;
};
const std::vector<KeyDoc>& schema();

/// Turns package://NAME/rest, file://… and plain paths into file names.
using PathResolver = std::function<std::string(const std::string& uri)>;

/// The resolver for programs without ROS: package:// by ROS_PACKAGE_PATH, and this package by where the
/// configuration lies (a parent folder with this package's package.xml).
PathResolver make_path_resolver(const std::string& config_path);

/// Builds the tissue's shape of a configuration: a box, a mesh or a label image, by the source's ending.
/// @throw FileError, GeometryError
std::unique_ptr<Shape> load_shape(const TissueConfig& tissue, const PathResolver& resolve);

/// Builds the blade: from `edge`, or from `edge_links` and the URDF (robot_description: used if blade.urdf is
/// empty).
/// @throw ConfigError, FileError
Blade load_blade(const BladeConfig& blade, const PathResolver& resolve,
                 const std::string& robot_description = "");

}  // namespace cfem_cutting
