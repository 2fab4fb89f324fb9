#include "cfem_cutting/ros/services.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>

#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {
namespace {

std::string expand_home(const std::string& path) {
  const char* home = std::getenv("HOME");
  return home && (path == "~" || path.compare(0, 2, "~/") == 0) ? home + path.substr(1) : path;
}

}  // namespace

bool is_plain_name(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '.' || c == '_' || c == '-'; };
  return !name.empty() && name.size() <= 100 && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), plain);
}

Services::Services(ros::NodeHandle& private_node, StepLoop& loop, const std::string& output_dir)
    : loop_(loop), output_dir_(expand_home(output_dir)) {
  using Request = std_srvs::Trigger::Request;
  using Response = std_srvs::Trigger::Response;
  const auto add_trigger = [&](const char* name, std::function<bool()> action, const std::string& refusal) {
    const boost::function<bool(Request&, Response&)> serve =
        [this, action, refusal](Request&, Response& response) { return trigger(response, action, refusal); };
    servers_.push_back(private_node.advertiseService(name, serve));
  };
  add_trigger(
      "reset", [this] { return loop_.reset(); }, "the node is shutting down");
  add_trigger(
      "pause", [this] { return loop_.pause(); }, "the node is shutting down");
  add_trigger(
      "resume", [this] { return loop_.resume(); }, "only ~reset ends a fault");
  const boost::function<bool(GetEvents::Request&, GetEvents::Response&)> get_events =
      [this](GetEvents::Request&, GetEvents::Response& response) {
        response.events = loop_.events();
        return true;
      };
  servers_.push_back(private_node.advertiseService("get_events", get_events));
  servers_.push_back(private_node.advertiseService("save_surface", &Services::save_surface, this));
}

bool Services::trigger(std_srvs::Trigger::Response& response, const std::function<bool()>& action,
                       const std::string& refusal) {
  try {
    response.success = action();
    response.message = response.success ? name_of(loop_.status().state) : refusal;
  } catch (const std::exception& error) {
    response.success = false;
    response.message = error.what();
  }
  return true;
}

bool Services::save_surface(SaveSurface::Request& request, SaveSurface::Response& response) {
  if (!is_plain_name(request.name)) {
    response.message =
        "a name of letters, digits, '.', '_' and '-' is needed that doesn't start with '.', not a path";
    return true;
  }
  const std::filesystem::path folder = output_dir_;
  const bool has_ending = std::filesystem::path(request.name).extension() == ".ply";
  response.path = (folder / (request.name + (has_ending ? "" : ".ply"))).string();
  try {
    DeformedSurface surface;
    response.success =
        loop_.run_between_steps([&](Simulation& simulation) { surface = simulation.deformed_surface(); });
    if (!response.success) return true;
    std::filesystem::create_directories(folder);
    write_ply(response.path, surface.mesh(), surface.cut, surface.label);
  } catch (const std::exception& error) {
    response.success = false;
    response.message = error.what();
  }
  return true;
}

}  // namespace cfem_cutting
