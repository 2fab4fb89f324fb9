#include "cfem_cutting/cutting/sweep.h"

#include <gtest/gtest.h>

namespace cfem_cutting {
namespace {

/// Points 1 m apart along x at a height; 'i' inside tissue, 'n' near links, 'o' outside, '-' far away.
MaterialFront front(const std::string& points, double z) {
  MaterialFront front;
  for (const char point : points) {
    const Vec3 X(static_cast<double>(front.size()), 0.0, z);
    if (point == '-')
      front.push_back(std::nullopt);
    else
      front.push_back(MaterialPoint{X, 0, point == 'i', point == 'i' || point == 'n'});
  }
  return front;
}

double area(const std::vector<SweptTriangle>& swept) {
  double sum = 0.0;
  for (const SweptTriangle& t : swept) sum += 0.5 * t.normal().norm();
  return sum;
}

TEST(Sweep, TwoTrianglesForEachPairInside) {
  const auto swept = sweep(front("iii", 0.0), front("iii", 1.0));
  EXPECT_EQ(swept.size(), 4u);
  EXPECT_DOUBLE_EQ(area(swept), 2.0);
  for (const SweptTriangle& t : swept) EXPECT_GT(t.normal().dot(swept.front().normal()), 0.0);
}

TEST(Sweep, AirSweepsNothing) { EXPECT_TRUE(sweep(front("oooo", 0.0), front("oooo", 1.0)).empty()); }

TEST(Sweep, OneStripMoreBesideTissue) {
  EXPECT_DOUBLE_EQ(area(sweep(front("ooooooo", 0.0), front("oooiooo", 1.0))), 4.0);
}

TEST(Sweep, LinksBeyondTheSkinAreSwept) {
  EXPECT_DOUBLE_EQ(area(sweep(front("ooooooo", 0.0), front("ooonooo", 1.0))), 4.0);
}

TEST(Sweep, StripsWithAMissingCornerAreLeftOut) {
  EXPECT_DOUBLE_EQ(area(sweep(front("iiii", 0.0), front("ii-i", 1.0))), 1.0);
}

TEST(Sweep, ABladeThatRestsSweepsNothing) {
  EXPECT_TRUE(sweep(front("iii", 0.5), front("iii", 0.5)).empty());
}

}  // namespace
}  // namespace cfem_cutting
