#include "cfem_cutting/elasticity/integrator.h"

#include <gtest/gtest.h>

#include "specimens.h"

namespace cfem_cutting {
namespace {

HeldNodes hold_bottom(const CompositeMesh& mesh) {
  return hold_where(mesh, [](const Vec3& X) { return X.z() < 1e-9; });
}

/// Tip deflection of a clamped bar (length 10, square section of side 1) under a tip shear, over Timoshenko's
/// P L³/3EI + P L/(κ G A), κ = 5/6.
double cantilever_ratio(int across, double nu, ElementKind kind) {
  const VoxelVolume volume = box_volume({10.0, 1.0, 1.0}, 1.0 / across);
  const ElasticModel model(volume, 0, {soft(nu)}, kind, Kinematics::kLinear);
  const CompositeMesh& mesh = model.mesh();
  const HeldNodes held = hold_where(mesh, [](const Vec3& X) { return X.x() < 1e-9; });

  // Uniform shear of total 1 N: constraints without stiffness act as point forces at the voxels' face
  // centres.
  std::vector<PointConstraint> load;
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    const Vec3 X = volume.centre(v) + Vec3(0.5 / across, 0.0, 0.0);
    if (X.x() < 10.0 - 1e-9) continue;
    PointConstraint c;
    c.at = mesh.embed(v, X);
    c.direction = Vec3::UnitZ();
    c.multiplier = 1.0 / (across * across);
    load.push_back(c);
  }
  NodeField x = mesh.rest();
  Integrator integrator(precise());
  EXPECT_TRUE(integrator.equilibrate(model, x, Vec3::Zero(), held, load).converged);
  double deflection = 0.0;
  for (const PointConstraint& c : load)
    deflection += (c.at.apply(x) - c.at.apply(mesh.rest())).z() / load.size();

