#pragma once

#include <algorithm>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// Tissue between a contact point and the front, which has pushed it in: not cut.
struct Dent {
  double along;   ///< m, the contact point's place on the edge
  Vec3 X;         ///< m, material, of the contact point
  Vec3 way;       ///< m, from there to the front
  double radius;  ///< m

  bool holds(const Vec3& query) const {
    const double part = (query - X).dot(way) / way.squaredNorm();
    return part > 0.0 && (query - X - std::min(part, 1.0) * way).norm() < radius;
  }
};

}  // namespace cfem_cutting
