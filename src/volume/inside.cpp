#include "cfem_cutting/volume/inside.h"

#include <algorithm>
#include <limits>

namespace cfem_cutting {
namespace {

bool beyond(const SurfacePoint& skin, const Vec3& X) { return (X - skin.point).dot(skin.normal) > 0.0; }

}  // namespace

int skin_voxel_at(const VoxelVolume& volume, const Vec3& X) {
  const Vec3i index = volume.lattice().voxel_at(X);
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int direction = 0; direction < kDirections; ++direction) {
    const int v = volume.find(index + step(direction));
    const int back = opposite(direction);
    if (v < 0 || !volume.voxel(v).linked() || volume.voxel(v).link[back] != LinkState::kSurface) continue;
    if (beyond(volume.crossing(v, back), X)) return -1;
    const double distance = (X - volume.centre(v)).norm();
    if (distance < least) nearest = v;
    least = std::min(least, distance);
  }
  return nearest;
}

int tissue_voxel_at(const VoxelVolume& volume, const Vec3& X) {
  const int v = volume.find(volume.lattice().voxel_at(X));
  if (v < 0 || !volume.voxel(v).linked()) return skin_voxel_at(volume, X);
  for (int direction = 0; direction < kDirections; ++direction) {
    if (volume.voxel(v).link[direction] != LinkState::kSurface) continue;
    if (beyond(volume.crossing(v, direction), X)) return -1;
  }
  return v;
}

Entry find_entry(const VoxelVolume& volume, const Vec3& outside, const Vec3& inside) {
  constexpr int kBisections = 20;
  double out = 0.0;
  double in = 1.0;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (out + in);
    (tissue_voxel_at(volume, outside + middle * (inside - outside)) < 0 ? out : in) = middle;
  }
  const Vec3 X = outside + in * (inside - outside);
  return {X, tissue_voxel_at(volume, X)};
}

}  // namespace cfem_cutting
