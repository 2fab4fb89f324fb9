/// A blade that moves in the cut it has made.

#include <gtest/gtest.h>

#include "simulation/cut_box.h"
#include "simulation/links.h"

namespace cfem_cutting {
namespace {

using test::at;
using test::box_config;
using test::drive;
using test::make_simulation;

constexpr double kSpeed = 0.05;  // m/s
constexpr double kX = 0.0321, kY = 0.0163;
const Pose kAbove = at(kX, kY, 0.036), kDeep = at(kX, kY, 0.0123);

/// A box with a cut from above, in which the blade still presses.
class OwnCut : public testing::Test {
 protected:
  OwnCut() : simulation(make_simulation(box_config())) {
    drive(simulation, {kAbove, kDeep}, kSpeed, [&](const StepReport& report) {
      area = report.cut_area;
      force = report.spatial.force.z();
    });
    links = simulation.volume().severed_links();
  }

  /// Moves the blade and expects that it cuts nothing.
  void move(const std::vector<Pose>& waypoints, const std::function<void(const StepReport&)>& look) {
    drive(simulation, waypoints, kSpeed, [&](const StepReport& report) {
      EXPECT_TRUE(report.events.empty());
      EXPECT_EQ(report.cut_area, area);
      look(report);
    });
    EXPECT_EQ(simulation.volume().severed_links(), links);
  }

  Simulation simulation;
  double area = 0.0;   // m²
  double force = 0.0;  // N
  std::vector<LinkId> links;
};

void expect_no_force(const StepReport& report) { EXPECT_LT(report.spatial.force.norm(), 1e-6); }

TEST_F(OwnCut, lets_the_blade_out_without_force) {
  ASSERT_GT(force, 0.1);
  int step = 0;
  move({kDeep, kAbove}, [&](const StepReport& report) {
    EXPECT_GT(report.spatial.force.z(), -1e-9) << "the tissue holds the blade back";
    // The dent is no deeper than d0, which takes six steps.
    if (++step > 8) expect_no_force(report);
  });
}

TEST_F(OwnCut, is_free_to_go_up_and_down_in) {
  const Pose up = at(kX, kY, 0.028), down = at(kX, kY, 0.018);
  move({kDeep, up}, [](const StepReport&) {});
  move({up, down, up, down, up}, expect_no_force);
}

TEST_F(OwnCut, is_free_to_go_along) {
  const Pose middle = at(kX, kY, 0.018);
  move({kDeep, middle}, [](const StepReport&) {});
  move({middle, at(kX, kY - 0.01, 0.018), at(kX, kY + 0.01, 0.02), middle}, expect_no_force);
}

TEST_F(OwnCut, presses_at_its_end_as_before_and_is_not_cut_on) {
  const Pose up = at(kX, kY, 0.018);
  const double before = force;
  move({kDeep, up, kDeep, up, kDeep},
       [&](const StepReport& report) { EXPECT_LT(report.spatial.force.z(), 1.01 * before); });
}

TEST_F(OwnCut, is_not_cut_on_by_a_draw_at_its_end) {
  move({kDeep, at(kX, kY - 0.01, 0.0123), at(kX, kY + 0.01, 0.0123), kDeep},
       [](const StepReport& report) { EXPECT_GT(report.spatial.force.z(), 0.1); });
}

TEST_F(OwnCut, is_not_cut_by_going_aside) {
  const Pose middle = at(kX, kY, 0.0163);
  move({kDeep, middle, at(kX - 0.003, kY, 0.0163), at(kX + 0.003, kY, 0.0163), middle, kAbove},
       [](const StepReport& report) { EXPECT_GT(report.spatial.force.z(), -1e-9); });
}

TEST_F(OwnCut, goes_on_where_a_single_stroke_would_have) {
  const Pose end = at(kX, kY, 0.0043);
  drive(simulation, {kDeep, kAbove, end}, kSpeed);
  Simulation at_once = make_simulation(box_config());
  drive(at_once, {kAbove, end}, kSpeed);
  EXPECT_GT(simulation.volume().severed_count(), static_cast<std::int64_t>(links.size()));
  EXPECT_LE(test::layers_apart(simulation.volume(), simulation.volume().severed_links(),
                               at_once.volume().severed_links()),
            1);
}

/// The upper half of the edge goes through the first draw's cut.
TEST(OwnCutDrawn, is_deepened_by_a_second_draw) {
  SimulationConfig config = box_config();
  config.tissue.fixed = {GripConfig{Box(Vec3(-1, -1, -1), Vec3(1, 1, 0.001)), Vec3::Zero(), 1.0, ""}};
  Simulation simulation =
      make_simulation(config, make_blade({Vec3::Zero(), Vec3(0, 0.016, -0.016)}, Vec3(0, 0.6, 1), 0.0));
  drive(simulation, {at(kX, 0.034, 0.031), at(kX, -0.018, 0.031), at(kX, -0.018, 0.05)}, kSpeed);
  const std::int64_t links = simulation.volume().severed_count();
  ASSERT_GT(links, 0);
  FrontFidelity second;
  drive(simulation, {at(kX, 0.034, 0.05), at(kX, 0.034, 0.022), at(kX, -0.018, 0.022)}, 4.0 * kSpeed,
        [&](const StepReport&) { second.add(simulation.front_fidelity()); });
  EXPECT_GT(simulation.volume().severed_count(), links);
  EXPECT_GT(second.cut_end.count, 100);
  EXPECT_LT(second.cut_end.mean(), 0.01 * config.tissue.voxel_size.x());
  EXPECT_EQ(second.buried, 0);
  EXPECT_LT(second.covered.count, 0.01 * second.cut_end.count) << "a few where the tissue still moves";
  EXPECT_LT(second.covered.largest, 0.1 * config.tissue.voxel_size.x());
}

TEST(OwnCutImmediate, is_not_cut_again) {
  SimulationConfig config = box_config();
  config.fracture.mode = FractureMode::kImmediate;
  Simulation simulation = make_simulation(config);
  drive(simulation, {kAbove, kDeep}, kSpeed);
  const std::int64_t severed = simulation.volume().severed_count();
  ASSERT_GT(severed, 0);
  drive(simulation, {kDeep, kAbove, kDeep, at(kX, kY + 0.01, 0.02), kDeep}, kSpeed,
        [](const StepReport& report) { EXPECT_TRUE(report.events.empty()); });
  EXPECT_EQ(simulation.volume().severed_count(), severed);
}

}  // namespace
}  // namespace cfem_cutting
