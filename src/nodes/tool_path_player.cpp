// Moves a tool along a path of config/paths.
#include "cfem_cutting/ros/tool_path_player.h"

int main(int argc, char** argv) { return cfem_cutting::run_tool_path_player(argc, argv); }
