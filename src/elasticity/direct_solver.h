#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "constraint_row.h"

namespace cfem_cutting {

/// Solves the system of a coarsest level by Cholesky's factors. Sparse: tissue in many pieces has many
/// coarsest elements.
class DirectSolver {
 public:
  /// Takes over A = D + s Σ R K Rᵀ + Σ k (w ⊗ d)(w ⊗ d)ᵀ.
  /// @param node_diagonal N/m, per node, what makes the system regular included
  /// @param held per node: zero displacement
  void factorise(const ElementProduct& product, float stiffness_factor, const Eigen::VectorXf& node_diagonal,
                 const std::vector<ConstraintRow>& constraints, const std::vector<char>& held);

  /// The elements are others now. (Constraints are on one element's nodes each and add no entries.)
  void forget_pattern() { analysed_ = false; }

  /// x = A⁻¹ b
  void solve(const SingleField& b, SingleField& x) const;

 private:
  void add(int row_node, int column_node, const Mat3& block);

  bool analysed_ = false;
  std::vector<char> held_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

}  // namespace cfem_cutting
