// Largest eigenvalues kept from cut to cut, against those found anew.

#include "largest_eigenvalue.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cfem_cutting/volume/voxel_volume.h"
#include "specimens.h"

namespace cfem_cutting {
namespace {

/// Severs the links along x through the middle of the lattice, in two of its layers.
void sever_strip(VoxelVolume& volume, int strip) {
  const Vec3i middle = volume.lattice().size / 2;
  for (std::size_t v = 0; v < volume.voxels().size(); ++v) {
    const Voxel& voxel = volume.voxels()[v];
    if (voxel.index.x() != middle.x() || voxel.index.z() / 2 != strip) continue;
    if (!voxel.linked() || voxel.link[1] != LinkState::kIntact) continue;
    const Vec3 step(0.4 * volume.lattice().spacing.x(), 0.0, 0.0);
    volume.sever({static_cast<int>(v), 0}, {volume.centre(static_cast<int>(v)) + step, Vec3::UnitX()});
  }
}

struct Level {
  explicit Level(const ElasticModel& model) {
    system.arrange(model.elements(), std::vector<char>(model.mesh().node_count(), 0));
  }
  ThreadPool pool{1};
  LevelSystem system{pool};
};

class KeptEigenvalue : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(CompositeLevels, KeptEigenvalue, testing::Values(0, 1));

TEST_P(KeptEigenvalue, IsTheLargestOfAllThatWouldBeFoundAnew) {
  VoxelVolume volume = tilted_volume({0.12, 0.1, 0.16}, 0.01);
  ElasticModel model(volume, GetParam(), {{-1, 1e4, 0.45, 1060.0}}, ElementKind::kIncompatibleModes,
                     Kinematics::kCorotational);
  LargestEigenvalue kept;
  double largest = 0.0;
  for (int strip = 0; 2 * strip < volume.lattice().size.z(); ++strip) {
    Level level(model);
    const double found = kept.update(level.system);
    largest = std::max(largest, LargestEigenvalue().update(level.system));
    EXPECT_GT(found, 0.95 * largest) << "strip " << strip;
    EXPECT_LT(found, 1.05 * largest) << "strip " << strip;
    sever_strip(volume, strip);
    model.update(volume);
  }
  EXPECT_GT(volume.severed_count(), 50);
}

TEST(KeptEigenvalue, ChangesWithTheMaterialsAlone) {
  LargestEigenvalue kept;
  const VoxelVolume volume = tilted_volume({0.12, 0.1, 0.09}, 0.01);
  for (const double nu : {0.45, 0.1}) {
    const ElasticModel model(volume, 0, {{-1, 1e4, nu, 1060.0}}, ElementKind::kIncompatibleModes,
                             Kinematics::kCorotational);
    Level level(model);
    EXPECT_EQ(kept.update(level.system), LargestEigenvalue().update(level.system)) << "nu " << nu;
  }
}

}  // namespace
}  // namespace cfem_cutting
