#pragma once

#include <map>
#include <string>
#include <vector>

namespace cfem_cutting {

/// The command line of `replay`.
struct ReplayOptions {
  std::string config;
  std::vector<std::string> overrides;  ///< key.path=value
  std::string bag, poses;              ///< files; at most one is set
  double duration = 0.0;               ///< s, without a tool; if neither is set
  std::string out;
  std::string topic = "tool/measured_cp";
  std::map<std::string, std::string> follow;  ///< frame → file
  double surface_every = 0.0;                 ///< s, 0: never
  bool list_parameters = false;
  bool help = false;
  std::string help_text;
};

/// @throw ConfigError a line that says what is wrong
ReplayOptions parse_replay_options(int argc, const char* const* argv);

}  // namespace cfem_cutting
