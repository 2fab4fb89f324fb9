#include "cfem_cutting/ros/cutting_node.h"

#include <ros/console.h>

#include "cfem_cutting/ros/parameters.h"

namespace cfem_cutting {
namespace {

std::string tool_frame(const Config& config) {
  return config.node.pose_input == PoseInput::kTf ? config.node.tool_frame
                                                  : config.simulation.blade.tool_link;
}

std::unique_ptr<Simulation> make_simulation(const SimulationConfig& config, const std::string& description) {
  const PathResolver resolve = ros_path_resolver();
  const std::unique_ptr<Shape> shape = load_shape(config.tissue, resolve);
  const Blade blade = load_blade(config.blade, resolve, description);
  auto simulation = std::make_unique<Simulation>(config, *shape, blade);
  for (const std::string& warning : simulation->warnings()) ROS_WARN("%s", warning.c_str());
  return simulation;
}

}  // namespace

CuttingNode::CuttingNode(ros::NodeHandle node, ros::NodeHandle private_node)
    : node_(node),
      private_node_(private_node),
      config_(read_parameters(private_node)),
      step_publisher_(node_, config_.simulation.tissue.frame, tool_frame(config_)),
      scene_publisher_(node_, config_),
      tracker_(node_, config_),
      loop_(config_, make_simulation(config_.simulation, robot_description(node)), tracker_, step_publisher_,
            scene_publisher_),
      services_(private_node_, loop_, config_.node.output_dir),
      diagnostics_(node_, loop_, tracker_, config_.node.max_lag) {
  ROS_INFO("Ready to cut");
}

bool CuttingNode::shut_down(double patience) {
  step_publisher_.close(loop_.time());
  loop_.request_stop();
  const auto start = std::chrono::steady_clock::now();
  while (!loop_.stopped()) {
    if (std::chrono::steady_clock::now() - start > std::chrono::duration<double>(patience)) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace cfem_cutting
