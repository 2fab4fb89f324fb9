// How many iterations an equilibrium takes must hardly depend on the mesh.

#include <gtest/gtest.h>

#include "cubes.h"

namespace cfem_cutting {
namespace {

int iterations(int across, CubeTissue tissue, double cut) {
  return count_iterations(cube_model(across, tissue, cut, 0.45));
}

TEST(Iterations, AreAlikeForUniformTissueOfAnySize) {
  const int few = iterations(10, CubeTissue::kUniform, 0.0), many = iterations(32, CubeTissue::kUniform, 0.0);
  EXPECT_GE(few, 4);
  EXPECT_LE(std::abs(iterations(20, CubeTissue::kUniform, 0.0) - few), 2);
  EXPECT_LE(std::abs(many - few), 2);
}

TEST(Iterations, GrowLittleByACutHalfwayThrough) {
  for (int across : {10, 16, 20, 32})
    EXPECT_LE(iterations(across, CubeTissue::kUniform, 0.5), iterations(20, CubeTissue::kUniform, 0.0) + 6);
}

TEST(Iterations, AtMostDoubleForLayersOfFourVoxels) {
  for (int across : {16, 32})
    EXPECT_LE(iterations(across, CubeTissue::kLayers, 0.0),
              2 * iterations(across, CubeTissue::kUniform, 0.0));
}

/// Where single precision alone leaves a residual of 1e-3.
TEST(Iterations, EndOnceStepsHaveConvergedInTissuesOfVeryDifferentStiffness) {
  for (const CubeTissue tissue : {CubeTissue::kLayers, CubeTissue::kMixture}) {
    const ElasticModel model = cube_model(32, tissue, 0.0, 0.45);
    const HeldNodes held = hold_bottom(model.mesh());
    Integrator integrator({});
    ElasticState state{model.mesh().rest(), NodeField::Zero(3, model.mesh().node_count())};
    for (int i = 0; i < 3; ++i) {
      const SolveReport report = integrator.step(model, state, 0.01, {0, 0, -9.81}, held, {});
      EXPECT_TRUE(report.converged) << report.residual;
      EXPECT_LT(report.iterations, 30);
    }
  }
}

}  // namespace
}  // namespace cfem_cutting
