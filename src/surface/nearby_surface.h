#pragma once

#include <array>
#include <vector>

#include "cfem_cutting/surface/tissue_surface.h"

namespace cfem_cutting {

/// The part of a drawn surface around a few points, for many questions about points among them.
class NearbySurface {
 public:
  /// @param around a box that holds the points, m
  /// @param radius farthest distance that is asked for, m
  NearbySurface(const DeformedSurface& drawn, const Box& around, double radius);

  /// Distance of a point to the surface, or the radius if that is less, m.
  double distance(const Vec3& p) const;

  /// How often the closed surface winds around a point: crossings of the ray from it along +z.
  int winding_number(const Vec3& p) const;

 private:
  using Triangle = std::array<Vec3, 3>;

  double radius_;
  std::vector<Triangle> near_;   // within the radius of the box
  std::vector<Triangle> above_;  // over or under the box
};

}  // namespace cfem_cutting
