#include "deformation_matrix.h"

#include "element_kernel.h"

namespace cfem_cutting {
namespace {

static_assert(DeformationMatrix::kModes * (DeformationMatrix::kModes + 1) / 2 == kDeformationTriangle);
constexpr double kRounding = 1e-12;  // of the largest entry

}  // namespace

std::optional<DeformationMatrix> deformations(const ElementMatrix& K) {
  const ElementMatrix modes = to_modes(K);
  const double rounding = kRounding * modes.cwiseAbs().maxCoeff();
  double left = modes.leftCols<3>().cwiseAbs().maxCoeff();
  DeformationMatrix matrix;
  for (int i = 0; i < 3; ++i) {
    const auto [kept, left_out] = DeformationMatrix::kPairs[i];
    if (!(modes(kept, kept) > rounding)) return std::nullopt;
    matrix.ratio[i] = modes(kept, left_out) / modes(kept, kept);
    left = std::max(left, (modes.col(left_out) - matrix.ratio[i] * modes.col(kept)).cwiseAbs().maxCoeff());
  }
  if (!(left <= rounding)) return std::nullopt;
  for (int i = 0; i < DeformationMatrix::kModes; ++i)
    for (int j = 0; j < DeformationMatrix::kModes; ++j)
      matrix.among_kept(i, j) = modes(DeformationMatrix::kKept[i], DeformationMatrix::kKept[j]);
  return matrix;
}

}  // namespace cfem_cutting