  const double E = soft(nu).young_modulus, G = E / (2.0 * (1.0 + nu));
  return deflection / (1000.0 / (3.0 * E / 12.0) + 10.0 / (5.0 / 6.0 * G));
}

struct CantileverCase {
  double nu;
  int across;
  double trilinear, incompatible;
};

class Cantilever : public testing::TestWithParam<CantileverCase> {};

INSTANTIATE_TEST_SUITE_P(
    Table, Cantilever,
    testing::Values(CantileverCase{0.3, 1, .643, .986}, CantileverCase{0.3, 2, .869, .987},
                    CantileverCase{0.45, 1, .514, .962}, CantileverCase{0.45, 2, .758, .965},
                    CantileverCase{0.49, 1, .407, .921}, CantileverCase{0.49, 2, .617, .948}));

TEST_P(Cantilever, AgreesWithTheTableOfCommonElements) {
  const CantileverCase c = GetParam();
  EXPECT_NEAR(cantilever_ratio(c.across, c.nu, ElementKind::kTrilinear), c.trilinear, 0.005 * c.trilinear);
  EXPECT_NEAR(cantilever_ratio(c.across, c.nu, ElementKind::kIncompatibleModes), c.incompatible, 0.01);
}

/// u(z) = ρ g (L z − z²/2) / E; trilinear nodes are exact at ν = 0.
TEST(Equilibrium, GravityColumn) {
  const ElasticModel model(box_volume({0.02, 0.02, 0.1}, 0.01), 0, {soft(0.0)}, ElementKind::kTrilinear,
                           Kinematics::kLinear);
  NodeField x = model.mesh().rest();
  Integrator integrator(precise());
  EXPECT_TRUE(integrator.equilibrate(model, x, {0, 0, -9.81}, hold_bottom(model.mesh()), {}).converged);
  for (int n = 0; n < model.mesh().node_count(); ++n) {
    const double z = model.mesh().rest()(2, n);
    EXPECT_NEAR(x(2, n) - z, -1060.0 * 9.81 * (0.1 * z - 0.5 * z * z) / 1e4, 1e-12);
  }
  EXPECT_NEAR(x.row(2).maxCoeff() - 0.1, -5.1993e-3, 1e-7);
}

/// The element-wise patch test: every node of every cut or partly filled element prescribed, the rest
/// follows.
TEST(Equilibrium, PatchTest) {
  VoxelVolume volume = tilted_volume({0.08, 0.07, 0.06}, 0.005);
  sever_plane(
      volume, volume.centre(static_cast<int>(volume.voxels().size()) / 2), Vec3(1.0, 0.4, 0.2).normalized(),
      [&](const Vec3& X) { return X.z() < volume.centre(static_cast<int>(volume.voxels().size()) / 2).z(); });
  const ElasticModel model(volume, 1, {soft(0.45)}, ElementKind::kIncompatibleModes, Kinematics::kLinear);
  const CompositeMesh& mesh = model.mesh();
  std::vector<char> prescribed(mesh.node_count(), 0);
  for (const CompositeElement& element : mesh.elements()) {
    bool whole = element.voxels.size() == 8;
    for (int v : element.voxels) whole = whole && volume.voxel(v).fill.full();
    for (int node : element.nodes) prescribed[node] |= !whole;
  }
  const Mat3 F = (Mat3() << 1.01, 0.02, -0.01, 0.005, 0.98, 0.03, 0.0, 0.01, 1.015).finished();
  HeldNodes held;
  for (int n = 0; n < mesh.node_count(); ++n) {
    if (!prescribed[n]) continue;
    held.nodes.push_back(n);
    held.positions.push_back(F * mesh.rest().col(n));
  }
  ASSERT_LT(static_cast<int>(held.nodes.size()), mesh.node_count());
  NodeField x = mesh.rest();
  Integrator integrator(precise());
  EXPECT_TRUE(integrator.equilibrate(model, x, Vec3::Zero(), held, {}).converged);
  EXPECT_LT((x - F * mesh.rest()).cwiseAbs().maxCoeff(), 1e-9 * 0.08);
  EXPECT_GT((x - mesh.rest()).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(Equilibrium, ReactionsBalanceTheWeight) {
  const ElasticModel model(tilted_volume({0.05, 0.04, 0.03}, 0.005), 1, {soft(0.45)},
                           ElementKind::kIncompatibleModes, Kinematics::kCorotational);
  const double floor = model.mesh().rest().row(2).minCoeff() + 0.011;
  const HeldNodes held = hold_where(model.mesh(), [&](const Vec3& X) { return X.z() < floor; });
  NodeField x = model.mesh().rest();
  SolverOptions options = precise();
  options.tolerance = 1e-9;
  Integrator integrator(options);
  const Vec3 gravity(0, 0, -9.81);
  EXPECT_TRUE(integrator.equilibrate(model, x, gravity, held, {}, 60).converged);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& reaction : reactions(model, x, gravity, held, {})) sum += reaction;
  EXPECT_LT((sum + model.total_mass() * gravity).norm(), 1e-8 * model.total_mass() * 9.81);
}

TEST(Equilibrium, ReturnsAtOnceWhereItAlreadyIs) {
  const ElasticModel model(box_volume({0.04, 0.04, 0.04}, 0.01), 0, {soft(0.45)},
                           ElementKind::kIncompatibleModes, Kinematics::kCorotational);
  const HeldNodes held = hold_bottom(model.mesh());
  NodeField x = model.mesh().rest();
  Integrator integrator{SolverOptions()};
  EXPECT_TRUE(integrator.equilibrate(model, x, {0, 0, -9.81}, held, {}).converged);
  const NodeField settled = x;
  EXPECT_EQ(integrator.equilibrate(model, x, {0, 0, -9.81}, held, {}).iterations, 0);
  EXPECT_EQ(x, settled);
}

// The tangent leaves out how forces turn with the rotations: by it alone steps gain less and less.
TEST(Equilibrium, LongThinBarIsFoundInFewSteps) {
  const VoxelVolume volume = box_volume({0.16, 0.02, 0.02}, 0.005);
  const ElasticModel model(volume, 0, {soft(0.3)}, ElementKind::kIncompatibleModes,
                           Kinematics::kCorotational);
  const HeldNodes held = hold_where(model.mesh(), [](const Vec3& X) { return X.x() < 1e-9; });
  NodeField x = model.mesh().rest();
  Integrator integrator(precise());
  EXPECT_TRUE(integrator.equilibrate(model, x, {0, 0, -1.0}, held, {}, 60).converged);
}

TEST(Equilibrium, FloatingPieceStays) {
  VoxelVolume volume = box_volume({0.04, 0.04, 0.04}, 0.01);
  sever_plane(volume, {0.0, 0.0, 0.02}, Vec3::UnitZ());
  const ElasticModel model(volume, 0, {soft(0.45)}, ElementKind::kIncompatibleModes,
                           Kinematics::kCorotational);
  NodeField x = model.mesh().rest();
  Integrator integrator{SolverOptions()};
  EXPECT_TRUE(integrator.equilibrate(model, x, {0, 0, -9.81}, hold_bottom(model.mesh()), {}).converged);
  const int top = model.mesh()
                      .elements()[model.mesh().element_of_voxel(static_cast<int>(volume.voxels().size()) - 1)]
                      .nodes[7];
  EXPECT_LT((x.col(top) - model.mesh().rest().col(top)).norm(), 1e-9);
}

/// Links severed on a mid-plane equal two bodies meshed apart.
TEST(Equilibrium, SeveredMidPlaneIsTwoBodies) {
  VoxelVolume cut = box_volume({0.08, 0.04, 0.04}, 0.01);
  sever_plane(cut, {0.04, 0.0, 0.0}, Vec3::UnitX());
  const ElasticModel both(cut, 1, {soft(0.45)}, ElementKind::kIncompatibleModes, Kinematics::kCorotational);
  const ElasticModel alone(box_volume({0.04, 0.04, 0.04}, 0.01), 1, {soft(0.45)},
                           ElementKind::kIncompatibleModes, Kinematics::kCorotational);
  Integrator integrator(precise());
  const Vec3 gravity(1.0, 2.0, -9.81);
  NodeField x = both.mesh().rest(), y = alone.mesh().rest();
  EXPECT_TRUE(integrator.equilibrate(both, x, gravity, hold_bottom(both.mesh()), {}, 60).converged);
  EXPECT_TRUE(integrator.equilibrate(alone, y, gravity, hold_bottom(alone.mesh()), {}, 60).converged);
  const int a = both.mesh().element_of_voxel(cut.find(cut.lattice().voxel_at({0.035, 0.035, 0.035})));
  const VoxelVolume small = box_volume({0.04, 0.04, 0.04}, 0.01);
  const int b = alone.mesh().element_of_voxel(small.find(small.lattice().voxel_at({0.035, 0.035, 0.035})));
  for (int n = 0; n < 8; ++n)
    EXPECT_LT((x.col(both.mesh().elements()[a].nodes[n]) - y.col(alone.mesh().elements()[b].nodes[n])).norm(),
              1e-6 * 0.04);
}

TEST(Step, FreeBodyKeepsItsMomentum) {
  const ElasticModel model(tilted_volume({0.05, 0.04, 0.03}, 0.005), 1, {soft(0.45)},
                           ElementKind::kIncompatibleModes, Kinematics::kCorotational);
  SolverOptions options = precise();
  options.rayleigh_mass = 0.0;
  Integrator integrator(options);
  ElasticState state{model.mesh().rest(), random_displacement(model.mesh().node_count(), 0.2, 1)};
  state.v.colwise() += Vec3(0.1, 0.3, -0.2);
  const Vec3 before = state.v * model.mass();
  for (int i = 0; i < 10; ++i)
    EXPECT_TRUE(integrator.step(model, state, 0.005, Vec3::Zero(), {}, {}).converged);
  EXPECT_LT((state.v * model.mass() - before).norm(), 1e-10 * before.norm());
}

/// Without forces between them, v falls as 1/(1 + α dt) a step; gravity adds dt g.
TEST(Step, FreeFallOfARigidState) {
  const ElasticModel model(box_volume({0.02, 0.02, 0.02}, 0.01), 0, {soft(0.3)}, ElementKind::kTrilinear,
                           Kinematics::kCorotational);
  SolverOptions options = precise();
  options.rayleigh_mass = 0.5;
  Integrator integrator(options);
  ElasticState state{model.mesh().rest(), NodeField::Zero(3, model.mesh().node_count())};
  integrator.step(model, state, 0.01, {0, 0, -9.81}, {}, {});
  EXPECT_NEAR(state.v(2, 0), -0.0981 / 1.005, 1e-12);
  EXPECT_NEAR(state.v(2, 5), -0.0981 / 1.005, 1e-12);
}

TEST(Step, TurnedTissueWithoutLoadIsSolved) {
  const VoxelVolume volume = tilted_volume({0.06, 0.05, 0.04}, 0.01);
  const ElasticModel model(volume, 0, {soft(0.45)}, ElementKind::kIncompatibleModes,
                           Kinematics::kCorotational);
  const Mat3 R = Eigen::AngleAxisd(1.9, Vec3(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  const NodeField turned = (R * model.mesh().rest()).colwise() + Vec3(3.0, -2.0, 5.0);
  ElasticState state{turned, NodeField::Zero(3, turned.cols())};
  SolverOptions options;
  options.tolerance = 1e-8;
  Integrator integrator(options);
  for (int i = 0; i < 3; ++i)
    EXPECT_TRUE(integrator.step(model, state, 0.01, Vec3::Zero(), {}, {}).converged) << i;
  EXPECT_LT((state.x - turned).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(Step, SettlesInEquilibrium) {
  const ElasticModel model(box_volume({0.04, 0.04, 0.04}, 0.01), 0, {soft(0.45)},
                           ElementKind::kIncompatibleModes, Kinematics::kCorotational);
  const HeldNodes held = hold_bottom(model.mesh());
  Integrator integrator(precise());
  NodeField x = model.mesh().rest();
  EXPECT_TRUE(integrator.equilibrate(model, x, {0, 2.0, -9.81}, held, {}, 60).converged);
  ElasticState state{model.mesh().rest(), NodeField::Zero(3, model.mesh().node_count())};
  for (int i = 0; i < 150; ++i) integrator.step(model, state, 0.05, {0, 2.0, -9.81}, held, {});
  EXPECT_LT((state.x - x).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT((x - model.mesh().rest()).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(Step, HeldNodesArriveAndConstraintsPull) {
  const ElasticModel model(box_volume({0.04, 0.04, 0.04}, 0.01), 0, {soft(0.45)},
                           ElementKind::kIncompatibleModes, Kinematics::kCorotational);
  HeldNodes held = hold_bottom(model.mesh());
  for (Vec3& position : held.positions) position += Vec3(0.001, 0.0, 0.0);
  PointConstraint c;
  c.at = model.mesh().embed(63, {0.035, 0.035, 0.04});
  c.direction = Vec3::UnitZ();
  c.target = 0.038;
  c.stiffness = 1e6;
  Integrator integrator{SolverOptions()};
  ElasticState state{model.mesh().rest(), NodeField::Zero(3, model.mesh().node_count())};
  for (int i = 0; i < 20; ++i)
    EXPECT_TRUE(integrator.step(model, state, 0.01, Vec3::Zero(), held, {c}).converged);
  for (std::size_t i = 0; i < held.nodes.size(); ++i)
    EXPECT_LT((state.x.col(held.nodes[i]) - held.positions[i]).norm(), 1e-15);
  EXPECT_NEAR(c.at.apply(state.x).z(), 0.038, 1e-5);
  EXPECT_LT(c.force(state.x), 0.0);
}

TEST(Step, SameBitsForAnyNumberOfThreads) {
  // Large enough for three parts of everything that is done in parts.
  const ElasticModel model(box_volume({0.24, 0.24, 0.24}, 0.01), 0, {soft(0.45)},
                           ElementKind::kIncompatibleModes, Kinematics::kCorotational);
  const HeldNodes held = hold_bottom(model.mesh());
  std::vector<NodeField> results;
  for (int threads : {1, 2, 3}) {
    SolverOptions options;
    options.threads = threads;
    Integrator integrator(options);
    ElasticState state{model.mesh().rest(), random_displacement(model.mesh().node_count(), 0.1, 2)};
    for (int i = 0; i < 4; ++i) integrator.step(model, state, 0.01, {0, 0, -9.81}, held, {});
    results.push_back(state.x);
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

TEST(Step, SinglePrecisionAgreesWithDouble) {
  const ElasticModel model(tilted_volume({0.05, 0.04, 0.03}, 0.005), 1, {soft(0.45)},
                           ElementKind::kIncompatibleModes, Kinematics::kCorotational);
  SolverOptions options;
  options.max_iterations = 1000;
  options.tolerance = 1e-5;  // the tightest in single precision
  Integrator single(options), twice(precise());
  ElasticState a{model.mesh().rest(), random_displacement(model.mesh().node_count(), 0.2, 1)}, b = a;
  EXPECT_TRUE(single.step(model, a, 0.01, Vec3::Zero(), {}, {}).converged);
  EXPECT_TRUE(twice.step(model, b, 0.01, Vec3::Zero(), {}, {}).converged);
  EXPECT_LT((a.x - b.x).norm(), 2e-3 * (b.x - model.mesh().rest()).norm());
  EXPECT_GT((a.x - b.x).norm(), 0.0);
}

}  // namespace
}  // namespace cfem_cutting
