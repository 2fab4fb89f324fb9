#include "cfem_cutting/cutting/swept_trail.h"

#include <gtest/gtest.h>

namespace cfem_cutting {
namespace {

MaterialFront front(double z, bool inside = true) {
  MaterialFront front;
  for (int i = 0; i < 5; ++i) front.push_back(MaterialPoint{{0.25 * i, 0.0, z}, 0, inside, inside});
  return front;
}

double area(const std::vector<SweptTriangle>& swept) {
  double sum = 0.0;
  for (const SweptTriangle& t : swept) sum += 0.5 * t.normal().norm();
  return sum;
}

void go(SweptTrail& trail, double from, double to, int motions) {
  for (int i = 0; i < motions; ++i)
    trail.follow(front(from + (to - from) * i / motions), front(from + (to - from) * (i + 1) / motions));
}

TEST(SweptTrail, HasRowsAGrainApartHoweverManyMotions) {
  for (const int motions : {16, 1000}) {
    SweptTrail trail(0.1);
    go(trail, 0.0, 1.0, motions);
    const auto swept = trail.take();
    EXPECT_NEAR(area(swept), 1.0, 1e-12);
    EXPECT_LE(swept.size(), 8u * 11u);
  }
}

TEST(SweptTrail, GoesOnWhereItWasTaken) {
  SweptTrail trail(0.1);
  go(trail, 0.0, 0.33, 10);
  const double first = area(trail.take());
  go(trail, 0.33, 0.5, 10);
  EXPECT_NEAR(first, 0.33, 1e-12);
  EXPECT_NEAR(area(trail.take()), 0.17, 1e-12);
}

TEST(SweptTrail, EndsARowWhereTheFrontEntersTissue) {
  SweptTrail trail(10.0);
  trail.follow(front(-0.2, false), front(-0.1, false));
  trail.follow(front(-0.1, false), front(0.1));
  trail.follow(front(0.1), front(0.3));
  EXPECT_NEAR(area(trail.take()), 0.4, 1e-12);  // from -0.1: before, all was air
}

TEST(SweptTrail, ForgetsWhatIsDropped) {
  SweptTrail trail(0.1);
  go(trail, 0.0, 1.0, 10);
  trail.drop();
  EXPECT_TRUE(trail.take().empty());
  go(trail, 3.0, 3.5, 10);
  EXPECT_NEAR(area(trail.take()), 0.5, 1e-12);
}

}  // namespace
}  // namespace cfem_cutting
