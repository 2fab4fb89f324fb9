#pragma once

#include "cfem_cutting/volume/voxel_volume.h"

namespace cfem_cutting {

/// The linked voxel next to X's own one, which has no links, if X is on the tissue's side of all surface
/// links that lead into its own; else −1. Half of the skin lies in such voxels.
int skin_voxel_at(const VoxelVolume& volume, const Vec3& X);

/// The linked voxel that holds X if X is in tissue: on the voxel's side of its surface links' tangent planes;
/// or the one next to it (skin_voxel_at); else −1.
int tissue_voxel_at(const VoxelVolume& volume, const Vec3& X);

/// Where a segment from outside to a point inside tissue enters it (bisection), and the voxel just inside.
struct Entry {
  Vec3 X;  ///< m, inside, within 1e-6 of the segment's length of the surface
  int voxel;
};
/// @pre tissue_voxel_at(inside) ≥ 0 > tissue_voxel_at(outside)
Entry find_entry(const VoxelVolume& volume, const Vec3& outside, const Vec3& inside);

}  // namespace cfem_cutting
