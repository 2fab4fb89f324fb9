#include "cfem_cutting/volume/link_way.h"

namespace cfem_cutting {
namespace {

constexpr int kMostSteps = 3;

int steps_between(const VoxelVolume& volume, int v, int w) {
  return (volume.voxel(w).index - volume.voxel(v).index).cwiseAbs().sum();
}

}  // namespace

bool are_joined(const VoxelVolume& volume, int v, int w, LinkKind kind) {
  if (v == w) return true;
  if (steps_between(volume, v, w) > kMostSteps) return false;
  const Vec3i way = volume.voxel(w).index - volume.voxel(v).index;
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0) continue;
    const int direction = 2 * axis + (way[axis] > 0 ? 1 : 0);
    const LinkState link = volume.voxel(v).link[direction];
    const bool passes = link == LinkState::kIntact || (kind == LinkKind::kAny && link == LinkState::kSevered);
    if (passes && are_joined(volume, volume.voxel(v).neighbour[direction], w, kind)) return true;
  }
  return false;
}

bool are_parted(const VoxelVolume& volume, int v, int w) {
  return steps_between(volume, v, w) <= kMostSteps && !are_joined(volume, v, w, LinkKind::kIntact);
}

}  // namespace cfem_cutting
