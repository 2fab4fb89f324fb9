#pragma once

#include "cfem_cutting/io/replay.h"

namespace cfem_cutting {

/// Reads the tool's poses (PoseStamped or TransformStamped) and followed frames from a bag, brought to the
/// tissue frame at their stamps by the bag's tf and tf_static. Needs no ROS master. Followed frames are
/// sampled at the tool's stamps.
/// @throw FileError unreadable, no bag, truncated or unindexed; the topic is missing; no pose can be brought
/// to the tissue frame
Recording read_bag(const BagRequest& request);

}  // namespace cfem_cutting
