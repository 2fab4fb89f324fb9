#pragma once

#include <string>
#include <vector>

#include "cfem_cutting/geometry/polyline.h"

namespace cfem_cutting {

/// A scalpel's cutting edge, in the tool frame B.
struct Blade {
  Polyline edge;        ///< m, heel to tip, at least two points
  Vec3 back;            ///< unit, edge to spine
  double friction = 0;  ///< Coulomb, along the edge
};

/// Checks and normalises.
/// @throw ConfigError fewer than two points, equal neighbours, or a `back` that is zero or along the edge;
/// names blade.edge or blade.back.
Blade make_blade(const Polyline& edge, const Vec3& back, double friction);

/// Origins of links (heel to tip) in the frame of tool_link, along fixed joints of a URDF document.
/// @throw ConfigError not a URDF, a link is missing, or a joint on the way isn't fixed.
Polyline edge_from_urdf(const std::string& urdf_xml, const std::string& tool_link,
                        const std::vector<std::string>& edge_links);

/// The front: the edge placed in the tissue frame.
struct Front {
  Polyline points;            ///< m, in T
  Vec3 back = Vec3::UnitZ();  ///< unit, in T
};
/// @param max_segment m, longest segment of the front
Front place(const Blade& blade, const Pose& X_TB, double max_segment);

/// Pose between two poses (linear, slerp), s in [0, 1].
Pose interpolate(const Pose& a, const Pose& b, double s);

/// Longest way of a point of the edge between two poses, m.
double travel(const Blade& blade, const Pose& a, const Pose& b);

}  // namespace cfem_cutting
