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

}  // namespace
}  // namespace cfem_cutting
