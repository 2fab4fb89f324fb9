#pragma once

#include <cstdint>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// Place on Morton's curve (Morton 1966) through the blocks of a lattice: blocks that are near each other are
/// mostly near each other on it.
/// @param block entries ≥ 0 and < 2²⁰
inline std::uint64_t morton_place(const Vec3i& block) {
  std::uint64_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    auto bits = static_cast<std::uint64_t>(block[axis]);  // spread to every third one
    bits = (bits | bits << 32) & 0x1F00000000FFFFu;
    bits = (bits | bits << 16) & 0x1F0000FF0000FFu;
    bits = (bits | bits << 8) & 0x100F00F00F00F00Fu;
    bits = (bits | bits << 4) & 0x10C30C30C30C30C3u;
    bits = (bits | bits << 2) & 0x1249249249249249u;
    place |= bits << axis;
  }
  return place;
}

}  // namespace cfem_cutting
