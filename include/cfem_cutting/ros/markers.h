#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "cfem_cutting/ros/scene.h"

namespace cfem_cutting {

/// Fixed ids of the markers.
enum class MarkerId { kSkin = 0, kCutFaces = 1, kBlade = 2, kForce = 3 };

/// A scene as markers of one colour each (rviz lights only those): skin, cut faces, blade, contact force.
/// What there is nothing of is deleted.
/// @param frame the tissue frame
visualization_msgs::MarkerArray to_markers(const Scene& scene, const std::string& frame);

}  // namespace cfem_cutting
