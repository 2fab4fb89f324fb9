#include "cfem_cutting/blade/blade.h"

#include <gtest/gtest.h>

#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {
namespace {

std::string refusal(const Polyline& edge, const Vec3& back) {
  try {
    make_blade(edge, back, 0.0);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

Pose turned(double angle) {
  Pose pose = Pose::Identity();
  pose.translate(Vec3(0.01, 0.02, -0.03));
  pose.rotate(Eigen::AngleAxisd(angle, Vec3(1.0, -2.0, 0.5).normalized()));
  return pose;
}

TEST(Blade, RefusalsNameKeyAndRule) {
  EXPECT_EQ(refusal({Vec3::Zero()}, Vec3::UnitZ()), "blade.edge: 1 point(s): an edge needs at least two");
  EXPECT_EQ(refusal({Vec3::Zero(), Vec3::UnitX(), Vec3::UnitX()}, Vec3::UnitZ()),
            "blade.edge: points 2 and 3 coincide: neighbours must differ");
  EXPECT_EQ(refusal({Vec3::Zero(), Vec3::UnitX()}, Vec3::Zero()), "blade.back: [0, 0, 0]: must not be zero");
  EXPECT_EQ(refusal({Vec3::Zero(), Vec3::UnitX(), {1.0, 0.0, 1.0}}, Vec3::UnitZ()),
            "blade.back: is along the edge from point 2 to 3: must point from the edge to the spine");
}

TEST(Blade, BackIsNormalised) {
  EXPECT_EQ(make_blade({Vec3::Zero(), Vec3::UnitX()}, {0.0, 0.0, 5.0}, 0.1).back, Vec3::UnitZ());
}

TEST(Blade, PlaceRefinesAndMovesTheEdge) {
  const Blade blade = make_blade({{0.0, 0.0, 0.0}, {0.03, 0.0, 0.0}, {0.03, 0.01, 0.0}}, Vec3::UnitZ(), 0.0);
  const Pose X_TB = turned(0.8);
  const Front front = place(blade, X_TB, 0.004);
  ASSERT_EQ(front.points.size(), 8u + 3u + 1u);
  EXPECT_TRUE(front.points.front().isApprox(X_TB * blade.edge.front()));
  EXPECT_TRUE(front.points[8].isApprox(X_TB * blade.edge[1]));
  EXPECT_TRUE(front.points.back().isApprox(X_TB * blade.edge.back()));
  EXPECT_TRUE(front.back.isApprox(X_TB.linear() * Vec3::UnitZ()));
  for (std::size_t i = 1; i < front.points.size(); ++i)
    EXPECT_LE((front.points[i] - front.points[i - 1]).norm(), 0.004 + 1e-12);
}

TEST(Blade, EqualPosesPlaceEqualPoints) {
  const Blade blade = make_blade({Vec3::Zero(), Vec3(0.03, 0.0, 0.0)}, Vec3::UnitZ(), 0.0);
  EXPECT_EQ(place(blade, turned(0.3), 0.001).points, place(blade, turned(0.3), 0.001).points);
}

TEST(Blade, InterpolationIsLinearAndTurnsEvenly) {
  const Pose a = turned(0.2), b = turned(1.0);
  EXPECT_TRUE(interpolate(a, b, 0.0).isApprox(a));
  EXPECT_TRUE(interpolate(a, b, 1.0).isApprox(b));
  EXPECT_TRUE(interpolate(a, b, 0.25).isApprox(turned(0.4)));
}

TEST(Blade, TravelIsThatOfTheFastestPoint) {
  const Blade blade = make_blade({Vec3::Zero(), Vec3(0.1, 0.0, 0.0)}, Vec3::UnitZ(), 0.0);
  Pose about_heel = Pose::Identity();
  about_heel.rotate(Eigen::AngleAxisd(EIGEN_PI / 2.0, Vec3::UnitZ()));
  EXPECT_NEAR(travel(blade, Pose::Identity(), about_heel), 0.1 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(travel(blade, about_heel, about_heel), 0.0);
}

}  // namespace
}  // namespace cfem_cutting
