#include "voxel_joints.h"

#include "cfem_cutting/volume/link_way.h"

namespace cfem_cutting {
namespace {

void join_hosted(const VoxelVolume& volume, int v, std::vector<std::pair<int, int>>& joints) {
  const Voxel& voxel = volume.voxel(v);
  joints.emplace_back(v, voxel.host);
  for (int direction = 0; direction < kDirections; ++direction) {
    const int other = volume.find(voxel.index + step(direction));
    if (other < 0 || other == voxel.host) continue;
    const bool counted_there = !volume.voxel(other).linked() && other < v;
    const int other_host = volume.voxel(other).linked() ? other : volume.voxel(other).host;
    if (!counted_there && are_joined(volume, voxel.host, other_host, LinkKind::kIntact))
      joints.emplace_back(v, other);
  }
}

}  // namespace

std::vector<std::pair<int, int>> voxel_joints(const VoxelVolume& volume) {
  std::vector<std::pair<int, int>> joints;
  joints.reserve(3 * volume.voxels().size());
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    const Voxel& voxel = volume.voxel(v);
    if (!voxel.linked()) {
      join_hosted(volume, v, joints);
      continue;
    }
    for (int upward = 1; upward < kDirections; upward += 2)
      if (voxel.link[upward] == LinkState::kIntact) joints.emplace_back(v, voxel.neighbour[upward]);
  }
  return joints;
}

}  // namespace cfem_cutting
