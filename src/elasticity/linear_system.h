#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "cfem_cutting/elasticity/integrator.h"
#include "element_product.h"

namespace cfem_cutting {

/// A symmetric positive definite system in node displacements, A = D + s Σ R K Rᵀ + Σ k (w ⊗ d)(w ⊗ d)ᵀ, in
/// which some nodes are held.
class LinearSystem {
 public:
  /// @param node_diagonal N/m, added to each axis of a node
  /// @param stiffness_factor s
  LinearSystem(const ElementProduct& product, Eigen::VectorXd node_diagonal, double stiffness_factor,
               const std::vector<PointConstraint>& constraints, const std::vector<int>& held,
               Precision precision);

  /// Builds the preconditioner: the inverse of the nodes' diagonal blocks together with the constraints,
  /// which are stiff and few (Woodbury's formula).
  void prepare(const ElasticModel& model);

  void apply(const NodeField& p, NodeField& y) const;
  NodeField precondition(const NodeField& r) const;
  void clear_held(NodeField& field) const;

  /// Typical stiffness of a node, N/m.
  double node_stiffness() const { return node_stiffness_; }

 private:
  void prepare_constraints();

  const ElementProduct& product_;
  Eigen::VectorXd node_diagonal_;
  double stiffness_factor_;
  const std::vector<PointConstraint>& constraints_;
  const std::vector<int>& held_;
  Precision precision_;
  std::vector<Mat3> inverse_blocks_;  // m/N, D⁻¹; zero for held nodes
  std::vector<const PointConstraint*> stiff_constraints_;
  Eigen::LDLT<Eigen::MatrixXd> constraint_compliance_;  // m/N, k⁻¹ + CᵀD⁻¹C
  double node_stiffness_ = 0.0;
};

/// Forces of the constraints on the nodes at x, N.
void add_constraint_forces(const std::vector<PointConstraint>& constraints, const NodeField& x,
                           NodeField& forces);

/// Solves A dx = b by preconditioned conjugate gradients; held nodes keep their dx.
/// @param dx initial guess, and the solution
/// @param tolerance of ‖b − A dx‖ over free nodes, relative to that with the free dx = 0
/// @param max_iterations in total
SolveReport solve(const LinearSystem& system, const NodeField& b, NodeField& dx, double tolerance,
                  int max_iterations, double length);

}  // namespace cfem_cutting
