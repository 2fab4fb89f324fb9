#include <algorithm>
#include <cmath>
#include <random>

#include "cfem_cutting/geometry/self_crossings.h"
#include "surface/ball.h"
#include "surface/tissue.h"

namespace cfem_cutting {
namespace {

using test::Ball;
using test::box_volume;
using test::expect_closed_and_manifold;
using test::Plane;
using test::sever;

TriangleMesh contour(const VoxelVolume& volume) { return SurfaceExtractor(volume).extract({}).rest(); }

TEST(Contouring, box_is_exact) {
  const SurfaceQuality quality = assess(contour(box_volume({4, 5, 6})));
  EXPECT_TRUE(quality.defects.closed());
  EXPECT_TRUE(quality.defects.manifold());
  EXPECT_NEAR(quality.volume, 120.0, 1e-9);
  EXPECT_EQ(quality.degenerate, 0);
  EXPECT_EQ(quality.needles, 0);
}

TEST(Contouring, ball_keeps_its_volume) {
  for (const double radius : {6.3, 10.1}) {
    const Ball ball(radius);
    const TriangleMesh mesh = contour(VoxelVolume::sample(ball, Vec3(1.0, 1.0, 1.25)));
    expect_closed_and_manifold(mesh, "ball");
    EXPECT_NEAR(enclosed_volume(mesh), ball.volume(), 0.01 * ball.volume());
    // Tangent planes a cell apart meet this far off the ball: half a cell's diagonal, squared, over its
    // radius.
    const double off = 0.25 * (1.0 + 1.0 + 1.25 * 1.25) / radius;
    for (const Vec3& X : mesh.vertices) EXPECT_NEAR(X.norm(), radius, off);
  }
}

/// How far the volume moved crossings off the plane, as it keeps them off voxel centres.
double crossings_off(const VoxelVolume& volume, const Plane& cut) {
  double off = 0.0;
  for (const LinkId& link : volume.severed_links())
    off = std::max(off, std::abs(cut.height(volume.crossing(link.voxel, 2 * link.axis + 1).point)));
  return off;
}

class PlanarCut : public testing::TestWithParam<Plane> {};

TEST_P(PlanarCut, lies_on_the_plane_and_keeps_the_volume) {
  VoxelVolume volume = box_volume({8, 7, 6});
  sever(volume, GetParam());
  SurfaceExtractor extractor(volume);
  const TissueSurface& surface = extractor.extract({});
  expect_closed_and_manifold(surface.rest(), "planar cut");
  EXPECT_NEAR(enclosed_volume(surface.rest()), 8 * 7 * 6, 0.01 * 8 * 7 * 6);
  const double off = crossings_off(volume, GetParam());
  EXPECT_LE(off, 0.02 + 1e-9);
  const Box inside(Vec3::Constant(1.0), Vec3(7, 6, 5));
  int cut_triangles = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (!surface.cut[t]) continue;
    ++cut_triangles;
    for (const int v : surface.triangles[t]) {
      const Vec3& X = surface.vertices[v].X;
      if (inside.contains(X)) {
        EXPECT_LE(std::abs(GetParam().height(X)), off + 1e-6);
      }
    }
  }
  EXPECT_GE(cut_triangles, 4 * volume.severed_count());
}

TEST_P(PlanarCut, triangles_are_positive_about_their_links) {
  VoxelVolume volume = box_volume({8, 7, 6});
  sever(volume, GetParam());
  const SurfaceQuality quality = assess(contour(volume));
  EXPECT_EQ(quality.degenerate, 0);
}

/// Label 1 below a height, 2 above.
VoxelVolume two_labels(const Vec3i& size, int height) {
  LabelImage image{size, Vec3::Ones(), {}};
  for (int n = 0; n < size.prod(); ++n) image.labels.push_back(n / (size.x() * size.y()) < height ? 1 : 2);
  return VoxelVolume::sample(*make_label_shape(image, {1, 2}, Pose::Identity(), "two labels"), Vec3::Ones());
}

TEST(Contouring, cut_faces_do_not_go_through_the_skin) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int crossing = 0, triangles = 0;
  for (int i = 0; i < 20; ++i) {
    VoxelVolume volume = VoxelVolume::sample(Ball(6.3), Vec3::Ones());
    for (int cuts = 0; cuts < 2; ++cuts)
      sever(volume, {4.0 * Vec3(any(random), any(random), any(random)),
                     Vec3(any(random), any(random), any(random)).normalized()});
    const TriangleMesh mesh = contour(volume);
    crossing += count_self_crossings(mesh);
    triangles += static_cast<int>(mesh.triangles.size());
  }
  EXPECT_LT(crossing, 5e-4 * triangles);
}

TEST(Labels, of_triangles_are_those_of_the_tissue_behind_them) {
  VoxelVolume volume = two_labels({6, 5, 8}, 4);
  sever(volume, {{3.2, 0, 0}, {1, 0, 0}});
  SurfaceExtractor extractor(volume);
  const TissueSurface& surface = extractor.extract({});
  ASSERT_EQ(surface.label.size(), surface.triangles.size());
  std::array<std::array<int, 2>, 3> count{};  // by label, then by skin and cut
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    double lowest = 8.0, highest = 0.0;
    for (const int v : surface.triangles[t]) {
      lowest = std::min(lowest, surface.vertices[v].X.z());
      highest = std::max(highest, surface.vertices[v].X.z());
    }
    const int label = surface.label[t];
    EXPECT_TRUE(highest < 3.4  ? label == 1
                : lowest > 4.6 ? label == 2
                               : label == 1 || label == 2)
        << label << " between " << lowest << " and " << highest;
    ++count[label][surface.cut[t]];
  }
  EXPECT_EQ(count[0], (std::array<int, 2>{0, 0}));
  for (const int label : {1, 2})
    for (const int kind : {0, 1}) EXPECT_GT(count[label][kind], 0);
}

