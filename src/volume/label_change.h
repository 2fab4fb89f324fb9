#pragma once

#include "cfem_cutting/volume/shape.h"

namespace cfem_cutting {

/// A point between the two, on the border of what is_inside holds for.
template <typename IsInside>
Vec3 bisect(Vec3 inside, Vec3 outside, IsInside is_inside) {
  constexpr int kHalvings = 40;
  for (int halving = 0; halving < kHalvings; ++halving) {
    const Vec3 middle = 0.5 * (inside + outside);
    (is_inside(middle) ? inside : outside) = middle;
  }
  return 0.5 * (inside + outside);
}

/// Where tissue ends between the two points, by labels alone.
inline Vec3 find_label_change(const Shape& shape, const Vec3& inside, const Vec3& outside) {
  return bisect(inside, outside,
                [&](const Vec3& p) { return shape.labels_along_z(p.x(), p.y(), {p.z()}).front() >= 0; });
}

}  // namespace cfem_cutting
