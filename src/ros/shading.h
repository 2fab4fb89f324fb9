#pragma once

#include <std_msgs/ColorRGBA.h>

#include <algorithm>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// A colour as light from above and ahead, and a little from everywhere, makes it look.
/// @param normal unit, tissue frame
inline std_msgs::ColorRGBA shade(const std_msgs::ColorRGBA& colour, const Vec3& normal) {
  static const Vec3 towards_light = Vec3(-0.5, -0.6, 0.7).normalized();
  constexpr double kDarkest = 0.35, kRange = 0.8;
  const double half = 0.5 + 0.5 * normal.dot(towards_light);  // falls off softly: no side is black
  const auto brightness = static_cast<float>(kDarkest + kRange * half * half);
  std_msgs::ColorRGBA shaded = colour;
  for (float* part : {&shaded.r, &shaded.g, &shaded.b}) *part = std::min(1.0f, brightness * *part);
  return shaded;
}

}  // namespace cfem_cutting
