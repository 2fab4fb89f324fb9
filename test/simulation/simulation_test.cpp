#include "cfem_cutting/simulation/simulation.h"

#include <gtest/gtest.h>

#include <numeric>

#include "simulation/cut_box.h"

namespace cfem_cutting {
namespace {

using test::at;
using test::box_config;
using test::drive;
using test::make_simulation;

class ThroughCut : public testing::TestWithParam<int> {};

TEST_P(ThroughCut, gives_two_pieces_that_keep_the_volume) {
  const SimulationConfig config = box_config(0.004, GetParam());
  Simulation simulation = make_simulation(config);
  const double mass = simulation.model().total_mass();
  drive(simulation, {at(0.0321, 0.016, 0.036), at(0.0321, 0.016, -0.02)}, 0.05);
  ASSERT_EQ(simulation.pieces().count(), 2);
  const auto& volumes = simulation.pieces().volumes;
  EXPECT_NEAR(std::accumulate(volumes.begin(), volumes.end(), 0.0), config.tissue.box_size.prod(), 1e-12);
  EXPECT_NEAR(simulation.model().total_mass(), mass, 1e-12 * mass);
  EXPECT_EQ(simulation.volume().severed_count(), 8 * 8);
}

TEST_P(ThroughCut, stopped_short_leaves_one_piece) {
  Simulation simulation = make_simulation(box_config(0.004, GetParam()));
  drive(simulation, {at(0.0321, 0.016, 0.036), at(0.0321, 0.016, 0.008)}, 0.05);
  EXPECT_EQ(simulation.pieces().count(), 1);
  EXPECT_GT(simulation.volume().severed_count(), 8 * 4);
}

TEST_P(ThroughCut, surface_stays_closed_and_keeps_its_volume) {
  const SimulationConfig config = box_config(0.004, GetParam());
  Simulation simulation = make_simulation(config);
  drive(simulation, {at(0.0321, 0.016, 0.036), at(0.0321, 0.016, -0.02)}, 0.05,
        [&](const StepReport& report) {
          if (report.events.empty()) return;
          const SurfaceQuality quality = assess(simulation.surface().rest());
          EXPECT_TRUE(quality.defects.closed());
          EXPECT_TRUE(quality.defects.manifold());
        });
  EXPECT_NEAR(assess(simulation.surface().rest()).volume, config.tissue.box_size.prod(),
              0.01 * config.tissue.box_size.prod());
}

INSTANTIATE_TEST_SUITE_P(levels, ThroughCut, testing::Values(0, 1, 2));

struct Trace {
  std::vector<double> force;
  std::vector<bool> fractured;
};

Trace record_cut(const SimulationConfig& config) {
  Simulation simulation = make_simulation(config);
  Trace trace;
  drive(simulation, {at(0.0321, 0.016, 0.036), at(0.0321, 0.016, 0.004)}, 0.02,
        [&](const StepReport& report) {
          trace.force.push_back(report.spatial.force.z());
          trace.fractured.push_back(!report.events.empty());
        });
  return trace;
}

TEST(Simulation, delayed_cutting_is_a_saw) {
  const Trace trace = record_cut(box_config());
  int units = 0;
  double rise = 0.0;
  for (std::size_t i = 1; i < trace.force.size(); ++i) {
    rise = std::max(rise, trace.force[i]);
    if (!trace.fractured[i]) continue;
    ++units;
    EXPECT_GT(rise, 0.05) << "force before fracture in step " << i;
    EXPECT_LT(trace.force[i], 0.5 * rise) << "force falls at fracture in step " << i;
    rise = 0.0;
  }
  EXPECT_GE(units, 4);
  EXPECT_LE(units, 12);
}

TEST(Simulation, links_that_moved_less_than_d1_wait_for_a_later_unit) {
  SimulationConfig config = box_config(0.004, 0);
  config.fracture.onset_offset = 0.006;
  config.fracture.release_offset = 0.0054;
  Simulation simulation = make_simulation(config);
  int carried_over = 0, severed = 0;
  drive(simulation, {at(0.0321, 0.0163, 0.036), at(0.0321, 0.0163, -0.02)}, 0.05,
        [&](const StepReport& report) {
          for (const FractureEvent& event : report.events) severed += static_cast<int>(event.links_severed);
          if (!report.events.empty() && report.candidates > 0) ++carried_over;
        });
  EXPECT_GE(carried_over, 3);
  EXPECT_EQ(severed, 8 * 8);
}

TEST(Simulation, immediate_mode_fractures_whenever_links_are_met) {
  SimulationConfig config = box_config();
  config.fracture.mode = FractureMode::kImmediate;
  Simulation simulation = make_simulation(config);
  std::uint32_t severed = 0;
  drive(simulation, {at(0.0321, 0.016, 0.036), at(0.0321, 0.016, 0.004)}, 0.02,
        [&](const StepReport& report) {
          EXPECT_EQ(!report.events.empty(), report.links_severed > severed);
          EXPECT_EQ(report.candidates, 0u);
          severed = report.links_severed;
        });
  EXPECT_EQ(severed, 8u * 7u);
}

TEST(Simulation, a_blade_in_the_air_changes_nothing) {
  Simulation simulation = make_simulation(box_config());
  drive(simulation, {at(0.03, 0.016, 0.06), at(0.03, 0.016, 0.04)}, 0.05, [](const StepReport& report) {
    EXPECT_EQ(report.spatial.force.norm(), 0.0);
    EXPECT_EQ(report.phase, Phase::kFree);
  });
  EXPECT_EQ(simulation.volume().severed_count(), 0);
  EXPECT_LT((simulation.state().x - simulation.model().mesh().rest()).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Simulation, withdrawing_costs_no_force_and_cuts_nothing) {
  Simulation simulation = make_simulation(box_config());
  const Pose deep = at(0.0321, 0.016, 0.012);
  drive(simulation, {at(0.0321, 0.016, 0.036), deep}, 0.05);
  const std::int64_t severed = simulation.volume().severed_count();
  int step = 0;
  drive(simulation, {deep, at(0.0321, 0.016, 0.04)}, 0.05, [&](const StepReport& report) {
    if (++step > 10) {
      EXPECT_LT(report.spatial.force.norm(), 1e-6) << "step " << step;
    }
  });
  EXPECT_EQ(simulation.volume().severed_count(), severed);
}

TEST(Simulation, a_second_pass_along_the_cut_meets_nothing) {
  Simulation simulation = make_simulation(box_config());
  const Pose above = at(0.0321, 0.016, 0.036);
  drive(simulation, {above, at(0.0321, 0.016, 0.012), above}, 0.05);
  const std::int64_t severed = simulation.volume().severed_count();
  drive(simulation, {above, at(0.0321, 0.016, 0.018), above}, 0.05, [&](const StepReport& report) {
    EXPECT_LT(report.spatial.force.norm(), 1e-3);
    EXPECT_TRUE(report.events.empty());
  });
  EXPECT_EQ(simulation.volume().severed_count(), severed);
}

TEST(Simulation, a_jump_cuts_nothing) {
  Simulation simulation = make_simulation(box_config());
  StepInput input;
  input.path = {at(0.0321, 0.016, 0.036)};
  simulation.step(input);
  input.path = {at(0.0321, 0.016, -0.01)};
  simulation.step(input);
  EXPECT_EQ(simulation.volume().severed_count(), 0);
}

TEST(Simulation, immediate_cut_does_not_depend_on_the_pose_rate) {
  SimulationConfig config = box_config();
  config.fracture.mode = FractureMode::kImmediate;
  std::vector<std::vector<LinkId>> cuts;
  for (const double speed : {0.02, 0.04, 0.2}) {
    Simulation simulation = make_simulation(config);
    drive(simulation, {at(0.0321, 0.016, 0.036), at(0.028, 0.016, 0.02), at(0.035, 0.016, 0.006)}, speed);
    cuts.push_back(simulation.volume().severed_links());
  }
  EXPECT_EQ(cuts[0], cuts[1]);
  EXPECT_EQ(cuts[0], cuts[2]);
}

TEST(Simulation, wrench_balances_the_reactions_in_equilibrium) {
  SimulationConfig config = box_config();
  config.dynamics.quasi_static = true;
  config.dynamics.solver.tolerance = 1e-8;
  config.dynamics.solver.max_iterations = 2000;
  config.fracture.onset_offset = 0.02;
  Simulation simulation = make_simulation(config);
  StepReport last;
  const Pose pressed = at(0.0321, 0.016, 0.028);
  drive(simulation, {at(0.0321, 0.016, 0.033), pressed, pressed, pressed, pressed, pressed}, 0.05,
        [&](const StepReport& report) { last = report; });
  const NodeField f = simulation.model().forces(simulation.state().x);
  Vec3 supports = Vec3::Zero();
  for (int node = 0; node < f.cols(); ++node) {
    const double X = simulation.model().mesh().rest()(0, node);
    if (X < 0.001 || X > 0.063) supports -= f.col(node);
  }
  EXPECT_GT(last.spatial.force.z(), 0.1);
  EXPECT_NEAR((last.spatial.force - supports).norm(), 0.0, 0.01 * supports.norm());
}

TEST(Simulation, reset_restores_the_uncut_rest_shape) {
  Simulation simulation = make_simulation(box_config());
  drive(simulation, {at(0.0321, 0.016, 0.036), at(0.0321, 0.016, 0.01)}, 0.05);
  ASSERT_GT(simulation.volume().severed_count(), 0);
  simulation.reset();
  EXPECT_EQ(simulation.volume().severed_count(), 0);
  EXPECT_EQ(simulation.pieces().count(), 1);
  EXPECT_EQ(simulation.state().x, simulation.model().mesh().rest());
}

TEST(Simulation, same_input_gives_identical_results) {
  std::vector<Trace> traces{record_cut(box_config()), record_cut(box_config())};
  EXPECT_EQ(traces[0].force, traces[1].force);
}

/// Where contact points stay, what the front swept ahead of them is dented, not cut.
TEST(Simulation, area_of_a_fracture_is_that_behind_released_contact_points) {
  SimulationConfig config = box_config();
  config.fracture.onset_offset = 0.003;
  config.fracture.release_offset = 0.0024;
  Simulation simulation =
      make_simulation(config, make_blade({Vec3(0, -0.03, -0.006), Vec3(0, 0.03, 0.006)}, Vec3::UnitZ(), 0.0));
  std::vector<FractureEvent> events;
  double area = 0.0;  // m²
  drive(simulation, {at(0.0321, 0.016, 0.04), at(0.0321, 0.016, -0.01)}, 0.05, [&](const StepReport& report) {
    events.insert(events.end(), report.events.begin(), report.events.end());
    area = report.cut_area;
  });
  ASSERT_GT(events.size(), 3u);
  EXPECT_GT(events.front().area, 0.0);
  const double swept = 0.5 * 0.003 * 0.003 / 0.2;  // a triangle as deep as d0, under an edge of slope 0.2
  EXPECT_LT(events.front().area, 0.75 * swept);
  EXPECT_NEAR(area, 0.032 * 0.032, 0.02 * 0.032 * 0.032);
}

TEST(Simulation, materials_and_labels_that_the_tissue_lacks_are_told) {
  SimulationConfig config = box_config();
  EXPECT_TRUE(make_simulation(config).warnings().empty());
  Material unused = config.tissue.materials[0];
  unused.label = 7;
  config.tissue.materials.push_back(unused);
  config.surface.hidden_labels = {9};
  config.surface.label_colours = {{0, {1, 0, 0}}, {8, {1, 0, 0}}};
  const std::vector<std::string> warnings = make_simulation(config).warnings();
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_NE(warnings[0].find("tissue.materials[1]"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("surface.hidden_labels: no tissue has label 9"), std::string::npos);
  EXPECT_NE(warnings[2].find("surface.label_colours: no tissue has label 8"), std::string::npos);
}

}  // namespace
}  // namespace cfem_cutting
