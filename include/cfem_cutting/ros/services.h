#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <std_srvs/Trigger.h>

#include <string>
#include <vector>

#include "cfem_cutting/ros/step_loop.h"

namespace cfem_cutting {

/// Whether a name can be a file's in one folder: letters, digits, '.', '_', '-', at most 100, not starting
/// with '.'.
bool is_plain_name(const std::string& name);

/// The private services of the node.
class Services {
 public:
  /// @param output_dir where surfaces are saved; ~ is the home folder
  Services(ros::NodeHandle& private_node, StepLoop& loop, const std::string& output_dir);

 private:
  bool trigger(std_srvs::Trigger::Response& response, const std::function<bool()>& action,
               const std::string& refusal);
  bool save_surface(SaveSurface::Request& request, SaveSurface::Response& response);

  StepLoop& loop_;
  std::string output_dir_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace cfem_cutting
