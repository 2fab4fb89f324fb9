// Cuts simulated tissue with the poses that come in.
#include "cfem_cutting/ros/cutting_node.h"

int main(int argc, char** argv) { return cfem_cutting::run_cutting_node(argc, argv); }
