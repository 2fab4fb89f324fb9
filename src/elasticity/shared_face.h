#pragma once

#include "union_find.h"

namespace cfem_cutting {

/// Unites the private nodes (8 × element + corner) of two elements at the face between them.
/// @param axis along which `upper` follows `lower`
inline void unite_at_face(UnionFind& nodes, int lower, int upper, int axis) {
  for (int n = 0; n < 8; ++n)
    if (!(n >> axis & 1)) nodes.unite(8 * lower + (n | 1 << axis), 8 * upper + n);
}

}  // namespace cfem_cutting
