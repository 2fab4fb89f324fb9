#include "cfem_cutting/volume/inside.h"

namespace cfem_cutting {

int tissue_voxel_at(const VoxelVolume& volume, const Vec3& X) {
  const int v = volume.find(volume.lattice().voxel_at(X));
  if (v < 0 || !volume.voxel(v).linked()) return -1;
  for (int direction = 0; direction < kDirections; ++direction) {
    if (volume.voxel(v).link[direction] != LinkState::kSurface) continue;
    const SurfacePoint& skin = volume.crossing(v, direction);
    if ((X - skin.point).dot(skin.normal) > 0.0) return -1;
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
