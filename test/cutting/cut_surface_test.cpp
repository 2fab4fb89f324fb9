#include "cfem_cutting/cutting/cut_surface.h"

#include <gtest/gtest.h>

#include "cfem_cutting/volume/shapes.h"

namespace cfem_cutting {
namespace {

/// A rectangle of the plane z = height, in squares of 0.05 m.
std::vector<SweptTriangle> level(double height, double from, double to, double width) {
  std::vector<SweptTriangle> triangles;
  const double d = 0.05;
  for (double x = from; x < to - 1e-9; x += d)
    for (double y = 0.0; y < width - 1e-9; y += d) {
      const Vec3 a(x, y, height), b(x + d, y, height), c(x + d, y + d, height), e(x, y + d, height);
      triangles.push_back({{a, b, c}});
      triangles.push_back({{a, c, e}});
    }
  return triangles;
}

class CutSurfaceOfABox : public testing::Test {
 protected:
  VoxelVolume volume = VoxelVolume::sample(*make_box(Vec3::Ones(), Pose::Identity()), Vec3::Constant(0.1));
  CutSurface surface{0.1};
};

TEST_F(CutSurfaceOfABox, AreaInTissueCounts) {
  EXPECT_NEAR(surface.add(volume, level(0.52, -0.5, 1.5, 1.5)), 1.0, 1e-9);
}

TEST_F(CutSurfaceOfABox, SecondPassOpensNothing) {
  surface.add(volume, level(0.52, 0.0, 0.5, 1.0));
  EXPECT_EQ(surface.add(volume, level(0.53, 0.0, 0.5, 1.0)), 0.0);
  EXPECT_EQ(surface.triangles().size(), 400u);
}

TEST_F(CutSurfaceOfABox, NewAreaBesideOldCounts) {
  surface.add(volume, level(0.52, 0.0, 0.5, 1.0));
  EXPECT_NEAR(surface.add(volume, level(0.52, 0.2, 0.9, 1.0)), 0.4, 1e-9);
  EXPECT_NEAR(surface.add(volume, level(0.58, 0.0, 0.5, 1.0)), 0.5, 1e-9);
}

TEST_F(CutSurfaceOfABox, DistanceWithinTheRadiusElseInfinity) {
  surface.add(volume, level(0.5, 0.0, 0.5, 0.5));
  EXPECT_NEAR(surface.distance({0.21, 0.33, 0.57}, 0.1), 0.07, 1e-12);
  EXPECT_NEAR(surface.distance({-0.03, 0.3, 0.46}, 0.1), 0.05, 1e-12);
  EXPECT_EQ(surface.distance({0.21, 0.33, 0.57}, 0.06), std::numeric_limits<double>::infinity());
  EXPECT_EQ(CutSurface(0.1).distance(Vec3::Zero(), 0.1), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace cfem_cutting
