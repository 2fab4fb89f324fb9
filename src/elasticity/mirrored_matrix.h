#pragma once

#include <optional>

#include "node_modes.h"

namespace cfem_cutting {

/// What is left of an element's stiffness K that three reflections of the block and translations leave alone,
/// as those of whole blocks do: among modes (see to_modes) it couples axis i of s with axis j of t only where
/// s ⊕ 2ⁱ = t ⊕ 2ʲ. Row p: the 3 × 3 block of p = s ⊕ 2ⁱ, row by row.
using MirroredMatrix = Eigen::Matrix<double, 8, 9, Eigen::RowMajor>;

/// @return nothing for other matrices
std::optional<MirroredMatrix> mirrored(const ElementMatrix& K);

}  // namespace cfem_cutting
