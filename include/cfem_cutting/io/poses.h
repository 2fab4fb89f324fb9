#pragma once

#include <map>
#include <string>
#include <vector>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// m, along an axis; a pose farther from its frame's origin is taken for a mistake.
constexpr double kFarthestPosition = 1e6;

struct StampedPose {
  double time;  ///< s
  Pose pose;    ///< in the tissue frame
};
using PoseTrack = std::vector<StampedPose>;

/// Everything that moved, in the tissue frame.
struct Recording {
  PoseTrack tool;                           ///< X_TB
  std::map<std::string, PoseTrack> frames;  ///< X_TF of followed frames
  std::vector<std::string> warnings;
};

/// Reads a CSV file with the header `t,x,y,z,qx,qy,qz,qw` (s, m, unit quaternion), tissue frame; times
/// increase.
/// @throw FileError names file, line and column
PoseTrack read_poses_csv(const std::string& path);

/// The pose at a time, interpolated; before the first and after the last one that one.
/// @pre track is not empty
Pose pose_at(const PoseTrack& track, double time);

}  // namespace cfem_cutting
