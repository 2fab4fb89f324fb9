#pragma once

#include <array>
#include <optional>

#include "node_modes.h"

namespace cfem_cutting {

/// What is left of an element's stiffness K that rigid motions leave without forces: among modes (see
/// to_modes) translations have zeros, and columns of the linear ones come in pairs, one a multiple of the
/// other: as a small rotation of a block with edges hᵢ moves mode 2ʲ along axis i by hⱼ and mode 2ⁱ along
/// axis j by −hᵢ, the one of these is hⱼ/hᵢ times the other. So 18 modes of 24 do.
struct DeformationMatrix {
  static constexpr int kModes = 18;

  /// 3 s + axis of the modes that are kept.
  static constexpr std::array<int, kModes> kKept{3,  6,  7,  9,  10, 11, 12, 13, 14,
                                                 15, 16, 17, 18, 19, 20, 21, 22, 23};

  /// One of the linear modes that is kept, and its multiple.
  struct Pair {
    int kept, left_out;
  };
  static constexpr std::array<Pair, 3> kPairs{{{6, 4}, {12, 5}, {13, 8}}};

  Eigen::Matrix<double, kModes, kModes> among_kept;
  Vec3 ratio;  ///< of each pair: what is left out as a multiple of what is kept
};

/// @return nothing for matrices that have forces against rigid motions
std::optional<DeformationMatrix> deformations(const ElementMatrix& K);

}  // namespace cfem_cutting
