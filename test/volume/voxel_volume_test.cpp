#include "cfem_cutting/volume/voxel_volume.h"

#include <gtest/gtest.h>

#include <numeric>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/volume/link_way.h"
#include "cfem_cutting/volume/shapes.h"

namespace cfem_cutting {
namespace {

const Vec3 kSpacing = Vec3::Constant(0.004);

double total_volume(const VoxelVolume& volume) {
  double total = 0.0;
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) total += volume.filled_volume(v);
  return total;
}

Pose tilted() {
  Pose X_TS = Pose::Identity();
  X_TS.translate(Vec3(0.01, -0.02, 0.03));
  X_TS.rotate(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -0.5).normalized()));
  return X_TS;
}

/// Severs all links from voxel layer `layer` to the next one along x; returns how many were intact.
int sever_plane(VoxelVolume& volume, int layer) {
  int severed = 0;
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    const Voxel& voxel = volume.voxel(v);
    if (!voxel.linked() || voxel.index.x() != layer || voxel.neighbour[1] < 0) continue;
    severed += volume.sever({v, 0}, {volume.centre(v) + Vec3(0.001, 0.0, 0.0), Vec3(-2.0, 0.0, 0.0)});
  }
  return severed;
}

TEST(LinkWay, JoinsOverIntactLinksOnly) {
  VoxelVolume volume = VoxelVolume::sample(*make_box({0.016, 0.016, 0.016}, Pose::Identity()), kSpacing);
  const auto at = [&](int i, int j, int k) { return volume.find({i, j, k}); };
  EXPECT_TRUE(are_joined(volume, at(1, 1, 1), at(2, 2, 2), LinkKind::kIntact));
  EXPECT_FALSE(are_joined(volume, at(1, 1, 1), at(3, 3, 1), LinkKind::kIntact));  // four steps
  sever_plane(volume, 1);
  EXPECT_FALSE(are_joined(volume, at(1, 1, 1), at(2, 2, 1), LinkKind::kIntact));
  EXPECT_TRUE(are_joined(volume, at(1, 1, 1), at(2, 2, 1), LinkKind::kAny));
  EXPECT_TRUE(are_joined(volume, at(2, 1, 1), at(3, 2, 2), LinkKind::kIntact));
  EXPECT_TRUE(are_parted(volume, at(1, 1, 1), at(2, 2, 1)));
  EXPECT_FALSE(are_parted(volume, at(2, 1, 1), at(3, 2, 2)));
  EXPECT_FALSE(are_parted(volume, at(0, 0, 0), at(3, 3, 1)));  // too far to tell
}

TEST(VoxelVolume, AlignedBoxIsExact) {
  const auto box = make_box({0.04, 0.024, 0.016}, Pose::Identity());
  const VoxelVolume volume = VoxelVolume::sample(*box, kSpacing);
  EXPECT_EQ(volume.voxels().size(), 10u * 6u * 4u);
  EXPECT_EQ(volume.link_count(), 9 * 6 * 4 + 10 * 5 * 4 + 10 * 6 * 3);
  EXPECT_NEAR(total_volume(volume), box->volume(), 1e-15);
  EXPECT_EQ(volume.dropped_volume(), 0.0);
  EXPECT_TRUE(volume.lattice().origin.isApprox(-kSpacing));
  EXPECT_EQ(volume.lattice().size, Vec3i(12, 8, 6));
}

TEST(VoxelVolume, TiltedBoxKeepsItsVolume) {
  const auto box = make_box({0.1, 0.06, 0.04}, tilted());
  const VoxelVolume volume = VoxelVolume::sample(*box, kSpacing);
  EXPECT_NEAR(total_volume(volume) / box->volume(), 1.0, 0.005);
  EXPECT_LT(volume.dropped_volume(), 1e-3 * box->volume());
}

TEST(VoxelVolume, VoxelsAreSortedAndFound) {
  const auto box = make_box({0.05, 0.03, 0.03}, tilted());
  const VoxelVolume volume = VoxelVolume::sample(*box, {0.003, 0.004, 0.005});
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    EXPECT_EQ(volume.find(volume.voxel(v).index), v);
    if (v > 0) {
      EXPECT_LT(volume.lattice().index(volume.voxel(v - 1).index),
                volume.lattice().index(volume.voxel(v).index));
    }
  }
  EXPECT_EQ(volume.find({-1, 0, 0}), -1);
  EXPECT_EQ(volume.find(volume.lattice().size), -1);
}

