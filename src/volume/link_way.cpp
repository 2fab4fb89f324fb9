#include "cfem_cutting/volume/link_way.h"

namespace cfem_cutting {

bool are_joined(const VoxelVolume& volume, int v, int w, LinkKind kind) {
  if (v == w) return true;
  constexpr int kMostSteps = 3;
  const Vec3i way = volume.voxel(w).index - volume.voxel(v).index;
  if (way.cwiseAbs().sum() > kMostSteps) return false;
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0) continue;
    const int direction = 2 * axis + (way[axis] > 0 ? 1 : 0);
    const LinkState link = volume.voxel(v).link[direction];
    const bool passes = link == LinkState::kIntact || (kind == LinkKind::kAny && link == LinkState::kSevered);
    if (passes && are_joined(volume, volume.voxel(v).neighbour[direction], w, kind)) return true;
  }
  return false;
}

}  // namespace cfem_cutting
