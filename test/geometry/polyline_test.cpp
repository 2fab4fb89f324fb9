#include "cfem_cutting/geometry/polyline.h"

#include <gtest/gtest.h>

#include <random>

namespace cfem_cutting {
namespace {

const Polyline kCorner{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}};

TEST(Project, FindsTheNearestSegment) {
  const PolylineProjection projection = project(kCorner, {1.5, 1.5, 0.0});
  EXPECT_TRUE(projection.point.isApprox(Vec3(1.0, 1.5, 0.0)));
  EXPECT_TRUE(projection.tangent.isApprox(Vec3::UnitY()));
  EXPECT_EQ(projection.segment, 1);
  EXPECT_DOUBLE_EQ(projection.t, 0.75);
  EXPECT_DOUBLE_EQ(projection.distance, 0.5);
}

TEST(Project, LeavesTheUnitIntervalOnlyBeyondTheEnds) {
  EXPECT_DOUBLE_EQ(project(kCorner, {-0.5, 0.1, 0.0}).t, -0.5);
  EXPECT_DOUBLE_EQ(project(kCorner, {1.0, 3.0, 0.0}).t, 1.5);
  const PolylineProjection at_bend = project(kCorner, {1.3, -0.4, 0.0});
  EXPECT_TRUE(at_bend.point.isApprox(Vec3(1, 0, 0)));
  EXPECT_DOUBLE_EQ(at_bend.t, 1.0);
  EXPECT_EQ(at_bend.segment, 0);
  EXPECT_TRUE(project(kCorner, {-0.5, 0.1, 0.0}).point.isZero());
}

TEST(Refine, KeepsGivenPointsAndTheLimit) {
  const Polyline refined = refine(kCorner, 0.3);
  ASSERT_EQ(refined.size(), 1u + 4u + 7u);
  EXPECT_EQ(refined[0], kCorner[0]);
  EXPECT_EQ(refined[4], kCorner[1]);
  EXPECT_EQ(refined[11], kCorner[2]);
  for (std::size_t i = 1; i < refined.size(); ++i) EXPECT_LE((refined[i] - refined[i - 1]).norm(), 0.3);
}

TEST(ArcLength, CountsFromTheFirstPoint) {
  const Polyline bent{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}};
  EXPECT_EQ(arc_lengths(bent), (std::vector<double>{0.0, 3.0, 7.0}));
  EXPECT_DOUBLE_EQ(arc_length(bent, project(bent, {1, -2, 0})), 1.0);
  EXPECT_DOUBLE_EQ(arc_length(bent, project(bent, {5, 1, 1})), 4.0);
  EXPECT_DOUBLE_EQ(arc_length(bent, project(bent, {9, 9, 0})), 7.0);
}

TEST(PointAlong, GoesRoundCornersAndStopsAtTheEnds) {
  const Polyline bent{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}};
  EXPECT_LT((point_along(bent, 2.0) - Vec3(2, 0, 0)).norm(), 1e-15);
  EXPECT_LT((point_along(bent, 4.5) - Vec3(3, 1.5, 0)).norm(), 1e-15);
  EXPECT_LT((point_along(bent, 8.0) - Vec3(3, 4, 0)).norm(), 1e-15);
  EXPECT_LT((point_along({{1, 2, 3}}, 0.5) - Vec3(1, 2, 3)).norm(), 1e-15);
}

TEST(Refine, LeavesSegmentsOfTheExactLength) {
  EXPECT_EQ(refine(kCorner, 1.0).size(), 4u);
  EXPECT_EQ(refine({{0, 0, 0}, {0.3, 0, 0}}, 0.1).size(), 4u);
}

TEST(PointTriangleDistance, KnownRegions) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_DOUBLE_EQ(point_triangle_distance({0.2, 0.2, 0.7}, a, b, c), 0.7);
  EXPECT_DOUBLE_EQ(point_triangle_distance({-3, -4, 0}, a, b, c), 5.0);
  EXPECT_DOUBLE_EQ(point_triangle_distance({0.5, -2, 0}, a, b, c), 2.0);
  EXPECT_DOUBLE_EQ(point_triangle_distance({1, 1, 0}, a, b, c), std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(point_triangle_distance({0, 3, 4}, a, a, a), 5.0);
  EXPECT_LT((nearest_on_triangle({0.2, 0.2, 0.7}, a, b, c) - Vec3(0.2, 0.2, 0)).norm(), 1e-15);
  EXPECT_LT((nearest_on_triangle({1, 1, 3}, a, b, c) - Vec3(0.5, 0.5, 0)).norm(), 1e-15);
}

TEST(PointTriangleDistance, AgreesWithSampling) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  const auto point = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 p = point(), a = point(), b = point(), c = point();
    double sampled = 1e9;
    const int n = 100;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        sampled = std::min(sampled, (p - a - (b - a) * i / n - (c - a) * j / n).norm());
    const double exact = point_triangle_distance(p, a, b, c);
    EXPECT_LE(exact, sampled + 1e-12) << "trial " << trial;
    EXPECT_GE(exact, sampled - 0.03) << "trial " << trial;
  }
}

}  // namespace
}  // namespace cfem_cutting