TEST(VoxelVolume, CentresDecideWhichVoxelsAreLinkedAndHostsAreLinked) {
  const auto box = make_box({0.1, 0.06, 0.04}, tilted());
  const VoxelVolume volume = VoxelVolume::sample(*box, kSpacing);
  int unlinked = 0;
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    const Voxel& voxel = volume.voxel(v);
    const Vec3 centre = volume.centre(v);
    EXPECT_EQ(voxel.linked(), box->labels_along_z(centre.x(), centre.y(), {centre.z()})[0] >= 0);
    EXPECT_NE(voxel.fill.mask, 0u);
    if (voxel.linked()) continue;
    ++unlinked;
    ASSERT_LT(voxel.host, static_cast<int>(volume.voxels().size()));
    const Voxel& host = volume.voxel(voxel.host);
    EXPECT_TRUE(host.linked());
    EXPECT_LE((host.index - voxel.index).cwiseAbs().maxCoeff(), 1);
  }
  EXPECT_GT(unlinked, 100);
}

TEST(VoxelVolume, HostIsTheBestFilledFaceNeighbour) {
  const auto box = make_box({0.1, 0.06, 0.04}, tilted());
  const VoxelVolume volume = VoxelVolume::sample(*box, kSpacing);
  for (const Voxel& voxel : volume.voxels()) {
    if (voxel.linked()) continue;
    for (const int neighbour : voxel.neighbour) {
      if (neighbour < 0) continue;
      EXPECT_LE(volume.voxel(neighbour).fill.fraction(), volume.voxel(voxel.host).fill.fraction());
      EXPECT_EQ((volume.voxel(voxel.host).index - voxel.index).cwiseAbs().sum(), 1);
    }
  }
}

TEST(VoxelVolume, SurfaceCrossingsLieOnTheBox) {
  const auto box = make_box({0.041, 0.029, 0.021}, Pose::Identity());
  const VoxelVolume volume = VoxelVolume::sample(*box, kSpacing);
  int crossings = 0;
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    const Voxel& voxel = volume.voxel(v);
    for (int direction = 0; voxel.linked() && direction < kDirections; ++direction) {
      if (voxel.link[direction] != LinkState::kSurface) continue;
      ++crossings;
      const int axis = direction / 2;
      const double face = direction % 2 ? Vec3(0.041, 0.029, 0.021)[axis] : 0.0;
      EXPECT_NEAR(volume.crossing(v, direction).point[axis], face, 1e-12);
      EXPECT_TRUE(volume.crossing(v, direction).normal.isApprox(step(direction).cast<double>()));
    }
  }
  EXPECT_EQ(crossings, 2 * (10 * 7 + 7 * 5 + 10 * 5));
}

TEST(VoxelVolume, SeveredPlaneLeavesTwoPieces) {
  const auto box = make_box({0.04, 0.024, 0.016}, Pose::Identity());
  VoxelVolume volume = VoxelVolume::sample(*box, kSpacing);
  EXPECT_EQ(find_pieces(volume).count(), 1);
  EXPECT_EQ(sever_plane(volume, 3), 6 * 4);
  EXPECT_EQ(sever_plane(volume, 3), 0);
  EXPECT_EQ(volume.severed_count(), 6 * 4);

  const Pieces pieces = find_pieces(volume);
  ASSERT_EQ(pieces.count(), 2);
  EXPECT_NEAR(pieces.volumes[0], 0.7 * box->volume(), 1e-15);
  EXPECT_NEAR(pieces.volumes[1], 0.3 * box->volume(), 1e-15);
  EXPECT_EQ(pieces.piece_of_voxel[volume.find({1, 1, 1})], 1);
  EXPECT_EQ(pieces.piece_of_voxel[volume.find({9, 1, 1})], 0);
}

TEST(VoxelVolume, OneIntactLinkKeepsOnePiece) {
  const auto box = make_box({0.04, 0.024, 0.016}, Pose::Identity());
  VoxelVolume volume = VoxelVolume::sample(*box, kSpacing);
  const int kept = volume.find({3, 2, 2});
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v)
    if (volume.voxel(v).index.x() == 3 && v != kept) volume.sever({v, 0}, {volume.centre(v), Vec3::UnitX()});
  EXPECT_EQ(find_pieces(volume).count(), 1);
}

