#include "cfem_cutting/elasticity/composite_mesh.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "specimens.h"

namespace cfem_cutting {
namespace {

TEST(CompositeMesh, UncutBoxIsThePlainMesh) {
  const VoxelVolume volume = box_volume({4.0, 4.0, 8.0}, 1.0);
  const CompositeMesh fine(volume, 0), coarse(volume, 1);
  EXPECT_EQ(fine.elements().size(), 128u);
  EXPECT_EQ(fine.node_count(), 5 * 5 * 9);
  EXPECT_EQ(coarse.elements().size(), 16u);
  EXPECT_EQ(coarse.node_count(), 3 * 3 * 5);
}

TEST(CompositeMesh, ACutThroughABlockDuplicatesIt) {
  VoxelVolume volume = box_volume({4.0, 4.0, 4.0}, 1.0);
  sever_plane(volume, {1.0, 0.0, 0.0}, Vec3::UnitX());
  const CompositeMesh mesh(volume, 1);
  EXPECT_EQ(mesh.elements().size(), 8u + 4u);
  // Left copies alone have 2 × 3 × 3 nodes; the right copies stay in the whole mesh.
  EXPECT_EQ(mesh.node_count(), 27 + 18);
}

TEST(CompositeMesh, APartialCutKeepsTheBodyWhole) {
  VoxelVolume volume = box_volume({4.0, 4.0, 4.0}, 1.0);
  sever_plane(volume, {2.0, 0.0, 0.0}, Vec3::UnitX(), [](const Vec3& X) { return X.z() > 2.0; });
  // Between blocks, in the upper half: only the 3 nodes on top come in two.
  EXPECT_EQ(CompositeMesh(volume, 1).node_count(), 27 + 3);
}

TEST(CompositeMesh, EmbeddingReproducesLinearFields) {
  const VoxelVolume volume = tilted_volume({0.5, 0.4, 0.3}, 0.05);
  const CompositeMesh mesh(volume, 2);
  const Mat3 A = (Mat3() << 1, 2, 3, -1, 0.5, 2, 0.3, 0.1, 4).finished();
  const NodeField x = A * mesh.rest();
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    const Vec3 X = volume.centre(v) + Vec3(0.01, 0.2, -0.03);  // also far outside of the block
    EXPECT_LT((mesh.embed(v, X).apply(x) - A * X).norm(), 1e-12);
  }
}

TEST(CompositeMesh, NodesBornStemFromTheSamePlace) {
  VoxelVolume volume = tilted_volume({0.5, 0.4, 0.3}, 0.05);
  const CompositeMesh before(volume, 1);
  sever_plane(volume, {0.2, 0.2, 0.2}, Vec3(1.0, 0.4, 0.2).normalized());
  const CompositeMesh after(volume, 1);
  ASSERT_GT(after.node_count(), before.node_count());
  const std::vector<int> parent = parent_nodes(before, after);
  for (int n = 0; n < after.node_count(); ++n) EXPECT_EQ(after.rest().col(n), before.rest().col(parent[n]));
}

/// Bodies of elements that share nodes.
int count_bodies(const CompositeMesh& mesh) {
  std::vector<int> body(mesh.node_count());
  std::iota(body.begin(), body.end(), 0);
  const auto root = [&](int n) {
    while (body[n] != n) n = body[n];
    return n;
  };
  for (const CompositeElement& element : mesh.elements())
    for (int node : element.nodes) body[root(node)] = root(element.nodes[0]);
  int count = 0;
  for (int n = 0; n < mesh.node_count(); ++n) count += body[n] == n;
  return count;
}

/// The partly filled voxels of a slanted surface hold together, but not across a cut.
TEST(CompositeMesh, BodiesAreThePiecesOfTheLinks) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    VoxelVolume volume = tilted_volume({0.5, 0.4, 0.3}, 0.05);
    const Vec3 middle = volume.centre(static_cast<int>(volume.voxels().size()) / 2);
    const Vec3 normal = Vec3(any(generator), any(generator), any(generator)).normalized();
    sever_plane(volume, middle + 0.05 * any(generator) * normal, normal);
    for (int level : {0, 1, 2}) {
      const CompositeMesh mesh(volume, level);
      EXPECT_EQ(count_bodies(mesh), find_pieces(volume).count()) << "trial " << trial << ", level " << level;
    }
  }
}

/// Surface voxels beside each other share nodes: a slanted skin is no row of loose flaps.
TEST(CompositeMesh, HostedNeighboursShareNodes) {
  const VoxelVolume volume = tilted_volume({0.5, 0.4, 0.3}, 0.05);
  const CompositeMesh mesh(volume, 0);
  std::set<std::array<double, 3>> places;
  for (int n = 0; n < mesh.node_count(); ++n)
    places.insert({mesh.rest()(0, n), mesh.rest()(1, n), mesh.rest()(2, n)});
  const double apart = mesh.node_count() - static_cast<double>(places.size());
  EXPECT_LT(apart, 0.005 * mesh.node_count());  // where two meet at an edge only
}

}  // namespace
}  // namespace cfem_cutting
