#include <cmath>

#include "direct_problem.h"
#include "element_kinds.h"
#include "record.h"
#include "reference_element.h"
#include "two_materials.h"

namespace cfem_cutting {
namespace {

const char* const kSource = "central differences";

VoxelVolume cut_tilted_volume() {
  VoxelVolume volume = tilted_two_material_box();
  sever_plane(volume, volume.centre(static_cast<int>(volume.voxels().size()) / 2),
              Vec3(1.0, 0.4, 0.2).normalized());
  return volume;
}

struct Case {
  ElementKind kind;
  Kinematics kinematics;
  int level;
  std::string name() const {
    return name_of(kind) + (kinematics == Kinematics::kLinear ? ", linear" : ", co-rotational") + ", level " +
           std::to_string(level);
  }
};

void PrintTo(const Case& c, std::ostream* stream) { *stream << c.name(); }

class Derivatives : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Kinds, Derivatives,
                         testing::Values(Case{ElementKind::kTrilinear, Kinematics::kLinear, 0},
                                         Case{ElementKind::kTrilinear, Kinematics::kCorotational, 0},
                                         Case{ElementKind::kTrilinear, Kinematics::kCorotational, 2},
                                         Case{ElementKind::kIncompatibleModes, Kinematics::kLinear, 1},
                                         Case{ElementKind::kIncompatibleModes, Kinematics::kCorotational, 0},
                                         Case{ElementKind::kIncompatibleModes, Kinematics::kCorotational, 1},
                                         Case{ElementKind::kIncompatibleModes, Kinematics::kCorotational,
                                              2}));

TEST_P(Derivatives, ForceIsMinusTheEnergysSlope) {
  const ElasticModel model(cut_tilted_volume(), GetParam().level, soft_and_stiff(), GetParam().kind,
                           GetParam().kinematics);
  const double h = model.mesh().block_size().mean(), step = 1e-5 * h;
  const Mat3 turn = Eigen::AngleAxisd(1.0, Vec3(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  const NodeField x =
      turn * model.mesh().rest() + random_displacement(model.mesh().node_count(), 0.15 * h, 7);
  const NodeField f = model.forces(x);
  double error = 0.0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const NodeField d = random_displacement(model.mesh().node_count(), 1.0, seed);
    const double slope = (model.energy(x + step * d) - model.energy(x - step * d)) / (2.0 * step);
    error = std::max(error, std::abs(slope + f.cwiseProduct(d).sum()) / (f.norm() * d.norm()));
  }
  Record record("Elastic force against the slope of the energy, relative", kSource);
  record.at_most(GetParam().name(), 1e-6, error);
}

/// At rest the tangent of the co-rotational force is K itself: u = Rᵀx − X is first order, and ∂R/∂x meets no
/// stress. Linear kinematics: anywhere.
TEST_P(Derivatives, StiffnessIsTheForcesSlope) {
  const ElasticModel model(cut_tilted_volume(), GetParam().level, soft_and_stiff(), GetParam().kind,
                           GetParam().kinematics);
  const double step = 1e-5 * model.mesh().block_size().mean();
  NodeField x = model.mesh().rest();
  if (GetParam().kinematics == Kinematics::kLinear)
    x += random_displacement(model.mesh().node_count(), 1e3 * step, 9);
  const SparseMatrix K = assemble_stiffness(model);
  double error = 0.0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const NodeField d = random_displacement(model.mesh().node_count(), 1.0, seed);
    const NodeField slope = (model.forces(x + step * d) - model.forces(x - step * d)) / (2.0 * step);
    const Eigen::VectorXd Kd = K * Eigen::Map<const Eigen::VectorXd>(d.data(), d.size());
    error = std::max(error,
                     (Eigen::Map<const Eigen::VectorXd>(slope.data(), slope.size()) + Kd).norm() / Kd.norm());
  }
  Record record("Stiffness against the slope of the force, relative", kSource);
  record.at_most(GetParam().name(), 1e-6, error);
}

PointConstraint some_constraint(const CompositeMesh& mesh) {
  PointConstraint c;
  c.at = mesh.embed(7, mesh.block_corner(mesh.element_of_voxel(7)) + 0.3 * mesh.block_size());
  c.direction = Vec3(1.0, 2.0, -1.0).normalized();
  c.stiffness = 40.0;
  c.target = c.direction.dot(c.at.apply(mesh.rest())) + 0.002;
  c.multiplier = 0.01;
  return c;
}

/// The constraint's force is minus the slope of −m g + ½ k g² with the gap g = d·x − target, and spreads over
/// the nodes as the reactions say.
TEST(Derivatives, ConstraintForceIsMinusItsEnergysSlope) {
  const ElasticModel model(cut_tilted_volume(), 1, soft_and_stiff(), ElementKind::kIncompatibleModes,
                           Kinematics::kCorotational);
  const PointConstraint c = some_constraint(model.mesh());
  const auto energy = [&](const NodeField& x) {
    const double gap = c.direction.dot(c.at.apply(x)) - c.target;
    return -c.multiplier * gap + 0.5 * c.stiffness * gap * gap;
  };
  const NodeField x = model.mesh().rest() + random_displacement(model.mesh().node_count(), 1e-3, 2);
  HeldNodes all;
  for (int n = 0; n < model.mesh().node_count(); ++n) {
    all.nodes.push_back(n);
    all.positions.push_back(x.col(n));
  }
  const std::vector<Vec3> with = reactions(model, x, Vec3::Zero(), all, {c});
  const std::vector<Vec3> without = reactions(model, x, Vec3::Zero(), all, {});
  const NodeField d = random_displacement(model.mesh().node_count(), 1.0, 4);
  double work = 0.0;
  for (int n = 0; n < model.mesh().node_count(); ++n) work += (with[n] - without[n]).dot(d.col(n));
  const double step = 1e-6;
  const double slope = (energy(x + step * d) - energy(x - step * d)) / (2.0 * step);
  Record record("Constraint force against the slope of its energy, relative", kSource);
  record.relative("penalty and multiplier, work along a random direction, N", slope, work, 1e-6);
}

/// One step must satisfy M (v' − v)/dt = f(x') + M g − α M v' − β K v' + constraints at its end; exactly so
/// for linear kinematics.
TEST(Derivatives, StepSatisfiesItsEquation) {
  const ElasticModel model(cut_tilted_volume(), 1, soft_and_stiff(), ElementKind::kIncompatibleModes,
                           Kinematics::kLinear);
  const std::vector<PointConstraint> constraints{some_constraint(model.mesh())};
  const Vec3 gravity(1.0, 2.0, -9.81);
  const double dt = 0.01;
  SolverOptions options = precise();
  Integrator integrator(options);
  ElasticState state{model.mesh().rest(), random_displacement(model.mesh().node_count(), 0.1, 1)};
  const NodeField before = state.v;
  EXPECT_TRUE(integrator.step(model, state, dt, gravity, {}, constraints).converged);
  const NodeField Kv = model.forces(state.x) - model.forces(state.x + state.v);
  NodeField residual =
      model.forces(state.x) - options.rayleigh_stiffness * Kv +
      (gravity.replicate(1, state.x.cols()) - (state.v - before) / dt - options.rayleigh_mass * state.v) *
          model.mass().asDiagonal();
  const PointConstraint& c = constraints[0];
  for (int n = 0; n < 8; ++n) residual.col(c.at.nodes[n]) += c.at.weights[n] * c.force(state.x) * c.direction;
  Record record("Equation of motion at the end of a step", "implicit Euler with Rayleigh damping");
  record.at_most("residual over the elastic forces", 1e-10, residual.norm() / model.forces(state.x).norm());
}

}  // namespace
}  // namespace cfem_cutting
