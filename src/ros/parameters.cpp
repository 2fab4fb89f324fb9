#include "cfem_cutting/ros/parameters.h"

#include <ros/package.h>

#include <cstdio>

#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {
namespace {

// All digits, so that a number is the same as from a file.
std::string to_string(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

}  // namespace

YAML::Node to_yaml(const XmlRpc::XmlRpcValue& parameter) {
  XmlRpc::XmlRpcValue value = parameter;  // its conversions are not const
  YAML::Node yaml;
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return YAML::Node(static_cast<bool>(value));
    case XmlRpc::XmlRpcValue::TypeInt:
      return YAML::Node(std::to_string(static_cast<int>(value)));
    case XmlRpc::XmlRpcValue::TypeDouble:
      return YAML::Node(to_string(static_cast<double>(value)));
    case XmlRpc::XmlRpcValue::TypeString:
      return YAML::Node(static_cast<std::string>(value));
    case XmlRpc::XmlRpcValue::TypeArray:
      yaml = YAML::Node(YAML::NodeType::Sequence);
      for (int i = 0; i < value.size(); ++i) yaml.push_back(to_yaml(value[i]));
      return yaml;
    case XmlRpc::XmlRpcValue::TypeStruct:
      yaml = YAML::Node(YAML::NodeType::Map);
      for (auto& [key, member] : value) yaml[key] = to_yaml(member);
      return yaml;
    default:
      throw ConfigError("a parameter is of a type that no key takes (a date or binary data)");
  }
}

Config read_parameters(const ros::NodeHandle& private_node) {
  XmlRpc::XmlRpcValue all;
  if (!private_node.getParam(private_node.getNamespace(), all) ||
      all.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    return read_config(YAML::Node(YAML::NodeType::Map));
  }
  return read_config(to_yaml(all));
}

std::string robot_description(const ros::NodeHandle& node) {
  std::string key, document;
  if (node.searchParam("robot_description", key)) node.getParam(key, document);
  return document;
}

PathResolver ros_path_resolver() {
  return [](const std::string& uri) {
    const std::string package_scheme = "package://", file_scheme = "file://";
    if (uri.compare(0, file_scheme.size(), file_scheme) == 0) return uri.substr(file_scheme.size());
    if (uri.compare(0, package_scheme.size(), package_scheme) != 0) return uri;
    const std::string rest = uri.substr(package_scheme.size());
    const std::string name = rest.substr(0, rest.find('/'));
    const std::string folder = ros::package::getPath(name);
    if (folder.empty()) throw FileError(uri + ": there is no ROS package '" + name + "'");
    return folder + rest.substr(name.size());
  };
}

}  // namespace cfem_cutting
