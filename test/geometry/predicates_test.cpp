#include "cfem_cutting/geometry/predicates.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cfem_cutting {
namespace {

double next_up(double x) { return std::nextafter(x, 1e300); }
double next_down(double x) { return std::nextafter(x, -1e300); }

TEST(Predicates, SignsFollowTheRightHandRule) {
  EXPECT_EQ(orient2d({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(orient2d({0, 0}, {0, 1}, {1, 0}), -1);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}), -1);
}

TEST(Predicates, TiesAreZero) {
  EXPECT_EQ(orient2d({0.5, 0.5}, {12, 12}, {24, 24}), 0);
  EXPECT_EQ(orient3d({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.3, 0.7, 0.5}, {12, 12, 12}), 0);
  EXPECT_EQ(orient2d({0.1, 0.2}, {0.1, 0.2}, {3, 4}), 0);
}

TEST(Predicates, OneUnitInTheLastPlaceIsSeen) {
  // The classic case in which floating point errs: Kettner et al. 2008, "Classroom examples of robustness".
  EXPECT_EQ(orient2d({0.5, next_up(0.5)}, {12, 12}, {24, 24}), 1);
  EXPECT_EQ(orient2d({0.5, next_down(0.5)}, {12, 12}, {24, 24}), -1);
  EXPECT_EQ(orient3d({12, 12, 0}, {24, 24, 0}, {12, 12, 1}, {0.5, next_up(0.5), 0.3}), -1);
  EXPECT_EQ(orient3d({12, 12, 0}, {24, 24, 0}, {12, 12, 1}, {0.5, next_down(0.5), 0.3}), 1);
}

TEST(Predicates, SwappingPointsFlipsTheSignNextToTies) {
  const double u = std::ldexp(1.0, -53);
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const Eigen::Vector2d a(0.5 + i * u, 0.5 + j * u), b(12, 12), c(24, 24);
      EXPECT_EQ(orient2d(a, b, c), (j > i) - (j < i));
      EXPECT_EQ(orient2d(b, a, c), -orient2d(a, b, c));
    }
  }
}

}  // namespace
}  // namespace cfem_cutting
