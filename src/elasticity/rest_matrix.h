#pragma once

#include <memory>

#include "deformation_matrix.h"

namespace cfem_cutting {

/// An element's stiffness at rest, and what products make of it.
struct RestMatrix {
  RestMatrix() = default;
  explicit RestMatrix(const ElementMatrix& K)
      : trace(K.trace()), deformations(cfem_cutting::deformations(K)), whole(K) {}
  double trace = 0.0;  ///< N/m
  std::optional<DeformationMatrix> deformations;
  ElementMatrix whole;  ///< N/m
};
using MatrixPointer = std::shared_ptr<const RestMatrix>;

}  // namespace cfem_cutting
