#pragma once

#include "cfem_cutting/volume/voxel_volume.h"

namespace cfem_cutting {

enum class LinkKind {
  kIntact,
  kAny  ///< severed ones, too
};

/// Whether one of the shortest ways over the lattice between two linked voxels, of three steps at most, goes
/// over links of a kind.
bool are_joined(const VoxelVolume& volume, int v, int w, LinkKind kind);

/// Whether two voxels are three steps apart at most and no such way goes over intact links: tissue on two
/// sides of a cut, or that only touches.
bool are_parted(const VoxelVolume& volume, int v, int w);

}  // namespace cfem_cutting