TEST(VoxelVolume, PiecesOfATiltedBoxAddUpToAllVoxels) {
  const auto box = make_box({0.1, 0.06, 0.04}, tilted());
  VoxelVolume volume = VoxelVolume::sample(*box, kSpacing);
  sever_plane(volume, volume.lattice().size.x() / 2);
  const Pieces pieces = find_pieces(volume);
  EXPECT_EQ(pieces.count(), 2);
  EXPECT_NEAR(std::accumulate(pieces.volumes.begin(), pieces.volumes.end(), 0.0), total_volume(volume),
              1e-15);
  for (std::size_t v = 0; v < volume.voxels().size(); ++v) {
    if (volume.voxels()[v].linked()) continue;
    EXPECT_EQ(pieces.piece_of_voxel[v], pieces.piece_of_voxel[volume.voxels()[v].host]);
  }
}

TEST(VoxelVolume, SeverKeepsTheCrossingOnItsLinkAndOrientsNormals) {
  const auto box = make_box({0.04, 0.024, 0.016}, Pose::Identity());
  VoxelVolume volume = VoxelVolume::sample(*box, kSpacing);
  const int lower = volume.find({3, 3, 3}), upper = volume.find({3, 4, 3});
  const Vec3 off_axis = volume.centre(lower) + Vec3(0.001, 0.0039999, -0.001);
  EXPECT_TRUE(volume.sever({lower, 1}, {off_axis, Vec3(3.0, -4.0, 0.0)}));
  EXPECT_FALSE(volume.sever({lower, 1}, {volume.centre(lower), Vec3::UnitY()}));

  const SurfacePoint& from_lower = volume.crossing(lower, 3);
  const SurfacePoint& from_upper = volume.crossing(upper, 2);
  EXPECT_TRUE(from_lower.point.isApprox(volume.centre(lower) + Vec3(0.0, 0.98 * 0.004, 0.0), 1e-12));
  EXPECT_EQ(from_lower.point, from_upper.point);
  EXPECT_TRUE(from_lower.normal.isApprox(Vec3(-0.6, 0.8, 0.0)));
  EXPECT_TRUE(from_upper.normal.isApprox(Vec3(0.6, -0.8, 0.0)));
  EXPECT_EQ(volume.severed_links(), (std::vector<LinkId>{{lower, 1}}));
  EXPECT_EQ(volume.voxel(upper).link[2], LinkState::kSevered);
}

TEST(VoxelVolume, NormalSquareToItsLinkGetsAFixedSign) {
  const auto box = make_box({0.04, 0.024, 0.016}, Pose::Identity());
  VoxelVolume volume = VoxelVolume::sample(*box, kSpacing);
  const int a = volume.find({3, 3, 3}), b = volume.find({3, 4, 3});
  volume.sever({a, 0}, {volume.centre(a), Vec3(0.0, -1.0, 0.0)});
  volume.sever({b, 0}, {volume.centre(b), Vec3(0.0, 1.0, 0.0)});
  EXPECT_EQ(volume.crossing(a, 1).normal, volume.crossing(b, 1).normal);
}

TEST(VoxelVolume, RefusesTooManyVoxelsBeforeAllocating) {
  const auto box = make_box({1.0, 1.0, 1.0}, Pose::Identity());
  try {
    VoxelVolume::sample(*box, Vec3::Constant(0.001));
    FAIL() << "sampled 1e9 voxels";
  } catch (const GeometryError& error) {
    EXPECT_STREQ(error.what(),
                 "1006012008 voxels: more than 20000000; raise tissue.voxel_size, or check tissue.scale");
  }
}

TEST(VoxelVolume, RefusesTissueThatHoldsNoVoxelCentre) {
  const auto thin = make_box({0.1, 0.1, 0.001}, Pose::Identity());
  EXPECT_THROW(VoxelVolume::sample(*thin, kSpacing), GeometryError);
}

TEST(VoxelVolume, SheetThinnerThanTheSamplesStillHasMass) {
  Pose at_centres = Pose::Identity();
  at_centres.translate(Vec3(0.0, 0.0, 0.0018));
  const auto sheet = make_box({0.02, 0.02, 0.0004}, at_centres);
  const VoxelVolume volume = VoxelVolume::sample(*sheet, kSpacing);
  EXPECT_EQ(volume.voxels().size(), 25u);
  for (const Voxel& voxel : volume.voxels()) EXPECT_EQ(voxel.fill.fraction(), 0.125);
}

}  // namespace
}  // namespace cfem_cutting
