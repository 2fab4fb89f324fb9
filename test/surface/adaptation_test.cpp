#include <algorithm>
#include <memory>

#include "cfem_cutting/geometry/polyline.h"
#include "cfem_cutting/volume/inside.h"
#include "surface/ball.h"
#include "surface/tissue.h"

namespace cfem_cutting {
namespace {

using test::box_volume;
using test::expect_closed_and_manifold;
using test::Plane;
using test::sever;

Polyline line(const Vec3& from, const Vec3& to) { return refine({from, to}, 0.5); }

std::vector<Vec3> on_front(const TissueSurface& surface) {
  std::vector<Vec3> points;
  for (const SurfaceVertex& vertex : surface.vertices)
    if (vertex.on_front) points.push_back(vertex.X);
  return points;
}

/// Consecutive vertices on a straight trace must be joined by edges.
void expect_chain(const TissueSurface& surface, const Vec3& along) {
  std::vector<int> chain;
  for (std::size_t v = 0; v < surface.vertices.size(); ++v)
    if (surface.vertices[v].on_front) chain.push_back(static_cast<int>(v));
  const auto at = [&](int v) { return surface.vertices[v].X.dot(along); };
  std::sort(chain.begin(), chain.end(), [&](int a, int b) { return at(a) < at(b); });
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const auto joins = [&](const std::array<int, 3>& t) {
      return std::count(t.begin(), t.end(), chain[i]) + std::count(t.begin(), t.end(), chain[i + 1]) == 2;
    };
    EXPECT_TRUE(std::any_of(surface.triangles.begin(), surface.triangles.end(), joins)) << "link " << i;
  }
}

class SkinTrace : public testing::TestWithParam<double> {};

TEST_P(SkinTrace, carries_a_chain_of_vertices_without_folds) {
  const VoxelVolume volume = box_volume({8, 8, 4});
  const double shift = GetParam();
  const Vec3 from(1.6, 2.0 + shift, 4.0), to(6.4, 5.0 + shift, 4.0);
  SurfaceExtractor extractor(volume);
  const TissueSurface& surface = extractor.extract({line(from, to)});
  const std::vector<Vec3> points = on_front(surface);
  EXPECT_GE(points.size(), 5u);
  for (const Vec3& X : points) EXPECT_LT(project({from, to}, X).distance, 1e-9);
  expect_chain(surface, to - from);
  const TriangleMesh mesh = surface.rest();
  EXPECT_EQ(assess(mesh).degenerate, 0);
  EXPECT_NEAR(enclosed_volume(mesh), 256.0, 1e-9);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 &A = mesh.vertices[a], &B = mesh.vertices[b], &C = mesh.vertices[c];
    if (std::min({A.z(), B.z(), C.z()}) > 3.9) {
      EXPECT_GT((B - A).cross(C - A).z(), 0.0);
    }
  }
  extractor.extract({});
  EXPECT_TRUE(on_front(surface).empty());
  EXPECT_EQ(surface.rest().vertices, SurfaceExtractor(volume).extract({}).rest().vertices);
}

INSTANTIATE_TEST_SUITE_P(shifts, SkinTrace, testing::Values(0.0, 0.13, 0.3, 0.41, 0.5, 0.77));

TEST(SkinTrace, of_one_point_carries_one_vertex) {
  const VoxelVolume volume = box_volume({8, 8, 4});
  SurfaceExtractor extractor(volume);
  const Vec3 tip(3.7, 4.2, 4.0);
  EXPECT_EQ(on_front(extractor.extract({Polyline{tip}})), std::vector<Vec3>{tip});
}

