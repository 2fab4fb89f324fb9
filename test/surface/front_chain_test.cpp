#include "front_chain.h"

#include <gtest/gtest.h>

#include "surface/tissue.h"

namespace cfem_cutting {
namespace {

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
  const VoxelVolume volume = test::box_volume({8, 8, 4});
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

}  // namespace
}  // namespace cfem_cutting
