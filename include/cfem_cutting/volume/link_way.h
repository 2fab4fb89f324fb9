#pragma once

#include "cfem_cutting/volume/voxel_volume.h"

namespace cfem_cutting {

/// Whether one of the shortest ways over the lattice between two linked voxels, of three steps at most, goes
/// over intact links; or over severed ones, too.
bool are_joined(const VoxelVolume& volume, int v, int w, bool over_cuts = false);

}  // namespace cfem_cutting
