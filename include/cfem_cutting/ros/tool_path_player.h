#pragma once

namespace cfem_cutting {

/// Publishes the poses of a path of config/paths (`~path`, a file) on tool/measured_cp and on tf, with stamps
/// on a fixed grid from the start; ends with the path unless `~repeat` or `~stay` (which sends no more).
/// `~wait_for_subscriber`: begins when someone listens.
/// @return exit code: 0, or 2 for bad input
int run_tool_path_player(int argc, char** argv);

}  // namespace cfem_cutting
