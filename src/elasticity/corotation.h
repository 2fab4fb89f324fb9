#pragma once

#include "element_matrix.h"
#include "packed_stiffness.h"

namespace cfem_cutting {

/// Evaluates co-rotational (or linear) elements: batches of SIMD lanes, and one by one those that are flat or
/// inverted. Per element E = ½ uᵀ K u with u = Rᵀx − X; forces are −∂E/∂x with ∂R/∂x.
class Corotation {
 public:
  Corotation() = default;
  /// @param gradients of the elements, see ElementData; must outlive this
  Corotation(ElementsPointer elements, std::vector<const MeanGradient*> gradients, const Vec3& block_size,
             Kinematics kinematics);

  const ElementsPointer& elements() const { return elements_; }

  void respond(const NodeField& x, ThreadPool& pool, ElasticResponse& response) const;

 private:
  void pack_gradients();
  struct Totals;
  Totals respond_batch(int batch, const NodeField& x, double* forces,
                       std::vector<Mat3>& rotation_of_element) const;
  bool respond_singly(int element, const NodeField& x, double* force, double* rotation, double& energy) const;

  ElementsPointer elements_;
  std::vector<const MeanGradient*> gradient_;
  Vec3 block_size_ = Vec3::Zero();
  Kinematics kinematics_ = Kinematics::kCorotational;
  std::vector<double> packed_gradient_;         // (24 × lanes) each
  std::vector<std::size_t> gradient_of_batch_;  // offsets; batches that share a matrix have one
  PackedStiffness<double> stiffness_;
};

}  // namespace cfem_cutting
