#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "cfem_cutting/ros/scene.h"

namespace cfem_cutting {

/// Fixed ids of the markers. The skin (and likewise the cut faces) of a label with a colour of its own is a
/// marker of the namespace "skin" ("cut_faces") with the id kFirstLabel + label.
enum class MarkerId { kSkin = 0, kCutFaces = 1, kBlade = 2, kForce = 3, kFirstLabel = 10 };

/// A scene as markers: skin, cut faces, blade, contact force. What there is nothing of is deleted. Each has
/// one colour, which rviz lights; with smooth shading, skin and cut faces have colours that are lit already.
/// @param frame the tissue frame
/// @param look colours of labels, those that are hidden, and the shading
visualization_msgs::MarkerArray to_markers(const Scene& scene, const std::string& frame,
                                           const SurfaceConfig& look);

}  // namespace cfem_cutting
