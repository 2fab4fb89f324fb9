#include <ros/init.h>
#include <ros/spinner.h>
#include <ros/xmlrpc_manager.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/ros/cutting_node.h"

namespace cfem_cutting {
namespace {

constexpr const char* kHelp =
    "Cuts tissue with the tool poses of a topic, and publishes surface, fractures and forces.\n"
    "Usage: rosrun cfem_cutting cutting_node [NAME:=VALUE ...]\n"
    "Settings are private parameters: doc/parameters.md and `replay --list-parameters` list them, and\n"
    "roslaunch cfem_cutting cutting.launch config:=FILE.yaml loads them.\n";

constexpr double kStepPatience = 1.2;  // s; with what follows the node is gone within two
constexpr std::size_t kThreads = 3;    // poses and tf go on while a service waits for the simulation

volatile std::sig_atomic_t stop_requested = 0;

volatile std::sig_atomic_t running = 0;

// While the tissue is being built nothing has been published that would have to be taken back.
void request_stop(int) {
  stop_requested = 1;
  if (!running) std::_Exit(0);
}

// In place of roscpp's answers to a signal and to `rosnode kill`: those lose what is published last.
void handle_stop_requests() {
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  const ros::XMLRPCManagerPtr& manager = ros::XMLRPCManager::instance();
  manager->unbind("shutdown");
  manager->bind("shutdown", [](XmlRpc::XmlRpcValue&, XmlRpc::XmlRpcValue& result) {
    stop_requested = 1;
    result = ros::xmlrpc::responseInt(1, "", 0);
  });
}

void wait_for_stop() {
  while (ros::ok() && !stop_requested) ros::WallDuration(0.01).sleep();
}

// A step that takes too long to wait for ends with the process.
void run_until_stopped() {
  CuttingNode node(ros::NodeHandle(), ros::NodeHandle("~"));
  running = 1;
  ros::AsyncSpinner spinner(kThreads);
  spinner.start();
  wait_for_stop();
  const bool stopped = node.shut_down(kStepPatience);
  ros::WallDuration(0.05).sleep();  // the last wrench is on its way
  ros::shutdown();
  if (!stopped) std::_Exit(0);
}

}  // namespace

int run_cutting_node(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    if (std::string(argv[i]) == "--help" || std::string(argv[i]) == "-h") return std::cout << kHelp, 0;
  ros::init(argc, argv, "cutting_node", ros::init_options::NoSigintHandler);
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  try {
    ros::start();
    handle_stop_requests();
    run_until_stopped();
    return 0;
  } catch (const Error& error) {
    std::cerr << "cutting_node: " << error.what() << std::endl;
    return 2;
  }
}

}  // namespace cfem_cutting