TEST(CutEnd, lies_on_the_front_and_stays_when_frozen) {
  VoxelVolume volume = box_volume({8, 6, 6});
  const double depth = 2.8;  // between rows of centres at 2.5 and 3.5
  sever(volume, Plane{{4.2, 0, 0}, Vec3::UnitX()}, [&](const Vec3& X) { return X.z() > depth; });
  const Vec3 from(4.2, 0.0, depth), to(4.2, 6.0, depth);
  SurfaceExtractor extractor(volume);
  const TissueSurface& surface = extractor.extract({line(from, to)});
  EXPECT_EQ(on_front(surface).size(), 7u);
  for (const Vec3& X : on_front(surface)) EXPECT_LT(project({from, to}, X).distance, 1e-9);
  expect_closed_and_manifold(surface.rest(), "cut end");
  EXPECT_NEAR(enclosed_volume(surface.rest()), 288.0, 1e-9);
  const std::vector<Vec3> held = surface.rest().vertices;
  extractor.freeze();
  extractor.extract({});
  EXPECT_TRUE(on_front(surface).empty());
  EXPECT_EQ(surface.rest().vertices, held);
}

/// How far ends of a cut are from it, at most. It is the part of the plane x = 4.2 with y > 2.48 and z > 2.8.
double farthest_end(bool on_cut) {
  VoxelVolume volume = box_volume({8, 6, 6});
  sever(volume, Plane{{4.2, 0, 0}, Vec3::UnitX()}, [](const Vec3& X) { return X.y() > 2.48 && X.z() > 2.8; });
  const auto nearest = [](const Vec3& X) { return Vec3(4.2, std::max(2.48, X.y()), std::max(2.8, X.z())); };
  SurfaceExtractor extractor(volume, on_cut ? SurfaceExtractor::NearestOnCut(nearest) : nullptr);
  extractor.freeze();
  const TissueSurface& surface = extractor.extract({line({4.2, 2.48, 2.8}, {4.2, 6.0, 2.8})});
  expect_closed_and_manifold(surface.rest(), "cut end beside the front");
  EXPECT_EQ(count_flipped(surface), 0);
  EXPECT_NEAR(enclosed_volume(surface.rest()), 288.0, 1e-9);
  double farthest = 0.0;
  for (const SurfaceVertex& vertex : surface.vertices)
    if (vertex.cut_end) farthest = std::max(farthest, (vertex.X - nearest(vertex.X)).norm());
  return farthest;
}

TEST(CutEnd, beside_the_front_lies_on_the_cut) {
  EXPECT_LT(farthest_end(true), 1e-9);
  EXPECT_GT(farthest_end(false), 0.1);
}

TEST(CutEnd, on_the_skin_stays_on_the_cut_when_the_edge_is_gone) {
  VoxelVolume volume = box_volume({8, 6, 6});
  const double depth = 3.4;  // just below the last row of links that are severed
  sever(volume, Plane{{4.2, 0, 0}, Vec3::UnitX()}, [&](const Vec3& X) { return X.z() > depth; });
  const auto nearest = [&](const Vec3& X) { return Vec3(4.2, X.y(), std::max(depth, X.z())); };
  SurfaceExtractor extractor(volume, nearest);
  extractor.freeze();
  extractor.extract({line({4.2, 0.0, depth}, {4.2, 6.0, depth})});
  const TissueSurface& surface = extractor.extract({});
  int ends = 0;
  for (const SurfaceVertex& vertex : surface.vertices) {
    if (!vertex.cut_end) continue;
    ++ends;
    EXPECT_LT((vertex.X - nearest(vertex.X)).norm(), 1e-9) << vertex.X.transpose();
  }
  EXPECT_EQ(ends, 7);
  EXPECT_EQ(count_flipped(surface), 0);
}

/// An edge whose tip is some voxels beyond the links that it has severed.
class Stab : public testing::Test {
 protected:
  Stab() {
    sever(volume, Plane{{4.2, 0, 0}, Vec3::UnitX()},
          [](const Vec3& X) { return X.y() > 5.5 && X.z() > 2.8; });
    trace.tip = true;
  }
  VoxelVolume volume = box_volume({8, 8, 6});
  const Vec3 tip{4.2, 1.3, 2.8};
  Trace trace{line({4.2, 8.0, 2.8}, tip)};
  SurfaceExtractor extractor{volume};
};

