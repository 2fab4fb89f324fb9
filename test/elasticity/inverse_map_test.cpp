#include "cfem_cutting/elasticity/inverse_map.h"

#include <gtest/gtest.h>

#include "specimens.h"

namespace cfem_cutting {
namespace {

NodeField bent(const NodeField& X) {
  NodeField x = X;
  for (Eigen::Index n = 0; n < X.cols(); ++n) {
    const double angle = 6.0 * X(0, n);
    x(0, n) = X(0, n) * std::cos(angle) - X(2, n) * std::sin(angle);
    x(2, n) = X(0, n) * std::sin(angle) + X(2, n) * std::cos(angle);
  }
  return x;
}

TEST(InverseMap, RoundTripInADeformedState) {
  for (int level : {0, 1, 2}) {
    VoxelVolume volume = tilted_volume({0.05, 0.04, 0.03}, 0.005);
    const CompositeMesh mesh(volume, level);
    const NodeField x = bent(mesh.rest());
    const InverseMap map(volume, mesh, x);
    int found = 0;
    for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
      if (!volume.voxel(v).linked()) continue;
      const Vec3 X = volume.centre(v);
      const auto point = map(mesh.embed(v, X).apply(x));
      ASSERT_TRUE(point);
      EXPECT_TRUE(point->inside);
      EXPECT_EQ(point->voxel, v);
      EXPECT_LT((point->X - X).norm(), 1e-12);
      ++found;
    }
    EXPECT_GT(found, 300);
  }
}

TEST(InverseMap, AirBesideTissueIsExtrapolated) {
  const VoxelVolume volume = box_volume({0.04, 0.04, 0.04}, 0.01);
  const CompositeMesh mesh(volume, 0);
  const InverseMap map(volume, mesh, mesh.rest());
  const auto above = map({0.015, 0.015, 0.045});
  ASSERT_TRUE(above);
  EXPECT_FALSE(above->inside);
  EXPECT_LT((above->X - Vec3(0.015, 0.015, 0.045)).norm(), 1e-12);
  EXPECT_EQ(above->voxel, volume.find(volume.lattice().voxel_at({0.015, 0.015, 0.035})));
  EXPECT_LT((map.forward(*above) - Vec3(0.015, 0.015, 0.045)).norm(), 1e-12);
  EXPECT_FALSE(map({0.015, 0.015, 0.0601}));
  EXPECT_FALSE(map({1.0, 1.0, 1.0}));
}

TEST(InverseMap, InsideEndsAtTheSurface) {
  const VoxelVolume volume = box_volume({0.04, 0.04, 0.04}, 0.01);
  const CompositeMesh mesh(volume, 1);
  const InverseMap map(volume, mesh, mesh.rest());
  EXPECT_TRUE(map({0.015, 0.015, 0.04 - 1e-6})->inside);
  EXPECT_TRUE(map({0.015, 0.015, 0.04})->inside);
  EXPECT_FALSE(map({0.015, 0.015, 0.04 + 1e-6})->inside);
}

/// The gap of an open cut is air, and what lies in it does not land in the tissue across.
TEST(InverseMap, OpenCutIsAir) {
  for (int level : {0, 1}) {
    VoxelVolume volume = box_volume({0.08, 0.04, 0.04}, 0.01);
    sever_plane(volume, {0.04, 0.0, 0.0}, Vec3::UnitX());
    const CompositeMesh mesh(volume, level);
    NodeField x = mesh.rest();
    const double gap = 0.006;
    for (const CompositeElement& element : mesh.elements())
      for (int node : element.nodes)
        if (element.block.x() * mesh.block_size().x() > 0.039) x(0, node) = mesh.rest()(0, node) + gap;
    const InverseMap map(volume, mesh, x);
    EXPECT_TRUE(map({0.039, 0.02, 0.02})->inside);
    EXPECT_TRUE(map({0.047, 0.02, 0.02})->inside);
    EXPECT_NEAR(map({0.047, 0.02, 0.02})->X.x(), 0.041, 1e-12);
    const auto left = map({0.041, 0.021, 0.021}), right = map({0.045, 0.021, 0.021});
    ASSERT_TRUE(left && right);
    EXPECT_FALSE(left->inside);
    EXPECT_FALSE(right->inside);
    EXPECT_NEAR(left->X.x(), 0.04, 1e-12);  // 0.041 would lie in the tissue across: drawn back
    EXPECT_NEAR(right->X.x(), 0.04, 1e-12);
    EXPECT_LT(volume.centre(left->voxel).x(), 0.04);
    EXPECT_GT(volume.centre(right->voxel).x(), 0.04);
  }
}

/// Both copies of a cut block cover the same material; each owns its own side only.
TEST(InverseMap, CopiesOfACutBlockOwnTheirSides) {
  VoxelVolume volume = box_volume({0.08, 0.04, 0.04}, 0.01);
  sever_plane(volume, {0.033, 0.0, 0.0}, Vec3::UnitX());
  const CompositeMesh mesh(volume, 2);
  const NodeField x = mesh.rest();
  const InverseMap map(volume, mesh, x);
  for (double X = 0.0005; X < 0.08; X += 0.001) {
    const auto point = map({X, 0.015, 0.015});
    ASSERT_TRUE(point);
    EXPECT_TRUE(point->inside) << X;
    EXPECT_EQ(volume.centre(point->voxel).x() < 0.033, X < 0.033) << X;
  }
}

}  // namespace
}  // namespace cfem_cutting
