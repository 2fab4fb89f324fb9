#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cfem_cutting/io/poses.h"
#include "cfem_cutting/io/replay_options.h"

namespace cfem_cutting {

/// What is read from a bag.
struct BagRequest {
  std::string path;
  std::string topic;  ///< of the tool's poses, with or without leading slash
  std::string tissue_frame;
  std::vector<std::string> frames;  ///< followed frames, taken from tf
};
/// Reads a bag; io knows no ROS. @throw FileError
using BagReader = std::function<Recording(const BagRequest&)>;

/// `replay` as a function: no error leaves it. Errors go to standard error, one line each.
/// @param read_bag empty: bags are refused
/// @return the exit code: 0, 2 for bad input, or 128 + the number of the SIGINT or SIGTERM that ended the run
int replay_main(int argc, const char* const* argv, const BagReader& read_bag);

/// Runs a simulation over recorded poses and writes all results.
/// @throw Error
void run_replay(const ReplayOptions& options, const BagReader& read_bag);

/// All keys of the configuration as Markdown.
std::string parameters_markdown();

}  // namespace cfem_cutting
