#pragma once

#include <std_msgs/ColorRGBA.h>

#include <algorithm>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// A colour as light from the tissue frame's direction (−0.5, −0.6, 0.7), and a little from everywhere, makes
/// it look. The brightest shades keep their hue.
/// @param normal unit, tissue frame
inline std_msgs::ColorRGBA shade(const std_msgs::ColorRGBA& colour, const Vec3& normal) {
  static const Vec3 towards_light = Vec3(-0.5, -0.6, 0.7).normalized();
  constexpr double kDarkest = 0.35, kRange = 0.8;
  const double half = 0.5 + 0.5 * normal.dot(towards_light);  // falls off softly: no side is black
  const auto light = static_cast<float>(kDarkest + kRange * half * half);
  const float brightest = std::max({colour.r, colour.g, colour.b, 1e-3f});
  const float brightness = std::min(light, 1.0f / brightest);
  std_msgs::ColorRGBA shaded = colour;
  for (float* part : {&shaded.r, &shaded.g, &shaded.b}) *part *= brightness;
  return shaded;
}

/// The normal that a triangle's corner is shaded by: the surface's there, but at sharp edges the triangle's
/// own.
inline Vec3 shading_normal(const Vec3& of_surface, const Vec3& of_triangle) {
  constexpr double kSharp = 0.82;  // cosine: a right angle's edge has 0.71
  return of_surface.dot(of_triangle) < kSharp ? of_triangle : of_surface;
}

}  // namespace cfem_cutting
