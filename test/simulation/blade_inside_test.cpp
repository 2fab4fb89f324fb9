/// A blade whose tip is in the tissue: stab and draw, and a first pose inside.

#include <gtest/gtest.h>

#include <algorithm>

#include "simulation/cut_box.h"

namespace cfem_cutting {
namespace {

using test::at;
using test::box_config;
using test::drive;
using test::make_simulation;

constexpr double kSpeed = 0.03;  // m/s

/// An edge that points down (its tip is the origin), cutting towards −x.
Blade upright_blade() { return make_blade({Vec3(0, 0, 0.05), Vec3(0, 0, 0)}, Vec3(1, 0, 0), 0.0); }

/// A box that stands on a board.
SimulationConfig standing_box() {
  SimulationConfig config = box_config();
  config.tissue.fixed.resize(1);
  config.tissue.fixed[0].box = Box(Vec3(-1, -1, -1), Vec3(1, 1, 0.001));
  return config;
}

/// Severed links by whether they lie where the cut was to be: across y, from x to x and above a height.
struct Count {
  int in_cut = 0, elsewhere = 0;
  Count(const Simulation& simulation, double from, double to, double bottom) {
    for (const LinkId& link : simulation.volume().severed_links()) {
      const Vec3 X = simulation.volume().centre(link.voxel);
      const bool within = link.axis == 1 && X.x() > from && X.x() < to && X.z() > bottom;
      ++(within ? in_cut : elsewhere);
    }
  }
};

constexpr double kY = 0.0161, kTip = 0.0165;

TEST(BladeInside, stab_and_draw_cuts_from_the_stab_to_the_end_and_no_deeper) {
  Simulation simulation = make_simulation(standing_box(), upright_blade());
  drive(simulation, {at(0.0483, kY, 0.036), at(0.0483, kY, kTip)}, kSpeed);
  EXPECT_EQ(simulation.volume().severed_count(), 0) << "an edge that moves along itself sweeps nothing";
  std::uint32_t fractures = 0;
  double peak = 0.0;
  drive(simulation, {at(0.0483, kY, kTip), at(0.0203, kY, kTip)}, kSpeed, [&](const StepReport& report) {
    fractures += static_cast<std::uint32_t>(report.events.size());
    peak = std::max(peak, report.spatial.force.norm());
  });
  const Count links(simulation, 0.02, 0.0483, kTip - 0.004);
  EXPECT_GE(fractures, 5u);
  EXPECT_GT(peak, 0.05);
  EXPECT_GE(links.in_cut, 4 * 5);
  EXPECT_EQ(links.elsewhere, 0);
  EXPECT_EQ(simulation.pieces().count(), 1);
  const SurfaceQuality quality = assess(simulation.surface().rest());
  EXPECT_TRUE(quality.defects.closed() && quality.defects.manifold());
}

TEST(BladeInside, withdrawn_after_a_draw_it_leaves_without_force) {
  Simulation simulation = make_simulation(standing_box(), upright_blade());
  const Pose end = at(0.0303, kY, kTip);
  drive(simulation, {at(0.0483, kY, 0.036), at(0.0483, kY, kTip), end}, kSpeed);
  const std::int64_t severed = simulation.volume().severed_count();
  double last = 1.0;
  drive(simulation, {end, at(0.0353, kY, kTip), at(0.0353, kY, 0.04)}, kSpeed,
        [&](const StepReport& report) { last = report.spatial.force.norm(); });
  EXPECT_EQ(simulation.volume().severed_count(), severed);
  EXPECT_LT(last, 1e-6);
}

class FirstPoseInside : public testing::TestWithParam<FractureMode> {};

TEST_P(FirstPoseInside, cuts_nothing_and_then_only_ahead) {
  SimulationConfig config = standing_box();
  config.fracture.mode = GetParam();
  Simulation simulation = make_simulation(config, upright_blade());
  StepInput input;
  input.path = {at(0.0403, kY, kTip)};
  input.front_anew = true;
  const StepReport first = simulation.step(input);
  EXPECT_EQ(simulation.volume().severed_count(), 0);
  EXPECT_LT(first.spatial.force.norm(), 1e-9);
  drive(simulation, {at(0.0403, kY, kTip), at(0.0203, kY, kTip)}, kSpeed);
  const Count links(simulation, 0.02, 0.0403, kTip - 0.004);
  EXPECT_GE(links.in_cut, 4 * 3);
  EXPECT_EQ(links.elsewhere, 0);
}

INSTANTIATE_TEST_SUITE_P(modes, FirstPoseInside,
                         testing::Values(FractureMode::kImmediate, FractureMode::kDelayed));

TEST(FirstPoseInside, of_sagging_tissue_is_held_from_the_first_step_on) {
  SimulationConfig config = standing_box();
  config.tissue.gravity = Vec3(0, 0, -9.81);
  Simulation simulation = make_simulation(config);
  const Pose pose = at(0.0331, 0.016, 0.031);
  drive(simulation, {pose, pose, pose}, kSpeed, [&](const StepReport& report) {
    const FrontFidelity fidelity = simulation.front_fidelity();
    EXPECT_GT(fidelity.crease.count, 50) << report.time;
    EXPECT_LT(fidelity.crease.largest, 0.01 * 0.004) << report.time;
    EXPECT_EQ(fidelity.covered.count + fidelity.buried, 0) << report.time;
  });
}

}  // namespace
}  // namespace cfem_cutting
