#include "node_numbering.h"

#include <gtest/gtest.h>

#include <set>

#include "element_tiles.h"
#include "specimens.h"

namespace cfem_cutting {
namespace {

/// A mesh of several tiles.
class NodeNumberingTest : public testing::Test {
 protected:
  const VoxelVolume volume = tilted_volume({1.0, 0.8, 0.6}, 0.05);
  const CompositeMesh mesh{volume, 0};
  const int tile = ElementTiles::tile_size(static_cast<int>(mesh.elements().size()));

  /// First and last tile per node.
  std::vector<std::pair<int, int>> tiles_of_nodes() const {
    std::vector<std::pair<int, int>> tiles(mesh.node_count(), {-1, -1});
    for (int e = 0; e < static_cast<int>(mesh.elements().size()); ++e)
      for (int node : mesh.elements()[e].nodes) {
        if (tiles[node].first < 0) tiles[node].first = e / tile;
        tiles[node].second = e / tile;
      }
    return tiles;
  }
};

TEST_F(NodeNumberingTest, GoesTileByTileWithSharedNodesLast) {
  const auto tiles = tiles_of_nodes();
  ASSERT_GT(tiles.back().second, 3);
  for (std::size_t node = 1; node < tiles.size(); ++node) {
    const auto& [before_first, before_last] = tiles[node - 1];
    const auto& [first, last] = tiles[node];
    ASSERT_LE(before_first, first) << node;
    if (before_first == first) {
      ASSERT_LE(before_last > before_first, last > first) << node;
    }
  }
}

TEST(NodeNumbering, GivesEachSetOneNumber) {
  UnionFind sets(16);
  sets.unite(1, 8);
  sets.unite(3, 10);
  const NodeNumbering number(sets, 2);
  EXPECT_EQ(number.count, 14);
  EXPECT_EQ(number.of_corner[1], number.of_corner[8]);
  EXPECT_EQ(number.of_corner[3], number.of_corner[10]);
  EXPECT_EQ(std::set<int>(number.of_corner.begin(), number.of_corner.end()).size(), 14u);
}

}  // namespace
}  // namespace cfem_cutting
