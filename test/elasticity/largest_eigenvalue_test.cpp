// Largest eigenvalues kept from cut to cut, against those that many more steps find.

#include "largest_eigenvalue.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cfem_cutting/volume/shapes.h"
#include "cfem_cutting/volume/voxel_volume.h"
#include "specimens.h"

namespace cfem_cutting {
namespace {

/// Leaves a voxel two links along the same axis: the row that it is in hangs on by less and less.
void free_voxel(VoxelVolume& volume, const Vec3i& index) {
  const int v = volume.find(index);
  for (int direction = 0; direction < kDirections; ++direction) {
    const int neighbour = volume.voxel(v).neighbour[direction];
    if (direction / 2 == 2 || neighbour < 0 || volume.voxel(v).link[direction] != LinkState::kIntact)
      continue;
    const Vec3 middle = 0.5 * (volume.centre(v) + volume.centre(neighbour));
    volume.sever({direction % 2 ? v : neighbour, direction / 2}, {middle, Vec3::Unit(direction / 2)});
  }
}

/// Held at the bottom, up to a height.
struct Level {
  explicit Level(const ElasticModel& model, double height = 0.02) {
    const NodeField& rest = model.mesh().rest();
    const double bottom = rest.row(2).minCoeff() + height;
    std::vector<char> held(model.mesh().node_count());
    for (int n = 0; n < model.mesh().node_count(); ++n) held[n] = rest(2, n) < bottom;
    system.arrange(model.elements(), std::move(held));
  }
  ThreadPool pool{1};
  LevelSystem system{pool};
};

class KeptEigenvalue : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(CompositeLevels, KeptEigenvalue, testing::Values(0, 1));

TEST_P(KeptEigenvalue, IsTheLargestSoFar) {
  VoxelVolume volume =
      VoxelVolume::sample(*make_box({0.13, 0.1, 0.16}, Pose::Identity()), Vec3::Constant(0.01));
  ElasticModel model(volume, GetParam(), {{-1, 1e4, 0.475, 1060.0}}, ElementKind::kIncompatibleModes,
                     Kinematics::kCorotational);
  LargestEigenvalue kept;
  double largest = 0.0;
  const Vec3i middle = volume.voxel(static_cast<int>(volume.voxels().size()) / 2).index;
  for (int strip = 0; strip < 5; ++strip) {
    Level level(model);
    const double found = kept.update(level.system);
    largest = std::max(largest, level.system.largest_at_rest(200));
    EXPECT_GT(found, 0.96 * largest) << "strip " << strip;
    EXPECT_LT(found, 1.001 * largest) << "strip " << strip;
    free_voxel(volume, middle + strip * Vec3i::UnitZ());
    model.update(volume);
  }
  EXPECT_EQ(volume.severed_count(), 10);
}

TEST(KeptEigenvalue, ChangesWithWhatIsHeldAlone) {
  const ElasticModel model(tilted_volume({0.12, 0.1, 0.09}, 0.01), 0, {{-1, 1e4, 0.45, 1060.0}},
                           ElementKind::kIncompatibleModes, Kinematics::kCorotational);
  Level low(model), high(model, 0.08);
  LargestEigenvalue kept;
  const double of_low = kept.update(low.system);
  EXPECT_NE(kept.update(high.system), of_low);
  EXPECT_EQ(kept.update(high.system), LargestEigenvalue().update(high.system));
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
