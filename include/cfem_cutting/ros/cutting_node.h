#pragma once

#include <ros/node_handle.h>

#include "cfem_cutting/ros/diagnostics.h"
#include "cfem_cutting/ros/services.h"

namespace cfem_cutting {

/// The whole node: poses in; surface, events, forces and reports out.
class CuttingNode {
 public:
  /// Reads the parameters and builds tissue and blade.
  /// @throw Error one line that names what is wrong
  CuttingNode(ros::NodeHandle node, ros::NodeHandle private_node);

  /// Sends the last zero wrench and ends the loop.
  /// @param patience s, for the step that runs now
  /// @return false if that step goes on
  bool shut_down(double patience);

 private:
  ros::NodeHandle node_, private_node_;
  Config config_;
  StepPublisher step_publisher_;
  ScenePublisher scene_publisher_;
  ToolTracker tracker_;
  StepLoop loop_;
  Services services_;
  Diagnostics diagnostics_;
};

/// Runs the node until SIGINT, SIGTERM or `rosnode kill`; a zero wrench is the last it says.
/// @return exit code: 0, or 2 for bad input
int run_cutting_node(int argc, char** argv);

}  // namespace cfem_cutting
