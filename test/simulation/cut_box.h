#pragma once
/// A gelatine box, held at both ends or at its bottom, and a straight blade that moves through it.

#include <cmath>
#include <functional>
#include <vector>

#include "cfem_cutting/simulation/simulation.h"
#include "cfem_cutting/volume/shapes.h"

namespace cfem_cutting::test {

inline SimulationConfig box_config(double voxel = 0.004, int level = 1) {
  SimulationConfig config;
  config.tissue.box_size = Vec3(0.064, 0.032, 0.032);
  config.tissue.voxel_size = Vec3::Constant(voxel);
  config.tissue.composite_level = level;
  config.tissue.materials[0].young_modulus = 14.8e3;
  config.tissue.fixed.resize(2);
  config.tissue.fixed[0].box = Box(Vec3(-1, -1, -1), Vec3(0.001, 1, 1));
  config.tissue.fixed[1].box = Box(Vec3(0.063, -1, -1), Vec3(1, 1, 1));
  config.dynamics.solver.threads = 1;
  return config;
}

/// Edge along y, wider than the box, cutting towards −z.
inline Blade straight_blade(double friction = 0.0) {
  return make_blade({Vec3(0, -0.03, 0), Vec3(0, 0.03, 0)}, Vec3(0, 0, 1), friction);
}

inline Simulation make_simulation(const SimulationConfig& config, const Blade& blade = straight_blade()) {
  return Simulation(config, *make_box(config.tissue.box_size, Pose::Identity()), blade);
}

/// X_TB of an upright blade.
inline Pose at(double x, double y, double z) { return Pose(Eigen::Translation3d(x, y, z)); }

/// Steps the blade along waypoints at a speed (m/s); `look` sees each report.
inline void drive(Simulation& simulation, const std::vector<Pose>& waypoints, double speed,
                  const std::function<void(const StepReport&)>& look = {}) {
  const double dt = simulation.config().dynamics.time_step;
  double time = 0.0;
  const auto step = [&](const Pose& pose) {
    StepInput input;
    input.time = time += dt;
    input.path = {pose};
    const StepReport report = simulation.step(input);
    if (look) look(report);
  };
  step(waypoints.front());
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const double way = (waypoints[i].translation() - waypoints[i - 1].translation()).norm();
    const int steps = std::max(1, static_cast<int>(std::lround(way / (speed * dt))));
    for (int k = 1; k <= steps; ++k)
      step(interpolate(waypoints[i - 1], waypoints[i], static_cast<double>(k) / steps));
  }
}

}  // namespace cfem_cutting::test
