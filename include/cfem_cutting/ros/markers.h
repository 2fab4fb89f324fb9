#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "cfem_cutting/ros/scene.h"

namespace cfem_cutting {

/// Fixed ids of the markers. The skin (and likewise the cut faces) of a label with a colour of its own is a
/// marker of the namespace "skin" ("cut_faces") with the id kFirstLabel + label.
enum class MarkerId { kSkin = 0, kCutFaces = 1, kBlade = 2, kForce = 3, kFirstLabel = 10 };

/// A scene as markers of one colour each (rviz lights only those): skin, cut faces, blade, contact force.
/// What there is nothing of is deleted.
/// @param frame the tissue frame
/// @param look colours of labels, and those that are hidden
visualization_msgs::MarkerArray to_markers(const Scene& scene, const std::string& frame,
                                           const SurfaceConfig& look);

}  // namespace cfem_cutting
