/// Steady cutting over the thresholds' ranges. Its figures stand in doc/results.md.

#include <gtest/gtest.h>

#include <cstdio>

#include "simulation/cut_box.h"

namespace cfem_cutting {
namespace {

using test::at;

constexpr double kVoxel = 0.004, kTop = 0.032;  // m
constexpr double kStep = 0.0005;                // m, the blade's way in a step

struct Thresholds {
  double onset;    ///< d0 in voxels
  double release;  ///< d1 / d0
  bool on_board;   ///< held at the bottom, else at both ends
};

std::ostream& operator<<(std::ostream& stream, const Thresholds& t) {
  return stream << "d0 = " << t.onset << " voxels, d1 = " << t.release << " d0, held at "
                << (t.on_board ? "the bottom" : "both ends");
}

SimulationConfig config_of(const Thresholds& t) {
  SimulationConfig config = test::box_config(kVoxel);
  config.fracture.onset_offset = t.onset * kVoxel;
  config.fracture.release_offset = t.release * config.fracture.onset_offset;
  if (t.on_board) config.tissue.fixed = {{Box(Vec3(-1, -1, -1), Vec3(1, 1, 0.001)), Vec3::Zero(), 1.0, ""}};
  return config;
}

class SteadyCutting : public testing::TestWithParam<Thresholds> {};

/// A blade wider than the box goes down through it and on.
TEST_P(SteadyCutting, progresses_and_ends_in_two_pieces) {
  const SimulationConfig config = config_of(GetParam());
  Simulation simulation = test::make_simulation(config);
  const double onset = config.fracture.onset_offset;
  double depth = -0.004, last = 0.0, longest = 0.0, peak = 0.0;
  int fractures = 0, alone = 0;
  const auto look = [&](const StepReport& report) {
    EXPECT_LE(report.events.size(), 1u);
    EXPECT_LE(report.largest_offset, onset + 0.1 * kVoxel + 2.0 * kStep) << "it should have fractured";
    peak = std::max(peak, report.spatial.force.norm());
    for (const FractureEvent& event : report.events) {
      ++fractures;
      alone += event.links_severed == 0;
      EXPECT_TRUE(event.links_severed > 0 || event.area > 0.0)
          << "fracture " << fractures << " at depth " << depth;
      if (depth < kTop) longest = std::max(longest, depth - last);
      last = depth;
    }
    depth += kStep;
  };
  test::drive(simulation, {at(0.0321, 0.0163, kTop + 0.004), at(0.0321, 0.0163, -0.024)}, kStep / 0.01, look);
  EXPECT_EQ(simulation.pieces().count(), 2);
  EXPECT_EQ(simulation.volume().severed_count(), 8 * 8);
  EXPECT_LE(longest, onset + 0.25 * kVoxel) << "between fractures";
  std::printf("| %s | %.1f | %.1f | %d | %d | %.2f | %.1f |\n", GetParam().on_board ? "bottom" : "ends",
              GetParam().onset, GetParam().release, fractures, alone, longest / kVoxel, peak);
}

std::vector<Thresholds> grid() {
  std::vector<Thresholds> all;
  for (const bool on_board : {false, true})
    for (const double onset : {0.2, 0.5, 1.0, 2.0, 3.0})
      for (const double release : {0.0, 0.3, 0.6, 0.9}) all.push_back({onset, release, on_board});
  return all;
}

INSTANTIATE_TEST_SUITE_P(thresholds, SteadyCutting, testing::ValuesIn(grid()));

}  // namespace
}  // namespace cfem_cutting
