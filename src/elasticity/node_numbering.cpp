#include "node_numbering.h"

#include <algorithm>

#include "element_tiles.h"

namespace cfem_cutting {

/// The root of a set is its first corner.
NodeNumbering::NodeNumbering(UnionFind& sets, int elements)
    : of_corner(8 * static_cast<std::size_t>(elements)) {
  const int corners = 8 * elements, tile = 8 * ElementTiles::tile_size(elements);
  std::vector<int> last_tile(corners), number(corners), shared;
  for (int i = 0; i < corners; ++i) last_tile[of_corner[i] = sets.find(i)] = i / tile;
  for (int begin = 0; begin < corners; begin += tile) {
    const int end = std::min(begin + tile, corners);
    shared.clear();
    for (int i = begin; i < end; ++i) {
      if (of_corner[i] != i) continue;
      if (last_tile[i] > begin / tile)
        shared.push_back(i);
      else
        number[i] = count++;
    }
    for (const int i : shared) number[i] = count++;
    for (int i = begin; i < end; ++i) of_corner[i] = number[of_corner[i]];
  }
}

}  // namespace cfem_cutting
