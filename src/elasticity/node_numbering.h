#pragma once

#include <vector>

#include "union_find.h"

namespace cfem_cutting {

/// Numbers of united private nodes, tile by tile of their first element (see ElementTiles). In a tile those
/// that other tiles have, too, come last, so that finishing them does not touch the others' memory again.
struct NodeNumbering {
  /// @param sets of private nodes, 8 e + corner
  NodeNumbering(UnionFind& sets, int elements);
  std::vector<int> of_corner;  ///< (8 × elements)
  int count = 0;
};

}  // namespace cfem_cutting
