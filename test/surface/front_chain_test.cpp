#include "front_chain.h"

#include <gtest/gtest.h>

#include "cfem_cutting/geometry/polyline.h"
#include "surface/tissue.h"

namespace cfem_cutting {
namespace {

using test::box_volume;
using Pairs = std::set<Diagonal>;

/// Neighbours in a chain that the surface joins.
Pairs joined_in(const std::vector<ChainLink>& chain) {
  Pairs pairs;
  for (std::size_t i = 1; i < chain.size(); ++i)
    if (chain[i].continues)
      pairs.insert(
          diagonal_between({chain[i - 1].cell, chain[i - 1].group}, {chain[i].cell, chain[i].group}));
  return pairs;
}

TEST(FrontChain, takes_another_way_where_a_diagonal_is_avoided) {
  const VoxelVolume volume = box_volume({8, 8, 4});
  Contour contour(volume);
  contour.update();
  const Trace trace(refine({Vec3(1.6, 1.61, 4.0), Vec3(6.4, 6.41, 4.0)}, 0.5));
  const std::vector<ChainLink> straight = find_chain(contour, trace);
  const auto index = [&](int cell) { return contour.cells()[cell].index; };
  Pairs diagonals;
  for (const Diagonal& pair : joined_in(straight))
    if ((index(pair.first.first) - index(pair.second.first)).cwiseAbs().sum() > 1) diagonals.insert(pair);
  ASSERT_GE(diagonals.size(), 3u);
  const std::vector<ChainLink> detour = find_chain(contour, trace, diagonals);
  for (const Diagonal& pair : joined_in(detour)) EXPECT_EQ(diagonals.count(pair), 0u);
  EXPECT_EQ(joined_in(detour).size(), detour.size() - 1) << "the detour is whole";
  EXPECT_GT(detour.size(), straight.size());
}

/// Tissue that folds under the edge has the trace turn back.
TEST(FrontChain, comes_by_a_vertex_once) {
  const VoxelVolume volume = box_volume({8, 8, 4});
  Contour contour(volume);
  contour.update();
  const Trace trace(refine({Vec3(1.6, 4.1, 4.0), Vec3(5.4, 4.3, 4.0), Vec3(3.1, 4.2, 4.0)}, 0.25));
  const std::vector<ChainLink> chain = find_chain(contour, trace);
  std::set<std::pair<int, int>> vertices;
  for (const ChainLink& link : chain) vertices.insert({link.cell, link.group});
  EXPECT_GE(chain.size(), 3u);
  EXPECT_EQ(vertices.size(), chain.size());
}

/// A blade in a plane of voxels' centres has cut the links on one side of it, and farther on those on the
/// other.
TEST(FrontChain, closes_the_gap_between_rows_that_nothing_joins) {
  VoxelVolume volume = box_volume({8, 8, 6});
  const auto deep = [](const Vec3& X) { return X.z() > 2.8; };
  test::sever(volume, test::Plane{{0, 4.2, 0}, Vec3::UnitY()},
              [&](const Vec3& X) { return deep(X) && X.x() < 4.0; });
  test::sever(volume, test::Plane{{0, 4.8, 0}, Vec3::UnitY()},
              [&](const Vec3& X) { return deep(X) && X.x() > 4.0; });
  Contour contour(volume);
  contour.update();
  const Vec3 from(0.0, 4.5, 2.8), to(8.0, 4.5, 2.8);
  const std::vector<ChainLink> chain = find_chain(contour, Trace(refine({from, to}, 0.5)));
  ASSERT_GE(chain.size(), 6u);
  int gaps = 0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    if (chain[i].continues) continue;
    ++gaps;
    EXPECT_EQ(chain[i].X, chain[i - 1].X);
  }
  EXPECT_EQ(gaps, 1);
  EXPECT_EQ(chain.front().X, from);
  EXPECT_EQ(chain.back().X, to);
}

TEST(FrontChain, leaves_out_vertices_of_longer_traces) {
  const VoxelVolume volume = box_volume({8, 8, 4});
  const Polyline across = refine({Vec3(1.6, 4.1, 4.0), Vec3(6.4, 4.3, 4.0)}, 0.25);
  const Polyline beside = refine({Vec3(3.1, 4.4, 4.0), Vec3(4.9, 4.4, 4.0)}, 0.25);
  SurfaceExtractor extractor(volume);
  const auto held = [&](const FrontTrace& trace, const Polyline& on) {
    int count = 0;
    for (const SurfaceVertex& v : extractor.extract(trace).vertices)
      count += v.on_front && project(on, v.X).distance < 1e-9 ? 1 : 0;
    return count;
  };
  const int alone = held({across}, across);
  EXPECT_EQ(held({beside, across}, across), alone);
  EXPECT_GE(held({beside, across}, beside), 1);
}

}  // namespace
}  // namespace cfem_cutting
