#include "mirrored_matrix.h"

namespace cfem_cutting {
namespace {

constexpr double kRounding = 1e-13;  // of the largest entry

}  // namespace

std::optional<MirroredMatrix> mirrored(const ElementMatrix& K) {
  ElementMatrix left = to_modes(K);
  const double rounding = kRounding * left.cwiseAbs().maxCoeff();
  if (left.leftCols<3>().cwiseAbs().maxCoeff() > rounding) return std::nullopt;
  MirroredMatrix blocks;
  for (int p = 0; p < 8; ++p) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        double& entry = left(3 * (p ^ 1 << i) + i, 3 * (p ^ 1 << j) + j);
        blocks(p, 3 * i + j) = entry;
        entry = 0.0;
      }
    }
  }
  if (left.cwiseAbs().maxCoeff() > rounding) return std::nullopt;
  return blocks;
}

}  // namespace cfem_cutting
