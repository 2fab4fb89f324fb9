#include <cmath>

#include "elasticity/specimens.h"
#include "element_kinds.h"
#include "record.h"

namespace cfem_cutting {
namespace {

SolverOptions undamped() {
  SolverOptions options = precise();
  options.rayleigh_mass = options.rayleigh_stiffness = 0.0;
  return options;
}

double kinetic_energy(const ElasticModel& model, const ElasticState& state) {
  return 0.5 * state.v.colwise().squaredNorm().dot(model.mass());
}

Vec3 angular_momentum(const ElasticModel& model, const ElasticState& state) {
  Vec3 sum = Vec3::Zero();
  for (int n = 0; n < model.mesh().node_count(); ++n)
    sum += model.mass()[n] * state.x.col(n).cross(state.v.col(n));
  return sum;
}

/// A block struck at random, held below or free.
ElasticState struck(const ElasticModel& model, double speed) {
  return {model.mesh().rest(), random_displacement(model.mesh().node_count(), speed, 1)};
}

/// Largest growth of kinetic and elastic energy in a step, over the energy at the start.
double largest_growth(const ElasticModel& model, ElasticState state, const HeldNodes& held,
                      const SolverOptions& options, double dt, int steps) {
  Integrator integrator(options);
  for (int node : held.nodes) state.v.col(node).setZero();
  const double start = kinetic_energy(model, state) + model.energy(state.x);
  double energy = start, growth = -1.0;
  for (int i = 0; i < steps; ++i) {
    EXPECT_TRUE(integrator.step(model, state, dt, Vec3::Zero(), held, {}).converged);
    const double next = kinetic_energy(model, state) + model.energy(state.x);
    growth = std::max(growth, (next - energy) / start);
    energy = next;
  }
  return growth;
}

TEST(Dynamics, EnergyNeverGrows) {
  Record record("Energy of an undisturbed vibrating block, largest growth in a step over the start",
                "implicit Euler dissipates");
  for (ElementKind kind : {ElementKind::kTrilinear, ElementKind::kIncompatibleModes}) {
    const ElasticModel model(tilted_volume({0.05, 0.04, 0.03}, 0.005), 1, {soft(0.45)}, kind,
                             Kinematics::kCorotational);
    const double floor = model.mesh().rest().row(2).minCoeff() + 0.011;
    const HeldNodes held = hold_where(model.mesh(), [&](const Vec3& X) { return X.z() < floor; });
    for (double dt : {0.0005, 0.002, 0.01})
      for (double speed : {0.1, 1.0})
        record.at_most(name_of(kind) + std::string(", dt = ") + testing::PrintToString(dt) +
                           " s, struck at " + testing::PrintToString(speed) + " m/s",
                       1e-9,
                       std::max(0.0, largest_growth(model, struck(model, speed), held, undamped(), dt, 150)));
  }
}

/// A turning, swelling free body for 0.02 s: smooth and short, so that the steps resolve what they damp.
struct Drift {
  double linear, angular;  // over their size at the start
};
Drift free_flight(double dt) {
  const ElasticModel model(tilted_volume({0.05, 0.04, 0.03}, 0.005), 1, {soft(0.45)},
                           ElementKind::kIncompatibleModes, Kinematics::kCorotational);
  ElasticState state{model.mesh().rest(), NodeField::Zero(3, model.mesh().node_count())};
  const Mat3 spread = Vec3(4.0, -2.0, 1.0).asDiagonal();  // 1/s
  const Vec3 centre = model.mesh().rest() * model.mass() / model.total_mass();
  state.x.colwise() -= centre;
  for (int n = 0; n < model.mesh().node_count(); ++n)
    state.v.col(n) =
        Vec3(3.0, 5.0, -4.0).cross(Vec3(state.x.col(n))) + spread * state.x.col(n) + Vec3(0.1, 0.3, -0.2);
  const Vec3 linear = state.v * model.mass(), angular = angular_momentum(model, state);
  Integrator integrator(undamped());
  for (int i = 0; i < std::lround(0.02 / dt); ++i)
    EXPECT_TRUE(integrator.step(model, state, dt, Vec3::Zero(), {}, {}).converged);
  return {(state.v * model.mass() - linear).norm() / linear.norm(),
          (angular_momentum(model, state) - angular).norm() / angular.norm()};
}

TEST(Dynamics, FreeBodyKeepsItsMomenta) {
  Record record("Momenta of a free body after 0.02 s, relative change", "conservation");
  std::vector<double> angular;
  for (double dt : {8e-4, 4e-4, 2e-4, 1e-4, 5e-5}) {
    const Drift drift = free_flight(dt);
    angular.push_back(drift.angular);
    record.at_most("linear momentum, dt = " + testing::PrintToString(dt) + " s", 1e-10, drift.linear);
    record.note("angular momentum, dt = " + testing::PrintToString(dt) + " s", drift.angular);
    record.point("time", "angular momentum", dt / 8e-4, drift.angular);
  }
  record.absolute("order of the angular momentum's error in dt", 1.0, std::log2(angular[3] / angular[4]),
                  0.15);
}

}  // namespace
}  // namespace cfem_cutting
