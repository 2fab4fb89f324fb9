#include "cfem_cutting/cutting/fracture.h"

#include <gtest/gtest.h>

#include "elasticity/specimens.h"

namespace cfem_cutting {
namespace {

constexpr double kBlock = 0.004;

Candidate candidate(int voxel, double offset, double passed_by = 0.0) {
  Candidate c;
  c.crossing = {{voxel, 0}, {Vec3::Zero(), Vec3::UnitX()}};
  c.offset = offset;
  c.passed_by = passed_by;
  c.front_distance = 0.0;
  return c;
}

TEST(Fracture, WaitsUpToTheOnset) {
  const Fracture fracture = decide({}, {candidate(0, 0.003), candidate(1, 0.002)}, 0.003, kBlock);
  EXPECT_FALSE(fracture.happens);
  EXPECT_TRUE(fracture.severed.empty());
  EXPECT_EQ(fracture.waiting.size(), 2u);
}

TEST(Fracture, BeyondTheOnsetSeversAboveTheRelease) {
  const Fracture fracture =
      decide({}, {candidate(0, 0.0031), candidate(1, 0.0011), candidate(2, 0.001)}, 0.0, kBlock);
  EXPECT_TRUE(fracture.happens);
  ASSERT_EQ(fracture.severed.size(), 2u);
  ASSERT_EQ(fracture.waiting.size(), 1u);
  EXPECT_EQ(fracture.waiting[0].crossing.link.voxel, 2);
}

TEST(Fracture, ContactAloneReachesTheOnset) {
  EXPECT_TRUE(decide({}, {}, 0.0031, kBlock).happens);
  EXPECT_EQ(decide({}, {candidate(0, 0.002)}, 0.0031, kBlock).severed.size(), 1u);
}

TEST(Fracture, LinksLeftBehindAreSeveredAlone) {
  const std::vector<Candidate> candidates{candidate(0, 0.0, 0.0081), candidate(1, 0.002, 0.0079)};
  const Fracture fracture = decide({}, candidates, 0.0, kBlock);
  EXPECT_TRUE(fracture.happens);
  ASSERT_EQ(fracture.severed.size(), 1u);
  EXPECT_EQ(fracture.severed[0].link.voxel, 0);
  EXPECT_FALSE(fracture.advances);
  EXPECT_TRUE(decide({}, candidates, 0.0031, kBlock).advances);
  EXPECT_FALSE(decide({}, candidates, 0.0, 2.0 * kBlock).happens);
  EXPECT_FALSE(decide({FractureMode::kDelayed, 0.01, 0.001}, candidates, 0.0, kBlock).happens);
}

TEST(Fracture, ImmediateModeSeversAllAtOnce) {
  FractureOptions options;
  options.mode = FractureMode::kImmediate;
  EXPECT_EQ(decide(options, {candidate(0, 0.0), candidate(1, 0.0)}, 0.0, kBlock).severed.size(), 2u);
  EXPECT_FALSE(decide(options, {}, 1.0, kBlock).happens);
}

TEST(Fracture, SteadyLoadMakesASaw) {
  double offset = 0.0;
  int fractures = 0;
  for (int step = 0; step < 100; ++step) {
    offset += 0.0004;
    if (!decide({}, {candidate(step, offset)}, 0.0, kBlock).happens) continue;
    ++fractures;
    offset = 0.0;
  }
  EXPECT_EQ(fractures, 100 / 8);  // the first multiple of 0.4 mm above 3 mm is the eighth
}

Pose far_away() {
  Pose pose = Pose::Identity();
  pose.translate(Vec3(0.4, -0.3, 2.0));
  pose.rotate(Eigen::AngleAxisd(2.5, Vec3(1.0, 2.0, 3.0).normalized()));
  return pose;
}

std::vector<char> all_float(const CompositeMesh& mesh) { return std::vector<char>(mesh.node_count(), 1); }

/// A bar, severed across so that it falls into a long piece and a short one of a single element.
struct Bar {
  VoxelVolume volume = box_volume({0.064, 0.016, 0.016}, 0.004);
  Bar() { sever_plane(volume, {0.0481, 0.0, 0.0}, Vec3::UnitX()); }
};

TEST(OffsetField, EachPieceMayMoveRigidly) {
  const Bar bar;
  const CompositeMesh mesh(bar.volume, 2);
  const Pieces pieces = find_pieces(bar.volume);
  ASSERT_EQ(pieces.count(), 2);
  NodeField moved = mesh.rest();
  for (const CompositeElement& element : mesh.elements()) {
    if (pieces.piece_of_voxel[element.voxels.front()] == 0) continue;
    for (const int node : element.nodes) moved.col(node) = far_away() * Vec3(mesh.rest().col(node));
  }
  const OffsetField offsets(bar.volume, pieces, mesh, all_float(mesh), mesh.rest(), moved);
  for (int v = 0; v < static_cast<int>(bar.volume.voxels().size()); ++v)
    EXPECT_NEAR(offsets.offset(v, bar.volume.centre(v)), 0.0, 1e-12);
}

TEST(OffsetField, RigidMotionAddsNothingToADent) {
  const VoxelVolume volume = box_volume({0.032, 0.016, 0.016}, 0.004);
  const CompositeMesh mesh(volume, 1);
  const Pieces pieces = find_pieces(volume);
  NodeField dented = mesh.rest() + random_displacement(mesh.node_count(), 0.001, 5);
  NodeField moved = dented;
  for (int n = 0; n < mesh.node_count(); ++n) moved.col(n) = far_away() * Vec3(dented.col(n));
  const OffsetField still(volume, pieces, mesh, all_float(mesh), mesh.rest(), dented);
  const OffsetField drifting(volume, pieces, mesh, all_float(mesh), mesh.rest(), moved);
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    const Vec3 X = volume.centre(v);
    EXPECT_NEAR(still.offset(v, X), drifting.offset(v, X), 1e-12);
    EXPECT_LT(still.offset(v, X), 0.003);
  }
}

TEST(OffsetField, MotionOfAHeldPieceCounts) {
  const VoxelVolume volume = box_volume({0.032, 0.016, 0.016}, 0.004);
  const CompositeMesh mesh(volume, 1);
  const Pieces pieces = find_pieces(volume);
  const Vec3 way(0.003, 0.0, 0.004);
  const NodeField moved = mesh.rest().colwise() + way;
  const std::vector<char> held(mesh.node_count(), 0);
  const OffsetField offsets(volume, pieces, mesh, held, mesh.rest(), moved);
  EXPECT_NEAR(offsets.offset(7, volume.centre(7)), 0.005, 1e-12);
  EXPECT_NEAR(offsets.offset_at(7, volume.centre(7), volume.centre(7) + 2.0 * way), 0.01, 1e-12);
}

}  // namespace
}  // namespace cfem_cutting
