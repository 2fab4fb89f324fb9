#include "cfem_cutting/simulation/timeline.h"

#include <gtest/gtest.h>

namespace cfem_cutting {
namespace {

Pose at_x(double x) { return Pose(Eigen::Translation3d(x, 0, 0)); }

double last_x(const StepInput& input) { return input.path.back().translation().x(); }

TEST(Timeline, StartsAtTheFirstMultipleWithTheFrontAnew) {
  Timeline timeline(0.01);
  EXPECT_FALSE(timeline.next());
  timeline.push(0.004, at_x(0.004));
  EXPECT_FALSE(timeline.next());
  timeline.push(0.024, at_x(0.024));
  const auto first = timeline.next();
  ASSERT_TRUE(first);
  EXPECT_DOUBLE_EQ(first->time, 0.01);
  EXPECT_TRUE(first->front_anew);
  ASSERT_EQ(first->path.size(), 1u);
  EXPECT_NEAR(last_x(*first), 0.01, 1e-15);
  const auto second = timeline.next();
  ASSERT_TRUE(second);
  EXPECT_FALSE(second->front_anew);
  EXPECT_NEAR(last_x(*second), 0.02, 1e-15);
  EXPECT_FALSE(timeline.next());
  EXPECT_NEAR(timeline.lag(), 0.004, 1e-12);
}

TEST(Timeline, PassesOnThePosesInsideAStep) {
  Timeline timeline(0.01);
  for (double t : {0.0, 0.003, 0.007, 0.01, 0.013}) timeline.push(t, at_x(t));
  EXPECT_EQ(timeline.next()->path.size(), 1u);
  EXPECT_EQ(timeline.next()->path.size(), 3u);
  EXPECT_FALSE(timeline.next());
}

TEST(Timeline, TakesStampsSince1970AsTheyAre) {
  Timeline timeline(0.01);
  const double start = 1.7e9;
  int steps = 0;
  for (int k = 0; k <= 1000; ++k) {
    timeline.push(start + 0.01 * k, at_x(k));
    for (; const auto input = timeline.next(); ++steps) {
      ASSERT_EQ(input->path.size(), 1u);
      ASSERT_NEAR(last_x(*input), steps, 1e-9);
    }
  }
  EXPECT_EQ(steps, 1001);
}

TEST(Timeline, HoldsTheBladeInAGapAndJumpsAtItsEnd) {
  Timeline timeline(0.1, {}, 0.25);
  timeline.push(0.0, at_x(0));
  timeline.push(0.35, at_x(1));
  timeline.push(0.4, at_x(2));
  for (double time : {0.0, 0.1, 0.2, 0.3}) {
    const auto input = timeline.next();
    EXPECT_NEAR(input->time, time, 1e-12);
    EXPECT_EQ(input->front_anew, time == 0.0);
    EXPECT_EQ(last_x(*input), 0.0);
  }
  const auto after = timeline.next();
  EXPECT_TRUE(after->front_anew);
  ASSERT_EQ(after->path.size(), 2u);
  EXPECT_EQ(after->path.front().translation().x(), 1.0);
}

TEST(Timeline, JudgesJumpsBetweenPosesAsTheyCome) {
  const auto is_jump = [](const Pose& a, const Pose& b) {
    return (b.translation() - a.translation()).norm() > 1.5;
  };
  Timeline timeline(0.1, is_jump);
  timeline.push(0.0, at_x(0));
  timeline.push(0.2, at_x(1));  // half of it a step
  timeline.push(0.4, at_x(3));  // half of this, too, but it is a jump
  for (double x : {0.0, 0.5, 1.0, 1.0}) {
    const auto input = timeline.next();
    EXPECT_NEAR(last_x(*input), x, 1e-12);
    EXPECT_EQ(input->front_anew, input->time == 0.0);
  }
  const auto after = timeline.next();
  EXPECT_TRUE(after->front_anew);
  EXPECT_EQ(last_x(*after), 3.0);
  EXPECT_EQ(timeline.jumps(), 1u);
}

TEST(Timeline, StartsAnewAfterAMinute) {
  Timeline timeline(0.1);
  timeline.push(0.0, at_x(0));
  timeline.next();
  timeline.push(100.0, at_x(1));
  EXPECT_NEAR(timeline.next()->time, 100.0, 1e-9);
}

TEST(Timeline, CatchesUpThroughAllPoses) {
  Timeline timeline(0.01);
  for (int k = 0; k <= 10; ++k) timeline.push(0.01 * k, at_x(k));
  double skipped = 0.0;
  timeline.next();
  const auto input = timeline.catch_up(skipped);
  ASSERT_TRUE(input);
  EXPECT_EQ(input->path.size(), 10u);
  EXPECT_NEAR(input->time, 0.1, 1e-12);
  EXPECT_NEAR(skipped, 0.09, 1e-12);
  EXPECT_FALSE(timeline.catch_up(skipped));
}

TEST(Timeline, HoldsAndGoesOnWithoutLosingAPose) {
  Timeline timeline(0.01);
  timeline.push(0.0, at_x(0));
  timeline.next();
  EXPECT_EQ(last_x(timeline.hold()), 0.0);
  EXPECT_EQ(last_x(timeline.hold()), 0.0);
  timeline.push(0.005, at_x(5));
  timeline.push(0.03, at_x(6));
  const auto input = timeline.next();
  ASSERT_TRUE(input);
  EXPECT_EQ(input->path.size(), 2u);
  EXPECT_FALSE(input->front_anew);
}

TEST(Timeline, RefusesStampsThatDoNotIncreaseAndRestarts) {
  Timeline timeline(0.01);
  EXPECT_TRUE(timeline.push(1.0, at_x(0)));
  EXPECT_FALSE(timeline.push(1.0, at_x(1)));
  timeline.next();
  timeline.restart();
  EXPECT_TRUE(timeline.push(0.5, at_x(1)));
  const auto input = timeline.next();
  EXPECT_NEAR(input->time, 0.5, 1e-12);
  EXPECT_TRUE(input->front_anew);
}

}  // namespace
}  // namespace cfem_cutting