Plane plane(const Vec3& point, const Vec3& normal) { return {point, normal.normalized()}; }

INSTANTIATE_TEST_SUITE_P(tilts, PlanarCut,
                         testing::Values(plane({4.0, 0, 0}, {1, 0, 0}), plane({4.3, 0, 0}, {1, 0, 0}),
                                         plane({4.5, 0, 0}, {1, 0, 0}), plane({4, 3.5, 3}, {1, 0.3, 0}),
                                         plane({4, 3.5, 3}, {1, 1, 0}), plane({4.1, 3.5, 3}, {1, 0.7, -0.4}),
                                         plane({4.2, 3.4, 3.1}, {1, 1, 1}),
                                         plane({4, 3, 3.2}, {0.1, 0.2, 1})));

TEST(Contouring, crossing_and_partial_cuts_stay_manifold) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  for (int trial = 0; trial < 40; ++trial) {
    VoxelVolume volume = box_volume({6, 6, 6});
    for (int cut = 0; cut < 3; ++cut) {
      const Plane end = plane(Vec3::Constant(3.0) + vector(), vector());
      sever(volume, plane(Vec3::Constant(3.0) + vector(), vector()),
            [&](const Vec3& X) { return end.height(X) < 0.0; });
    }
    const TriangleMesh mesh = contour(volume);
    expect_closed_and_manifold(mesh, "trial " + std::to_string(trial));
    EXPECT_NEAR(enclosed_volume(mesh), 216.0, 0.03 * 216.0) << "trial " << trial;
  }
}

void sever_at_random(VoxelVolume& volume, double part, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!volume.voxel(v).linked() || volume.voxel(v).neighbour[2 * axis + 1] < 0) continue;
      if (uniform(random) > part) continue;
      const Vec3 X = volume.centre(v) + uniform(random) * Vec3::Unit(axis);
      volume.sever({v, axis}, {X, Vec3(uniform(random), uniform(random), uniform(random))});
    }
  }
}

TEST(Contouring, random_links_stay_closed_and_manifold) {
  for (int seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    VoxelVolume volume = box_volume({4, 4, 4});
    sever_at_random(volume, 0.05 + 0.9 * seed / 200.0, random);
    expect_closed_and_manifold(contour(volume), "seed " + std::to_string(seed));
  }
}

TEST(Contouring, severing_by_and_by_gives_the_same_surface_as_at_once) {
  std::mt19937 random(3);
  VoxelVolume volume = box_volume({5, 5, 5});
  SurfaceExtractor extractor(volume);
  extractor.extract({});
  for (int round = 0; round < 10; ++round) {
    sever_at_random(volume, 0.05, random);
    const TriangleMesh by_and_by = extractor.extract({}).rest(), at_once = contour(volume);
    EXPECT_EQ(by_and_by.vertices, at_once.vertices) << "round " << round;
    EXPECT_EQ(by_and_by.triangles, at_once.triangles) << "round " << round;
  }
}

TEST(Contouring, a_lone_severed_link_is_not_drawn) {
  VoxelVolume volume = box_volume({5, 5, 5});
  const TriangleMesh before = contour(volume);
  const int middle = volume.find(volume.lattice().voxel_at({2.5, 2.5, 2.5}));
  volume.sever({middle, 0}, {Vec3(3.0, 2.5, 2.5), Vec3::UnitX()});
  EXPECT_EQ(contour(volume).triangles, before.triangles);
  const int beside = volume.find(volume.lattice().voxel_at({2.5, 3.5, 2.5}));
  volume.sever({beside, 0}, {Vec3(3.0, 3.5, 2.5), Vec3::UnitX()});
  EXPECT_GT(contour(volume).triangles.size(), before.triangles.size());
}

TEST(Contouring, both_sides_of_a_cut_share_their_places) {
  VoxelVolume volume = box_volume({6, 6, 6});
  const Plane cut = plane({3.1, 3, 3}, {1, 0.4, 0.2});
  sever(volume, cut);
  SurfaceExtractor extractor(volume);
  const TissueSurface& surface = extractor.extract({});
  std::array<std::vector<std::array<double, 3>>, 2> places;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (!surface.cut[t]) continue;
    for (const int v : surface.triangles[t]) {
      const Vec3& X = surface.vertices[v].X;
      places[cut.height(volume.centre(surface.vertices[v].voxel)) > 0.0].push_back({X.x(), X.y(), X.z()});
    }
  }
  for (auto& side : places) {
    std::sort(side.begin(), side.end());
    side.erase(std::unique(side.begin(), side.end()), side.end());
  }
  EXPECT_GT(places[0].size(), 36u);
  EXPECT_EQ(places[0], places[1]);
}

}  // namespace
}  // namespace cfem_cutting
