#include <gtest/gtest.h>

#include <functional>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/volume/shapes.h"
#include "cfem_cutting/volume/voxel_volume.h"

namespace cfem_cutting {
namespace {

LabelImage make_image(const Vec3i& size, const Vec3& spacing,
                      const std::function<int(const Vec3&)>& label_at) {
  LabelImage image{size, spacing, {}};
  const Lattice lattice{Vec3::Zero(), spacing, size};
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i)
        image.labels.push_back(static_cast<std::uint8_t>(label_at(lattice.centre({i, j, k}))));
  return image;
}

const Vec3 kMiddle(0.04, 0.041, 0.042);
constexpr double kRadius = 0.03;

/// Label 7 in a ball, 9 in its upper half, at the resolution of a CT.
LabelImage ball() {
  return make_image({100, 100, 70}, {0.0008, 0.0008, 0.0013}, [](const Vec3& p) {
    if ((p - kMiddle).norm() > kRadius) return 0;
    return p.z() > kMiddle.z() ? 9 : 7;
  });
}

Pose tilted() {
  Pose X_TS = Pose::Identity();
  X_TS.translate(Vec3(0.1, -0.2, 0.3));
  X_TS.rotate(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -0.5).normalized()));
  return X_TS;
}

double sampled_volume(const VoxelVolume& volume) {
  double total = 0.0;
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) total += volume.filled_volume(v);
  return total;
}

TEST(LabelShape, VolumeCountsSelectedVoxels) {
  const LabelImage image = make_image({10, 10, 10}, {0.001, 0.002, 0.003}, [](const Vec3& p) {
    return p.x() < 0.002 ? 1 : p.x() < 0.005 ? 2 : 0;
  });
  const auto volume = [&](const std::vector<int>& labels) {
    return make_label_shape(image, labels, Pose::Identity(), "image")->volume();
  };
  EXPECT_NEAR(volume({1}), 200 * 6e-9, 1e-18);
  EXPECT_NEAR(volume({1, 2}), 500 * 6e-9, 1e-18);
}

TEST(LabelShape, LabelsAreThoseOfTheNearestVoxelIfSelected) {
  const auto shape = make_label_shape(ball(), {7}, Pose::Identity(), "image");
  const auto labels = [&](double below, double above) {
    return shape->labels_along_z(kMiddle.x(), kMiddle.y(), {kMiddle.z() - below, kMiddle.z() + above});
  };
  EXPECT_EQ(labels(0.01, 0.01), (std::vector<int>{7, -1}));
  EXPECT_EQ(labels(0.032, 0.2), (std::vector<int>{-1, -1}));
}

TEST(LabelShape, SampledVolumeAgreesInAnyPose) {
  for (const Pose& X_TS : {Pose::Identity(), tilted()}) {
    const auto shape = make_label_shape(ball(), {7, 9}, X_TS, "image");
    const VoxelVolume volume = VoxelVolume::sample(*shape, Vec3::Constant(0.004));
    EXPECT_NEAR(sampled_volume(volume) / shape->volume(), 1.0, 0.005);
    EXPECT_EQ(find_pieces(volume).count(), 1);
  }
}

TEST(LabelShape, VoxelsCarryTheMostFrequentLabel) {
  const auto shape = make_label_shape(ball(), {7, 9}, Pose::Identity(), "image");
  const VoxelVolume volume = VoxelVolume::sample(*shape, Vec3::Constant(0.004));
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    const double above = volume.centre(v).z() - kMiddle.z();
    if (std::abs(above) < 0.003) continue;
    EXPECT_EQ(volume.voxel(v).label, above > 0.0 ? 9 : 7);
  }
}

/// Links whose ends the smooth surface passes on the wrong side are clamped: a few in a hundred may be rough.
TEST(LabelShape, SkinIsSmootherThanTheImage) {
  for (const Pose& X_TS : {Pose::Identity(), tilted()}) {
    const auto shape = make_label_shape(ball(), {7, 9}, X_TS, "image");
    const VoxelVolume volume = VoxelVolume::sample(*shape, Vec3::Constant(0.004));
    int crossings = 0, rough = 0;
    for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
      for (int direction = 0; volume.voxel(v).linked() && direction < kDirections; ++direction) {
        if (volume.voxel(v).link[direction] != LinkState::kSurface) continue;
        const SurfacePoint& crossing = volume.crossing(v, direction);
        const Vec3 from_middle = crossing.point - X_TS * kMiddle;
        const double error = std::abs(from_middle.norm() - kRadius);
        ++crossings;
        rough += error > 0.00025 || crossing.normal.dot(from_middle.normalized()) < 0.99;
        EXPECT_LT(error, 0.0007);
        EXPECT_GT(crossing.normal.dot(from_middle.normalized()), 0.9);
      }
    }
    EXPECT_GT(crossings, 900);
    EXPECT_LT(rough, 0.08 * crossings);
  }
}

TEST(LabelShape, FlatFaceIsMetExactly) {
  const LabelImage image =
      make_image({40, 40, 40}, Vec3::Constant(0.001), [](const Vec3& p) { return p.x() < 0.02 ? 1 : 0; });
  const auto shape = make_label_shape(image, {1}, Pose::Identity(), "image");
  const SurfacePoint exit = shape->exit({0.0185, 0.02, 0.02}, {0.0225, 0.02, 0.02});
  EXPECT_NEAR(exit.point.x(), 0.02, 1e-6);
  EXPECT_TRUE(exit.normal.isApprox(Vec3::UnitX(), 1e-4));
}

TEST(LabelShape, ImageBorderEndsTheTissue) {
  const LabelImage image = make_image({20, 20, 20}, Vec3::Constant(0.001), [](const Vec3&) { return 1; });
  const auto shape = make_label_shape(image, {1}, Pose::Identity(), "image");
  EXPECT_NEAR(shape->exit({0.01, 0.01, 0.018}, {0.01, 0.01, 0.022}).point.z(), 0.02, 1e-6);
  EXPECT_TRUE(shape->bounds().max().isApprox(Vec3::Constant(0.02)));
}

TEST(LabelShape, SheetTooThinForTheSmoothFieldEndsAtItsLabels) {
  const LabelImage image = make_image({20, 20, 20}, Vec3::Constant(0.001),
                                      [](const Vec3& p) { return p.z() > 0.01 && p.z() < 0.011 ? 1 : 0; });
  const auto shape = make_label_shape(image, {1}, Pose::Identity(), "image");
  const SurfacePoint exit = shape->exit({0.01, 0.01, 0.0105}, {0.01, 0.01, 0.0145});
  EXPECT_NEAR(exit.point.z(), 0.011, 1e-9);
  EXPECT_GT(exit.normal.z(), 0.99);
}

TEST(LabelShape, RefusesLabelsThatDoNotOccur) {
  try {
    make_label_shape(ball(), {8}, Pose::Identity(), "ct.nrrd");
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_STREQ(error.what(), "label image 'ct.nrrd': none of the selected labels occurs; it holds 0, 7, 9");
  }
  EXPECT_THROW(make_label_shape(ball(), {300}, Pose::Identity(), "ct.nrrd"), GeometryError);
}

}  // namespace
}  // namespace cfem_cutting