TEST_F(Stab, is_followed_to_its_tip_where_no_link_is_severed) {
  const TissueSurface& surface = extractor.extract({trace});
  const auto at_tip = std::find_if(surface.vertices.begin(), surface.vertices.end(),
                                   [](const SurfaceVertex& v) { return v.edge_end == EdgeEnd::kTip; });
  ASSERT_NE(at_tip, surface.vertices.end());
  EXPECT_EQ(at_tip->X, tip);
  EXPECT_EQ(at_tip->voxel, tissue_voxel_at(volume, tip)) << "it follows the tissue at the tip";
  expect_chain(surface, {0, 1, 0});
  expect_closed_and_manifold(surface.rest(), "cut end at the tip");
  EXPECT_EQ(count_flipped(surface), 0);
  EXPECT_NEAR(enclosed_volume(surface.rest()), 384.0, 1e-9);
}

TEST_F(Stab, frozen_stays_with_its_tissue_whatever_passes_and_is_cut_elsewhere) {
  const TissueSurface& surface = extractor.extract({trace});
  extractor.freeze();
  const std::vector<Vec3> frozen = extractor.extract({}).rest().vertices;
  extractor.extract({line({4.4, 8.0, 3.1}, {3.9, 2.0, 2.2})});
  EXPECT_EQ(extractor.extract({}).rest().vertices, frozen);
  sever(volume, Plane{{0, 0, 5.2}, Vec3::UnitZ()}, [](const Vec3& X) { return X.x() < 2.0 && X.y() < 2.0; });
  extractor.extract({});
  const auto at_tip = std::find_if(surface.vertices.begin(), surface.vertices.end(),
                                   [&](const SurfaceVertex& v) { return v.X == tip; });
  ASSERT_NE(at_tip, surface.vertices.end());
  EXPECT_EQ(at_tip->voxel, tissue_voxel_at(volume, tip));
}

/// A slit through one row of links at the skin ends in the cells on both sides of them.
TEST(Slit, is_followed_from_cell_to_cell) {
  VoxelVolume volume = box_volume({8, 8, 6});
  sever(volume, Plane{{4.2, 0, 0}, Vec3::UnitX()},
        [](const Vec3& X) { return std::abs(X.y() - 3.5) < 0.1 && X.z() > 4.8; });
  const Vec3 heel(4.2, 2.9, 5.9);
  for (const double y : {3.4, 3.6, 3.9}) {
    const Vec3 tip(4.2, y, 5.4);
    Trace trace{line(heel, tip)};
    trace.tip = true;
    SurfaceExtractor extractor(volume);
    const TissueSurface& surface = extractor.extract({trace});
    const std::vector<Vec3> points = on_front(surface);
    for (const Vec3& end : {heel, tip}) EXPECT_EQ(std::count(points.begin(), points.end(), end), 1) << y;
    const std::size_t count = y < 3.5 ? 2 : y < 3.8 ? 3 : 5;  // with both sides of the slit between two cells
    EXPECT_EQ(points.size(), count) << y;
    for (const Vec3& X : points) EXPECT_LT(project({heel, tip}, X).distance, 1e-9) << y;
    expect_closed_and_manifold(surface.rest(), "slit");
    EXPECT_EQ(count_flipped(surface), 0);
    extractor.extract({});
    EXPECT_EQ(surface.rest().vertices, SurfaceExtractor(volume).extract({}).rest().vertices);
  }
}

/// How far cut vertices are from their plane, at most. It leaves the skin at y = 6 beyond the cells whose
/// links it severs there.
/// @param freezes the cut's end was on the front
double farthest_from_plane(bool on_cut, bool freezes = true) {
  VoxelVolume volume = box_volume({8, 6, 6});
  const Vec3 normal = Vec3(1.0, 0.35, 0.0).normalized(), point(4.445, 0.0, 0.0);
  sever(volume, Plane{point, normal});
  const auto nearest = [&](const Vec3& X) -> Vec3 { return X - normal.dot(X - point) * normal; };
  SurfaceExtractor extractor(volume, on_cut ? SurfaceExtractor::NearestOnCut(nearest) : nullptr);
  if (freezes) extractor.freeze();
  const TissueSurface& surface = extractor.extract({});
  expect_closed_and_manifold(surface.rest(), "tilted cut");
  EXPECT_EQ(count_flipped(surface), 0);
  EXPECT_NEAR(enclosed_volume(surface.rest()), 288.0, 0.1);
  double farthest = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const int v : surface.triangles[t])
      if (surface.cut[t]) farthest = std::max(farthest, std::abs(normal.dot(surface.vertices[v].X - point)));
  return farthest;
}

