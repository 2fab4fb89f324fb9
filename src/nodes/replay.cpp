/// Cuts tissue with recorded poses, without a ROS master; see --help.

#include "cfem_cutting/io/replay.h"

#ifdef CFEM_CUTTING_WITH_BAGS
#include "cfem_cutting/ros/bag_reader.h"
#endif

int main(int argc, char** argv) {
#ifdef CFEM_CUTTING_WITH_BAGS
  return cfem_cutting::replay_main(argc, argv, cfem_cutting::read_bag);
#else
  return cfem_cutting::replay_main(argc, argv, nullptr);
#endif
}
