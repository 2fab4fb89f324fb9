#pragma once
/// Volumes, cuts and checks that the tests of the surface share.

#include <gtest/gtest.h>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/surface/tissue_surface.h"
#include "cfem_cutting/volume/shapes.h"

namespace cfem_cutting::test {

/// n³ voxels of edge 1 m fill the box exactly.
inline VoxelVolume box_volume(const Vec3& size) {
  return VoxelVolume::sample(*make_box(size, Pose::Identity()), Vec3::Ones());
}

struct Plane {
  Vec3 point;
  Vec3 normal;  ///< unit
  double height(const Vec3& X) const { return (X - point).dot(normal); }
};

/// Severs all intact links that a plane crosses at points for which `wanted` holds.
template <typename Wanted>
void sever(VoxelVolume& volume, const Plane& plane, Wanted&& wanted) {
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    if (!volume.voxel(v).linked()) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const int next = volume.voxel(v).neighbour[2 * axis + 1];
      if (next < 0) continue;
      const Vec3 from = volume.centre(v), to = volume.centre(next);
      const double a = plane.height(from), b = plane.height(to);
      if ((a < 0.0) == (b < 0.0)) continue;
      const Vec3 X = from + a / (a - b) * (to - from);
      if (wanted(X)) volume.sever({v, axis}, {X, plane.normal});
    }
  }
}

inline void sever(VoxelVolume& volume, const Plane& plane) {
  sever(volume, plane, [](const Vec3&) { return true; });
}

inline void expect_closed_and_manifold(const TriangleMesh& mesh, const std::string& what) {
  const MeshDefects defects = find_defects(mesh);
  EXPECT_EQ(defects.open_edges, 0) << what;
  EXPECT_EQ(defects.nonmanifold_edges, 0) << what;
  EXPECT_EQ(defects.nonmanifold_vertices, 0) << what;
}

}  // namespace cfem_cutting::test
