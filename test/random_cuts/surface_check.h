#pragma once

#include <string>

#include "cfem_cutting/surface/tissue_surface.h"

namespace cfem_cutting::random_cuts {

/// Counted over triangles.
struct SurfaceFigures {
  std::int64_t triangles = 0;
  std::int64_t without_area = 0;  ///< twice the area under 1e-9 of the longest edge squared
  std::int64_t flipped = 0;       ///< turned the wrong way about their link
  std::int64_t needles = 0;       ///< smallest angle under 5°
  std::int64_t crossing = 0;      ///< that meet others, see count_self_crossings
  void add(const SurfaceFigures& other);
};

/// What keeps a surface from being closed, evenly oriented and manifold, by counting edges and the triangles
/// around each vertex; empty if nothing does.
std::string find_flaw(const std::vector<std::array<int, 3>>& triangles);

/// By the divergence theorem, m³.
double signed_volume(const TissueSurface& surface);

SurfaceFigures measure(const TissueSurface& surface);

}  // namespace cfem_cutting::random_cuts
