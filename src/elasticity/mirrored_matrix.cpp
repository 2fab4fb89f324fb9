#include "mirrored_matrix.h"

#include <unsupported/Eigen/KroneckerProduct>

namespace cfem_cutting {
namespace {

constexpr double kRounding = 1e-13;  // of the largest entry

ElementMatrix walsh_transform() {
  Eigen::Matrix<double, 8, 8> signs;
  for (int s = 0; s < 8; ++s)
    for (int n = 0; n < 8; ++n) signs(s, n) = __builtin_parity(s & n) ? -1.0 : 1.0;
  return Eigen::kroneckerProduct(signs, Mat3::Identity());
}

}  // namespace

std::optional<MirroredMatrix> mirrored(const ElementMatrix& K) {
  static const ElementMatrix H = walsh_transform();
  ElementMatrix left = H * K * H / 64.0;
  const double rounding = kRounding * left.cwiseAbs().maxCoeff();
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
