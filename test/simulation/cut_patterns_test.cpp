/// Several cuts in one tissue: crosses, T cuts, cut-outs, thin slices, dust, and cuts along the lattice's
/// planes.

#include <gtest/gtest.h>

#include <numeric>

#include "simulation/cut_box.h"

namespace cfem_cutting {
namespace {

using test::at;
using test::box_config;
using test::make_simulation;

constexpr double kSpeed = 0.05;  // m/s
constexpr double kVoxel = 0.004, kThickness = 0.016;

/// A sheet held at its four sides by frames that can be moved.
SimulationConfig sheet_config() {
  SimulationConfig config = box_config(kVoxel);
  config.tissue.box_size = Vec3(0.048, 0.048, kThickness);
  const Box sides[] = {Box(Vec3(-1, -1, -1), Vec3(0.001, 1, 1)), Box(Vec3(0.047, -1, -1), Vec3(1, 1, 1)),
                       Box(Vec3(-1, -1, -1), Vec3(1, 0.001, 1)), Box(Vec3(-1, 0.047, -1), Vec3(1, 1, 1))};
  const char* names[] = {"left", "right", "front", "back"};
  config.tissue.fixed.clear();
  for (int i = 0; i < 4; ++i) config.tissue.fixed.push_back({sides[i], Vec3::Zero(), 1.0, names[i]});
  return config;
}

const Blade kLong = test::straight_blade();
const Blade kShort = make_blade({Vec3(0, -0.0141, 0), Vec3(0, 0.0141, 0)}, Vec3(0, 0, 1), 0.0);

/// Presses an edge through tissue of a height and takes it out again.
/// @param along_x whether the edge lies along x, else along y
void press(Simulation& simulation, double x, double y, bool along_x, double height = kThickness) {
  const Pose turned = Pose(Eigen::AngleAxisd(along_x ? -M_PI / 2 : 0.0, Vec3::UnitZ()));
  const Pose above = at(x, y, height + 0.004) * turned, below = at(x, y, -0.01) * turned;
  test::drive(simulation, {above, below, above}, kSpeed);
}

/// The surface is closed and manifold, all is finite, and no volume is lost.
void expect_sound(const Simulation& simulation) {
  const SurfaceQuality quality = assess(simulation.surface().rest());
  EXPECT_TRUE(quality.defects.closed() && quality.defects.manifold());
  EXPECT_TRUE(simulation.state().x.allFinite());
  const auto& volumes = simulation.pieces().volumes;
  EXPECT_NEAR(std::accumulate(volumes.begin(), volumes.end(), 0.0),
              simulation.config().tissue.box_size.prod(), 1e-12);
}

TEST(CutPatterns, an_x_opens_four_corners_when_its_sides_are_pulled) {
  SimulationConfig config = sheet_config();
  const Vec3 middle(0.0241, 0.0241, 0.0125);
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) config.probes.push_back(middle + Vec3(0.001 * x, 0.001 * y, 0));
  Simulation simulation = make_simulation(config, kShort);
  press(simulation, middle.x(), middle.y(), false);
  press(simulation, middle.x(), middle.y(), true);
  EXPECT_EQ(simulation.pieces().count(), 1);
  for (const Vec3& u : simulation.probe_displacements()) EXPECT_LT(u.norm(), 1e-6);
  constexpr double kPull = 0.004;
  StepInput input;
  for (int i = 0; i <= 100; ++i) {
    const double way = kPull * i / 100.0;
    input.grips = {{"left", at(-way, 0, 0)},
                   {"right", at(way, 0, 0)},
                   {"front", at(0, -way, 0)},
                   {"back", at(0, way, 0)}};
    simulation.step(input);
  }
  const std::vector<Vec3> corners = simulation.probe_displacements();
  for (int corner = 0; corner < 4; ++corner) {
    EXPECT_GT(corners[corner].x() * (corner / 2 == 0 ? -1.0 : 1.0), 0.5 * kPull) << "corner " << corner;
    EXPECT_GT(corners[corner].y() * (corner % 2 == 0 ? -1.0 : 1.0), 0.5 * kPull) << "corner " << corner;
  }
  expect_sound(simulation);
}

TEST(CutPatterns, a_t_gives_three_pieces) {
  Simulation simulation = make_simulation(sheet_config(), kLong);
  press(simulation, 0.0241, 0.0241, false);
  EXPECT_EQ(simulation.pieces().count(), 2);
  press(simulation, 0.0241 + 0.03, 0.0241, true);  // the edge ends in the first cut
  EXPECT_EQ(simulation.pieces().count(), 3);
  expect_sound(simulation);
}

TEST(CutPatterns, four_cuts_cut_a_plug_out) {
  Simulation simulation = make_simulation(sheet_config(), kShort);
  for (const double x : {0.0161, 0.0321}) press(simulation, x, 0.0241, false);
  for (const double y : {0.0161, 0.0321}) press(simulation, 0.0241, y, true);
  ASSERT_EQ(simulation.pieces().count(), 2);
  EXPECT_NEAR(simulation.pieces().volumes[1], 16.0 * kVoxel * kVoxel * kThickness, 1e-12);
  expect_sound(simulation);
}

TEST(CutPatterns, a_plug_that_falls_away_is_not_cut_on) {
  SimulationConfig config = sheet_config();
  config.tissue.gravity = Vec3(0, 0, -9.81);
  Simulation simulation = make_simulation(config, kShort);
  for (const double x : {0.0161, 0.0321}) press(simulation, x, 0.0241, false);
  for (const double y : {0.0161, 0.0321}) press(simulation, 0.0241, y, true);
  ASSERT_EQ(simulation.pieces().count(), 2);
  const std::int64_t severed = simulation.volume().severed_count();
  const Pose under = at(0.0241, 0.0241, -0.05);
  test::drive(simulation,
              {at(0.0241, 0.0241, 0.02), at(0.06, 0.0241, 0.02), at(0.06, 0.0241, -0.05), under, under}, 0.2,
              [](const StepReport& report) { EXPECT_TRUE(report.events.empty()); });
  EXPECT_EQ(simulation.volume().severed_count(), severed);
  expect_sound(simulation);
}

TEST(CutPatterns, four_cuts_can_leave_dust) {
  Simulation simulation = make_simulation(sheet_config(), kShort);
  for (const double x : {0.0201, 0.0239}) press(simulation, x, 0.0241, false);
  for (const double y : {0.0201, 0.0239}) press(simulation, 0.0241, y, true);
  ASSERT_EQ(simulation.pieces().count(), 2);
  EXPECT_NEAR(simulation.pieces().volumes[1], kVoxel * kVoxel * kThickness, 1e-12);
  expect_sound(simulation);
}

class Slash : public testing::TestWithParam<int> {};

TEST_P(Slash, through_thin_tissue_parts_it_however_few_steps_it_takes) {
  SimulationConfig config = sheet_config();
  config.tissue.box_size.z() = 0.008;
  Simulation simulation = make_simulation(config, kLong);
  const Pose above = at(0.0241, 0.0241, 0.01), below = at(0.0241, 0.0241, -0.006);
  test::drive(simulation, {above, below, below}, 0.016 / (GetParam() * config.dynamics.time_step));
  EXPECT_EQ(simulation.pieces().count(), 2);
  expect_sound(simulation);
}

INSTANTIATE_TEST_SUITE_P(steps, Slash, testing::Values(1, 2, 3, 10));

class ThinSlice : public testing::TestWithParam<double> {};

TEST_P(ThinSlice, comes_off_only_if_it_holds_voxel_centres) {
  Simulation simulation = make_simulation(box_config(kVoxel), kLong);
  const double x = 0.0323, end = x + GetParam();
  press(simulation, x, 0.0161, false, 0.032);
  press(simulation, end, 0.0161, false, 0.032);
  const bool holds_centres = end > 0.034;
  EXPECT_EQ(simulation.pieces().count(), holds_centres ? 3 : 2);
  EXPECT_EQ(simulation.volume().severed_count(), holds_centres ? 128 : 64);
  expect_sound(simulation);
}

INSTANTIATE_TEST_SUITE_P(thicknesses, ThinSlice, testing::Values(0.0003, 0.0013, 0.0025, 0.0041));

class LatticePlane : public testing::TestWithParam<double> {};

/// Along faces of voxels or through their centres, exactly or as nearly as can be.
TEST_P(LatticePlane, cuts_each_link_across_once) {
  for (const double beside : {-1e-12, 0.0, 1e-12}) {
    Simulation simulation = make_simulation(box_config(kVoxel), kLong);
    press(simulation, GetParam() + beside, 0.016, false, 0.032);
    EXPECT_EQ(simulation.pieces().count(), 2) << beside;
    EXPECT_EQ(simulation.volume().severed_count(), 64) << beside;
    expect_sound(simulation);
  }
}

INSTANTIATE_TEST_SUITE_P(planes, LatticePlane, testing::Values(0.032, 0.034));

}  // namespace
}  // namespace cfem_cutting
