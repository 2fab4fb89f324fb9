#pragma once

#include <utility>
#include <vector>

#include "cfem_cutting/volume/voxel_volume.h"

namespace cfem_cutting {

/// Pairs of voxels between which tissue is continuous: intact links; hosted voxels and their hosts; and
/// hosted voxels with the face neighbours that they touch, where intact links lead round by a shortest way.
/// (Without the last, the half-filled voxels of a slanted surface do not hold together: a beam 8 voxels
/// across, turned by 45°, bends 9 % too far.)
std::vector<std::pair<int, int>> voxel_joints(const VoxelVolume& volume);

}  // namespace cfem_cutting
