#include "node_modes.h"

namespace cfem_cutting {
namespace {

/// M H
ElementMatrix transform_columns(ElementMatrix M) {
  for (int bit = 1; bit < 8; bit *= 2) {
    for (int n = 0; n < 8; ++n) {
      if (n & bit) continue;
      auto a = M.middleCols<3>(3 * n), b = M.middleCols<3>(3 * (n + bit));
      a += b;
      b = a - 2.0 * b;
    }
  }
  return M;
}

}  // namespace

ElementMatrix to_modes(const ElementMatrix& K) {
  return transform_columns(transform_columns(K / 64.0).transpose());
}

}  // namespace cfem_cutting
