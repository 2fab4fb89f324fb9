#pragma once

#include <vector>

#include "cfem_cutting/cutting/sweep.h"

namespace cfem_cutting {

/// A link that a sweep meets.
struct Crossing {
  LinkId link;
  SurfacePoint at;  ///< on the link; normal of the swept surface
};

/// Intact links that swept triangles meet, each once, sorted by link. Watertight: decided with exact
/// predicates as if the lattice were shifted by the infinitesimal (ε, ε², ε³), so a link through the common
/// edge of two triangles, or in the plane of a lattice-aligned cut, is met exactly once (simulation of
/// simplicity, Edelsbrunner and Mücke 1990).
std::vector<Crossing> find_crossings(const VoxelVolume& volume, const std::vector<SweptTriangle>& sweep);

}  // namespace cfem_cutting
