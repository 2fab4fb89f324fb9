// Tissue comes back from any state.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "cfem_cutting/elasticity/integrator.h"
#include "specimens.h"

namespace cfem_cutting {
namespace {

const Material kGelatine{-1, 14800.0, 0.475, 1000.0};

/// A ruined block: stretched to twice its length along an axis, crushed to a tenth along another, and every
/// node moved at random by up to a block's edge, which turns elements inside out.
NodeField ruin(const NodeField& rest, double edge, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  NodeField x = rest;
  const int stretched = static_cast<int>(random() % 3),
            crushed = (stretched + 1 + static_cast<int>(random() % 2)) % 3;
  x.row(stretched) *= 2.0;
  x.row(crushed) *= 0.1;
  for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] += edge * uniform(random);
  return x;
}

/// Largest distance from the rest shape, best fitted by a rigid motion, m.
double distance_from_rest(const NodeField& x, const NodeField& rest) {
  const Eigen::Matrix4d motion = Eigen::umeyama(rest, x, false);
  const NodeField fitted =
      (motion.topLeftCorner<3, 3>() * rest).colwise() + Vec3(motion.topRightCorner<3, 1>());
  return (x - fitted).colwise().norm().maxCoeff();
}

TEST(Recovery, FromTwoHundredRuinedStates) {
  const double edge = 0.01;
  const ElasticModel model(box_volume({0.04, 0.03, 0.03}, edge), 0, {kGelatine},
                           ElementKind::kIncompatibleModes, Kinematics::kCorotational);
  SolverOptions options;
  options.threads = 1;
  options.rayleigh_mass = 10.0;  // 1/s: against spinning on for ever
  for (unsigned seed = 0; seed < 200; ++seed) {
    Integrator integrator(options);
    ElasticState state{ruin(model.mesh().rest(), edge, seed), NodeField::Zero(3, model.mesh().node_count())};
    ASSERT_GT(model.respond(state.x).inverted, 0);
    for (int step = 0; step < 200; ++step) integrator.step(model, state, 0.01, Vec3::Zero(), {}, {});
    ASSERT_TRUE(state.x.allFinite()) << "seed " << seed;
    EXPECT_LT(distance_from_rest(state.x, model.mesh().rest()), 1e-3 * edge) << "seed " << seed;
  }
}

TEST(Recovery, OfEquilibriaFromSixtyRuinedStates) {
  const double edge = 0.01;
  const ElasticModel model(box_volume({0.04, 0.03, 0.03}, edge), 0, {kGelatine},
                           ElementKind::kIncompatibleModes, Kinematics::kCorotational);
  const HeldNodes held = hold_where(model.mesh(), [](const Vec3& X) { return X.z() <= 1e-9; });
  SolverOptions options;
  options.threads = 1;
  options.tolerance = 1e-3;
  Integrator integrator(options);
  NodeField expected = model.mesh().rest();
  ASSERT_TRUE(integrator.equilibrate(model, expected, {0, 0, -9.81}, held, {}).converged);
  for (unsigned seed = 0; seed < 60; ++seed) {
    NodeField x = ruin(model.mesh().rest(), 0.5 * edge, seed);
    for (std::size_t i = 0; i < held.nodes.size(); ++i) x.col(held.nodes[i]) = held.positions[i];
    ASSERT_GT(model.respond(x).inverted, 0);
    EXPECT_TRUE(integrator.equilibrate(model, x, {0, 0, -9.81}, held, {}).converged) << "seed " << seed;
  }
}

}  // namespace
}  // namespace cfem_cutting
