#pragma once

#include <memory>

#include "deformation_matrix.h"

namespace cfem_cutting {

/// An element's stiffness at rest, and what products make of it.
struct RestMatrix {
  RestMatrix() = default;
  explicit RestMatrix(const ElementMatrix& K) : whole(K), deformations(cfem_cutting::deformations(K)) {}
  ElementMatrix whole;  ///< N/m
  std::optional<DeformationMatrix> deformations;
};
using MatrixPointer = std::shared_ptr<const RestMatrix>;

}  // namespace cfem_cutting
