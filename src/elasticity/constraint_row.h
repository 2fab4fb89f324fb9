#pragma once

#include "element_product.h"

namespace cfem_cutting {

/// A constraint's row on one level: k (w ⊗ d)(w ⊗ d)ᵀ with the weights w of an element's nodes.
struct ConstraintRow {
  int element;
  ElementNodes nodes;
  Eigen::Matrix<float, 8, 1> weights;
  Eigen::Vector3f direction;  ///< unit
  float stiffness;            ///< N/m

  /// (w ⊗ d)ᵀ p
  float displacement(const SingleField& p) const {
    Quad at = Quad::Zero();
    for (int n = 0; n < 8; ++n) at += weights[n] * p.col(nodes[n]);
    return direction.dot(at.head<3>());
  }

  /// k (w ⊗ d)ᵀ p
  float force(const SingleField& p) const { return stiffness * displacement(p); }

  /// y += force (w ⊗ d)
  void add(float force, SingleField& y) const {
    for (int n = 0; n < 8; ++n) y.col(nodes[n]).head<3>() += weights[n] * force * direction;
  }
};

}  // namespace cfem_cutting
