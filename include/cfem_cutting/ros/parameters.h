#pragma once
/// The configuration from the parameter server.

#include <XmlRpcValue.h>
#include <ros/node_handle.h>

#include <string>

#include "cfem_cutting/io/config_reader.h"

namespace cfem_cutting {

/// A parameter as YAML, as if it had been read from a file.
/// @throw ConfigError binary data or a date, which no key takes
YAML::Node to_yaml(const XmlRpc::XmlRpcValue& value);

/// The private parameters of a node, with the keys, defaults and checks of a configuration file.
/// @throw ConfigError
Config read_parameters(const ros::NodeHandle& private_node);

/// The URDF document in robot_description, looked for upwards from the node's namespace; empty if there is
/// none.
std::string robot_description(const ros::NodeHandle& node);

/// package:// by the ROS package path, file:// and plain paths.
/// @throw FileError (when called) for a package that is not there
PathResolver ros_path_resolver();

}  // namespace cfem_cutting
