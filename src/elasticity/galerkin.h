#pragma once

#include <cstdint>
#include <unordered_map>

#include "coarsening.h"

namespace cfem_cutting {

/// Stiffness of coarse elements, K_c = Σ Iᵀ K I over the fine elements in it at rest (Galerkin). Coarse
/// elements with equal parts share one matrix; matrices are kept from call to call, so that a cut pays for
/// what it touched only.
class GalerkinMatrices {
 public:
  /// @param held per fine node: its displacement is zero, whatever the coarse nodes do
  std::vector<MatrixPointer> assemble(const ElementSet& fine, const std::vector<char>& held,
                                      const Coarsening& coarsening);

 private:
  struct Part {
    MatrixPointer stiffness;
    std::uint32_t place;  ///< bits 8–10: offset in the coarse element; 0–7: corners that are free
    bool operator==(const Part& other) const { return stiffness == other.stiffness && place == other.place; }
  };
  using Parts = std::vector<Part>;
  struct Hash {
    std::size_t operator()(const Parts& parts) const;
  };
  static ElementMatrix sum(const Parts& parts);

  std::unordered_map<Parts, MatrixPointer, Hash> known_;
};

}  // namespace cfem_cutting
