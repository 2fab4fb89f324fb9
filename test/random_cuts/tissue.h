#pragma once

#include <string>

#include "cfem_cutting/volume/voxel_volume.h"
#include "dice.h"

namespace cfem_cutting::random_cuts {

/// Tissue to be cut, 8 to 14 voxels across.
struct Tissue {
  std::string name;
  VoxelVolume volume;
  Vec3 centre;    ///< m
  double radius;  ///< m, of a sphere about `centre` that holds all voxels
};

/// A box (aligned or turned), a ball or the bunny.
/// @param dyadic spacings are powers of two, so that points between the voxels are exact
/// @param bunny_path mesh file
Tissue random_tissue(Dice& dice, bool dyadic, const std::string& bunny_path);

}  // namespace cfem_cutting::random_cuts
