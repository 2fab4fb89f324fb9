#pragma once

#include <map>

#include "cutter.h"

namespace cfem_cutting::random_cuts {

/// How often a sheet's triangles meet each link of a volume, whatever its state, by exact arithmetic on the
/// documented rule: as if all voxel centres were shifted by (ε, ε², ε³), ε infinitesimal.
std::map<LinkId, int> count_meetings(const VoxelVolume& volume, const Sheet& sheet);

/// Squares of four links, around which a closed way must meet a sheet an even number of times, but doesn't.
/// @pre the sheet's boundary lies outside the tissue
int count_leaks(const VoxelVolume& volume, const std::map<LinkId, int>& meetings);

/// The connected component of each voxel under the links that aren't severed, (|voxels|); hosted voxels
/// follow their hosts.
std::vector<int> flood_pieces(const VoxelVolume& volume, const std::map<LinkId, int>& severed);

}  // namespace cfem_cutting::random_cuts
