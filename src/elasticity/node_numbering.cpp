#include "node_numbering.h"

#include <algorithm>

#include "element_tiles.h"

namespace cfem_cutting {

NodeNumbering::NodeNumbering(UnionFind& sets, int elements)
    : of_corner(8 * static_cast<std::size_t>(elements)) {
  const int corners = 8 * elements, tile = 8 * ElementTiles::tile_size(elements);
  std::vector<int> last_tile(corners), number(corners, -1);
  for (int i = 0; i < corners; ++i) {
    of_corner[i] = sets.find(i);
    last_tile[of_corner[i]] = i / tile;
  }
  for (int begin = 0; begin < corners; begin += tile)
    for (const bool shared : {false, true})
      for (int i = begin; i < std::min(begin + tile, corners); ++i) {
        const int root = of_corner[i];
        if (number[root] < 0 && (last_tile[root] > begin / tile) == shared) number[root] = count++;
      }
  for (int& of : of_corner) of = number[of];
}

}  // namespace cfem_cutting
