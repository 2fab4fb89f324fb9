/// A piecewise-linear path gives the same cut however often its poses come.

#include <gtest/gtest.h>

#include "cfem_cutting/simulation/timeline.h"
#include "simulation/cut_box.h"
#include "simulation/links.h"

namespace cfem_cutting {
namespace {

using test::at;
using test::box_config;

constexpr double kRate = 40.0;          // Hz
constexpr double kKnots = 4.0 / kRate;  // s, from knot to knot, so that half the rate has them too
constexpr double kStart = 0.004;        // s, so that knots fall inside steps
constexpr double kFactors[] = {0.5, 2.0, 10.0};

Pose tilted(double x, double z, double about_y, double about_x) {
  Pose X_TB = at(x, 0.016, z);
  X_TB.rotate(Eigen::AngleAxisd(about_y, Vec3::UnitY()) * Eigen::AngleAxisd(about_x, Vec3::UnitX()));
  return X_TB;
}

/// Down with a zigzag.
std::vector<Pose> zigzag() {
  return {at(0.0321, 0.016, 0.036), at(0.0305, 0.016, 0.031), at(0.0341, 0.016, 0.026),
          at(0.0297, 0.016, 0.021), at(0.0335, 0.016, 0.016), at(0.0315, 0.016, 0.0105)};
}

/// The same, and the blade turns.
std::vector<Pose> winding() {
  return {tilted(0.0321, 0.036, 0.0, 0.0),    tilted(0.0305, 0.031, 0.1, 0.02),
          tilted(0.0341, 0.026, -0.1, -0.02), tilted(0.0297, 0.021, 0.05, 0.04),
          tilted(0.0335, 0.016, 0.15, 0.0),   tilted(0.0315, 0.0105, -0.05, -0.03)};
}

/// The links that are severed if poses come at `rate` (Hz).
std::vector<LinkId> cut(const SimulationConfig& config, const std::vector<Pose>& knots, double rate) {
  Simulation simulation = test::make_simulation(config);
  Timeline timeline(config.dynamics.time_step);
  const int between = static_cast<int>(std::lround(rate * kKnots));
  for (std::size_t knot = 0; knot + 1 < knots.size(); ++knot)
    for (int i = knot == 0 ? 0 : 1; i <= between; ++i) {
      const double share = static_cast<double>(i) / between;
      timeline.push(kStart + (static_cast<double>(knot) + share) * kKnots,
                    interpolate(knots[knot], knots[knot + 1], share));
      while (const auto input = timeline.next()) simulation.step(*input);
    }
  return simulation.volume().severed_links();
}

class PoseRate : public testing::TestWithParam<std::vector<Pose> (*)()> {};

TEST_P(PoseRate, does_not_change_an_immediate_cut) {
  SimulationConfig config = box_config();
  config.fracture.mode = FractureMode::kImmediate;
  const std::vector<LinkId> expected = cut(config, GetParam()(), kRate);
  ASSERT_GT(expected.size(), 40u);
  for (const double factor : kFactors)
    EXPECT_EQ(cut(config, GetParam()(), factor * kRate), expected) << factor;
}

TEST_P(PoseRate, changes_a_delayed_cut_by_no_more_than_a_layer_at_its_end) {
  const SimulationConfig config = box_config();
  const VoxelVolume volume = test::make_simulation(config).volume();
  const std::vector<LinkId> expected = cut(config, GetParam()(), kRate);
  ASSERT_GT(expected.size(), 40u);
  for (const double factor : kFactors) {
    const std::vector<LinkId> links = cut(config, GetParam()(), factor * kRate);
    EXPECT_LE(test::layers_apart(volume, expected, links), 1) << factor;
  }
}

/// What a node does that lags.
TEST_P(PoseRate, may_be_a_single_step_along_all_poses) {
  SimulationConfig config = box_config();
  config.fracture.mode = FractureMode::kImmediate;
  Simulation simulation = test::make_simulation(config);
  StepInput input;
  input.path = GetParam()();
  simulation.step(input);
  EXPECT_EQ(simulation.volume().severed_links(), cut(config, GetParam()(), kRate));
}

INSTANTIATE_TEST_SUITE_P(paths, PoseRate, testing::Values(zigzag, winding));

}  // namespace
}  // namespace cfem_cutting
