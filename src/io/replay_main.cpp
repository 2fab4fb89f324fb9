#include <algorithm>
#include <exception>
#include <iostream>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/io/replay.h"
#include "stop_signals.h"

namespace cfem_cutting {
namespace {

constexpr int kBadInput = 2;
constexpr int kBySignal = 128;  // and the signal's number, as shells have it

int fail(std::string message, int exit_code = kBadInput) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::cerr << "replay: " << message << std::endl;
  return exit_code;
}

}  // namespace

int replay_main(int argc, const char* const* argv, const BagReader& read_bag) try {
  const ReplayOptions options = parse_replay_options(argc, argv);
  if (options.help)
    std::cout << options.help_text;
  else if (options.list_parameters)
    std::cout << parameters_markdown();
  else
    run_replay(options, read_bag);
  return 0;
} catch (const std::bad_alloc&) {
  return fail("not enough memory for this tissue: a larger tissue.voxel_size needs less");
} catch (const Stopped& stopped) {
  return fail(stopped.what(), kBySignal + stopped.signal);
} catch (const std::exception& error) {
  return fail(error.what());
}

}  // namespace cfem_cutting