TEST(Rim, lies_on_the_cut_beyond_its_cell) {
  EXPECT_LT(farthest_from_plane(true), 0.02);
  EXPECT_GT(farthest_from_plane(false), 0.1);
}

TEST(Rim, lies_on_the_cut_whether_its_end_advanced_or_not) {
  EXPECT_LT(farthest_from_plane(true, false), 0.02);
}

/// A cut so short that its two sides meet on both of its ends in the cells' faces.
TEST(ShortCut, lies_on_what_was_swept) {
  VoxelVolume volume = box_volume({8, 6, 6});
  sever(volume, Plane{{4.2, 0, 0}, Vec3::UnitX()},
        [](const Vec3& X) { return X.y() < 1.0 && std::abs(X.z() - 2.5) < 0.1; });
  const auto nearest = [](const Vec3& X) {
    return Vec3(4.2, std::min(X.y(), 0.8), std::clamp(X.z(), 2.2, 2.8));
  };
  SurfaceExtractor extractor(volume, nearest);
  const TissueSurface& surface = extractor.extract({});
  expect_closed_and_manifold(surface.rest(), "short cut");
  EXPECT_EQ(count_flipped(surface), 0);
  int corners = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const int v : surface.triangles[t]) {
      if (!surface.cut[t]) continue;
      ++corners;
      const Vec3& X = surface.vertices[v].X;
      EXPECT_LT((X - nearest(X)).norm(), 0.02) << X.transpose();
    }
  EXPECT_GT(corners, 12);
}

TEST(Deform, doubles_the_rim_and_draws_bound_vertices_on_the_front) {
  VoxelVolume volume = box_volume({8, 6, 6});
  sever(volume, Plane{{4.2, 0, 0}, Vec3::UnitX()}, [](const Vec3& X) { return X.z() > 2.8; });
  SurfaceExtractor extractor(volume);
  const TissueSurface& surface = extractor.extract({line({4.2, 0, 2.8}, {4.2, 6, 2.8})});
  const CompositeMesh mesh(volume, 1);
  const Vec3 shift(0.0, 0.0, -0.3);
  const Polyline front{{4.1, -1.0, 2.5}, {4.1, 7.0, 2.5}};
  const DeformedSurface drawn = deform(surface, mesh, mesh.rest().colwise() + shift, front);
  EXPECT_GT(drawn.positions.size(), surface.vertices.size());
  for (std::size_t v = 0; v < drawn.positions.size(); ++v) {
    const SurfaceVertex& source = surface.vertices[drawn.source[v]];
    EXPECT_NEAR(drawn.normals[v].norm(), 1.0, 1e-12);
    const bool near = std::hypot(source.X.x() - 4.2, source.X.z() - 2.8) < 2.0;
    if (source.on_front) {
      EXPECT_LT(project(front, drawn.positions[v]).distance, 1e-9);
    } else {
      EXPECT_LT((drawn.positions[v] - source.X - shift).norm(), near ? 0.1 : 1e-9);
    }
  }
  std::vector<int> kind(drawn.positions.size(), -1);
  for (std::size_t t = 0; t < drawn.triangles.size(); ++t)
    for (const int v : drawn.triangles[t]) {
      EXPECT_TRUE(kind[v] < 0 || kind[v] == drawn.cut[t]) << "vertex " << v << " is of skin and cut";
      kind[v] = drawn.cut[t];
    }
}

