#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cfem_cutting/elasticity/inverse_map.h"

namespace cfem_cutting {

/// A piece of the swept surface in material space.
struct SweptTriangle {
  std::array<Vec3, 3> corners;                                                    ///< m
  Vec3 centroid() const { return (corners[0] + corners[1] + corners[2]) / 3.0; }  ///< m
  Vec3 normal() const {
    return (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  }  ///< length: twice the area
};

/// Front points in material space; nothing where the edge is far from tissue.
using MaterialFront = std::vector<std::optional<MaterialPoint>>;

/// The surface between two positions of the front, two triangles for each pair of neighbouring points: where
/// one of the four corners is near links, and one strip more on either side, so that no link slips by. Strips
/// with a corner far from tissue and triangles with two equal corners are left out. The fronts must have
/// equal length.
std::vector<SweptTriangle> sweep(const MaterialFront& before, const MaterialFront& after);

}  // namespace cfem_cutting
