// Crease and cut end lie on the blade's edge: box at three voxel sizes, edges that run through and end
// inside.

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

#include "cfem_cutting/geometry/self_crossings.h"
#include "simulation/cut_box.h"

namespace cfem_cutting {
namespace {

using test::at;
using test::box_config;
using test::drive;
using test::make_simulation;

struct Cut {
  const char* name;
  double voxel;            // m
  Vec3 edge;               // m, from heel to tip
  std::vector<Pose> path;  // of the heel
};

void PrintTo(const Cut& cut, std::ostream* out) { *out << cut.name << ", voxels of " << cut.voxel << " m"; }

SimulationConfig config_of(const Cut& cut) {
  SimulationConfig config = box_config(cut.voxel);
  config.tissue.fixed = {GripConfig{Box(Vec3(-1, -1, -1), Vec3(1, 1, 0.001)), Vec3::Zero(), 1.0, ""}};
  return config;
}

FrontFidelity follow(Simulation& simulation, const Cut& cut) {
  FrontFidelity all;
  drive(simulation, cut.path, 0.05, [&](const StepReport&) { all.add(simulation.front_fidelity()); });
  return all;
}

Simulation simulation_of(const Cut& cut, const SimulationConfig& config) {
  return make_simulation(config, make_blade({Vec3::Zero(), cut.edge}, Vec3::UnitZ(), 0.0));
}

class Fidelity : public testing::TestWithParam<Cut> {};

TEST_P(Fidelity, crease_and_cut_end_are_on_the_edge_in_every_step) {
  const Cut& cut = GetParam();
  Simulation simulation = simulation_of(cut, config_of(cut));
  const FrontFidelity all = follow(simulation, cut);
  EXPECT_GT(all.crease.count, 20);
  EXPECT_GT(all.cut_end.count, 100);
  EXPECT_EQ(all.buried, 0);
  EXPECT_EQ(all.covered.count, 0);
  EXPECT_LT(all.crease.largest, 0.01 * cut.voxel);
  EXPECT_LT(all.cut_end.largest, 0.01 * cut.voxel);
  EXPECT_LT(all.vertices.largest, 0.01 * cut.voxel);
  const Distances faces = simulation.cut_face_distances().faces;
  EXPECT_GT(faces.count, 100);
  EXPECT_LT(faces.mean(), 0.01 * cut.voxel);
  EXPECT_LT(faces.largest, 0.1 * cut.voxel);
}

TEST_P(Fidelity, surface_at_rest_is_sound) {
  const Cut& cut = GetParam();
  Simulation simulation = simulation_of(cut, config_of(cut));
  drive(simulation, cut.path, 0.05, [&](const StepReport& report) {
    const TriangleMesh rest = simulation.surface().rest();
    const SurfaceQuality quality = assess(rest);
    EXPECT_TRUE(quality.defects.closed() && quality.defects.manifold()) << report.time;
    EXPECT_EQ(count_flipped(simulation.surface()), 0) << report.time;
    EXPECT_EQ(quality.degenerate, 0) << report.time;
  });
  const TriangleMesh rest = simulation.surface().rest();
  EXPECT_LT(assess(rest).needles, 0.01 * rest.triangles.size());
  EXPECT_LT(count_self_crossings(rest), 0.001 * rest.triangles.size());
}

std::vector<Cut> cuts() {
  std::vector<Cut> all;
  for (const double voxel : {0.002, 0.004, 0.008}) {
    all.push_back({"level", voxel, Vec3(0, 0.06, 0), {at(0.0331, -0.014, 0.034), at(0.0331, -0.014, 0.008)}});
    all.push_back(
        {"tilted", voxel, Vec3(0.02, 0.06, 0.012), {at(0.022, -0.013, 0.031), at(0.022, -0.013, 0.004)}});
    const double centre = (std::floor(0.033 / voxel) + 0.5) * voxel;
    all.push_back({"through_centres",
                   voxel,
                   Vec3(0.0, 0.06, 0.012),
                   {at(centre, -0.013, 0.031), at(centre, -0.013, 0.004)}});
  }
  // The tip sweeps a wedge: for some voxels behind it no link is severed.
  for (const double voxel : {0.002, 0.004})
    all.push_back({"stab",
                   voxel,
                   Vec3(0.0, 0.0151, -0.0235),
                   {at(0.0331, 0.0119, 0.0565), at(0.0331, 0.0119, 0.0355), at(0.0331, -0.006, 0.0355)}});
  // At first so little of the edge is in tissue that a single vertex is on it.
  all.push_back({"tip_first",
                 0.002,
                 Vec3(0.0049, 0.0246, -0.0123),
                 {at(0.03, 0.004, 0.049257), at(0.03, 0.004, 0.025257)}});
  return all;
}

Cut find_cut(const std::string& name, double voxel) {
  for (const Cut& cut : cuts())
    if (cut.name == name && cut.voxel == voxel) return cut;
  throw std::logic_error("there is no cut named " + name);
}

INSTANTIATE_TEST_SUITE_P(boxes, Fidelity, testing::ValuesIn(cuts()));

TEST(Fidelity, without_adaptation_crease_and_cut_end_are_off_the_edge) {
  const Cut cut = find_cut("tilted", 0.004);
  SimulationConfig config = config_of(cut);
  config.surface.influence_domain_adaptation = false;
  Simulation simulation = simulation_of(cut, config);
  const FrontFidelity all = follow(simulation, cut);
  EXPECT_GT(all.crease.mean(), 0.1 * cut.voxel);
  EXPECT_GT(all.cut_end.mean(), 0.1 * cut.voxel);
}

}  // namespace
}  // namespace cfem_cutting