TEST(Deform, draws_the_neighbourhood_of_a_held_cut_end_along) {
  VoxelVolume volume = box_volume({8, 6, 6});
  sever(volume, Plane{{4.2, 0, 0}, Vec3::UnitX()}, [](const Vec3& X) { return X.z() > 2.8; });
  SurfaceExtractor extractor(volume);
  const TissueSurface& surface = extractor.extract({line({4.2, 0, 2.8}, {4.2, 6, 2.8})});
  const CompositeMesh mesh(volume, 1);
  const Vec3 way(0.0, 0.0, 0.4);
  const DeformedSurface drawn = deform(surface, mesh, mesh.rest(), {{4.2, -1.0, 3.2}, {4.2, 7.0, 3.2}});
  int along = 0;
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    const Vec3& X = surface.vertices[v].X;
    const double part = (drawn.positions[v] - X).dot(way) / way.squaredNorm();
    EXPECT_LT((drawn.positions[v] - X - part * way).norm(), 1e-9);
    EXPECT_GE(part, 0.0);
    const bool near = std::hypot(X.x() - 4.2, X.z() - 2.8) < 2.0;
    EXPECT_LE(part, near ? 1.0 + 1e-9 : 0.0);
    along += part > 0.1 && !surface.vertices[v].on_front;
  }
  EXPECT_GT(along, 10);
}

/// A tilted cut halfway into a box, whose rim and end are settled on it.
struct SettledCut {
  VoxelVolume volume = box_volume({8, 8, 6});
  Plane plane{{4.1, 4.0, 3.0}, Vec3(1.0, 0.22, 0.13).normalized()};
  std::optional<Vec3> nearest(const Vec3& X) const {
    const Vec3 at = X - plane.height(X) * plane.normal;
    return (at - X).norm() <= 1.0 && at.z() >= 2.4 ? std::optional<Vec3>(at) : std::nullopt;
  }
  Vec3 on_plane(double y, double z) const {
    const Vec3 X(4.0, y, z);
    return X - plane.height(X) / plane.normal.x() * Vec3::UnitX();
  }
  std::unique_ptr<SurfaceExtractor> extract() {
    auto extractor = std::make_unique<SurfaceExtractor>(volume, [this](const Vec3& X) { return nearest(X); });
    extractor->extract({});
    sever(volume, plane, [](const Vec3& X) { return X.z() > 2.5; });
    extractor->freeze();
    extractor->extract({line(on_plane(0.0, 2.4), on_plane(8.0, 2.4))});
    return extractor;
  }
};

void expect_same(const TriangleMesh& mesh, const TriangleMesh& expected) {
  EXPECT_EQ(mesh.vertices, expected.vertices);
  EXPECT_EQ(mesh.triangles, expected.triangles);
}

/// What a trace has moved, also beside itself, goes back when it is gone: as if all cells were looked at.
TEST(Traces, LeaveNothingBehind) {
  SettledCut cut, same;
  const std::unique_ptr<SurfaceExtractor> visited = cut.extract(), other = same.extract();
  std::srand(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3 from = Vec3(4.0, 4.0, 3.5) + 2.0 * Vec3::Random(),
               to = Vec3(4.0, 4.0, 3.5) + 4.0 * Vec3::Random();
    visited->extract({line(from, to)});
    const TriangleMesh there = visited->surface().rest();
    expect_same(visited->extract({}).rest(), other->extract({}).rest());
    expect_same(visited->extract({line(from, to)}).rest(), there);
  }
}

/// Cuts beside skin that a trace has moved take the diagonals that they have without it, too.
TEST(Traces, LeaveNothingBehindWhereCutsMeetTheSkin) {
  std::srand(5);
  for (int i = 0; i < 20; ++i) {
    VoxelVolume volume = VoxelVolume::sample(test::Ball(6.3), Vec3::Ones());
    for (int cuts = 0; cuts < 2; ++cuts) sever(volume, {2.0 * Vec3::Random(), Vec3::Random().normalized()});
    SurfaceExtractor visited(volume), other(volume);
    other.extract({});
    visited.extract({});
    for (int k = 0; k < 20; ++k) {
      visited.extract({line(6.3 * Vec3::Random().normalized(), 6.3 * Vec3::Random().normalized())});
      expect_same(visited.extract({}).rest(), other.surface().rest());
    }
  }
}

}  // namespace
}  // namespace cfem_cutting
