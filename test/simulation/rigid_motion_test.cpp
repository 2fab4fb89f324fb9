/// Tissue and blade moved together give the same cut.

#include <gtest/gtest.h>

#include "simulation/cut_box.h"
#include "simulation/links.h"

namespace cfem_cutting {
namespace {

using test::at;

SimulationConfig carried_config(FractureMode mode) {
  SimulationConfig config = test::box_config();
  config.fracture.mode = mode;
  config.dynamics.quasi_static = true;
  config.dynamics.solver.tolerance = 1e-8;
  config.dynamics.solver.max_iterations = 1000;
  for (GripConfig& grip : config.tissue.fixed) grip.follow = "holder";
  return config;
}

Pose turned(double angle) {
  Pose pose = Pose::Identity();
  pose.translate(Vec3(0.3, -0.2, 0.1) * angle);
  pose.rotate(Eigen::AngleAxisd(angle, Vec3(1.0, 2.0, -2.0).normalized()));
  return pose;
}

/// No row of links lies just where a step ends, and no point of the edge on the skin.
const Pose kAbove = at(0.0321, 0.0163, 0.036), kEnd = at(0.0335, 0.0163, 0.0085);

struct Cut {
  std::vector<LinkId> links;
  std::vector<double> area;        // m², so far, per step
  std::vector<double> peak_force;  // N, per unit
};

/// Carries the tissue and its holder to a pose, and cuts it there.
Cut cut_at(const Pose& X_TH, FractureMode mode) {
  Simulation simulation = test::make_simulation(carried_config(mode));
  Cut cut;
  const auto step = [&](const Pose& holder, const Pose& blade) {
    StepInput input;
    input.grips["holder"] = holder;
    input.path = {holder * blade};
    return simulation.step(input);
  };
  constexpr int kCarry = 20, kStroke = 61;
  for (int i = 0; i <= kCarry; ++i)  // in air, so no force
    step(interpolate(Pose::Identity(), X_TH, static_cast<double>(i) / kCarry), kAbove);
  for (int i = 1; i <= kStroke; ++i) {
    const StepReport report = step(X_TH, interpolate(kAbove, kEnd, static_cast<double>(i) / kStroke));
    cut.area.push_back(report.cut_area);
    for (const FractureEvent& event : report.events) cut.peak_force.push_back(event.peak_force);
  }
  cut.links = simulation.volume().severed_links();
  return cut;
}

class RigidMotion : public testing::TestWithParam<FractureMode> {};

TEST_P(RigidMotion, of_tissue_and_blade_together_gives_the_same_cut) {
  const Cut still = cut_at(Pose::Identity(), GetParam());
  const Cut moved = cut_at(turned(1.9), GetParam());
  ASSERT_GE(still.links.size(), 40u);
  EXPECT_EQ(moved.links, still.links);
  ASSERT_EQ(moved.peak_force.size(), still.peak_force.size());
  for (std::size_t i = 0; i < still.peak_force.size(); ++i)
    EXPECT_NEAR(moved.peak_force[i], still.peak_force[i], 1e-3 * still.peak_force[i]) << "unit " << i + 1;
  for (std::size_t i = 0; i < still.area.size(); ++i) EXPECT_NEAR(moved.area[i], still.area[i], 1e-7);
}

INSTANTIATE_TEST_SUITE_P(modes, RigidMotion,
                         testing::Values(FractureMode::kImmediate, FractureMode::kDelayed));

}  // namespace
}  // namespace cfem_cutting
