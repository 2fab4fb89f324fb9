#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "direct_solver.h"
#include "node_block.h"

namespace cfem_cutting {

/// What the smoother does: a Chebyshev polynomial of this degree damps the eigenvalues from a part of the
/// largest one to that.
struct Smoothing {
  int degree;
  double part;
};

/// The system of one level in single precision, A = D + s Σ R K Rᵀ + Σ k (w ⊗ d)(w ⊗ d)ᵀ, with its smoother.
class LevelSystem {
 public:
  explicit LevelSystem(ThreadPool& pool) : product_(pool) {}

  /// Takes over a new mesh.
  /// @param held per node: zero displacement
  void arrange(ElementsPointer elements, std::vector<char> held);

  /// Takes over what hardly ever changes; before the next `set`.
  /// @param node_diagonal N/m, per node
  /// @param stiffness_factor s
  void set_diagonal(Eigen::VectorXf node_diagonal, float stiffness_factor);

  /// Takes over what changes from solve to solve.
  void set(std::vector<Mat3>&& rotations, std::vector<ConstraintRow> constraints);

  const ElementProduct& product() const { return product_; }
  const std::vector<char>& held() const { return held_; }
  const Eigen::VectorXf& node_diagonal() const { return node_diagonal_; }
  const std::vector<ConstraintRow>& constraints() const { return constraints_; }

  /// An estimate of M⁻¹ A's largest eigenvalue, right after `arrange`, by some steps of conjugate gradients.
  double largest_at_rest(int steps);
  void expect_largest(double eigenvalue);

  /// Estimates the largest eigenvalue anew, for the rotations as they are.
  void estimate_largest();

  /// z = M⁻¹ r by the nodes' blocks and the constraints: positive whatever the rotations.
  void scale(const SingleField& r, SingleField& z) const { scale(r, 1.0f, z); }

  float mean_stiffness() const;                                                ///< N/m, of a node's diagonal
  double inertia() const { return node_diagonal_.mean() / mean_stiffness(); }  ///< the part of D in that
  void smooth_with(Smoothing smoothing) { smoothing_ = smoothing; }

  /// y = A p; rows of held nodes are without meaning.
  void apply(const SingleField& p, SingleField& y) const;

  /// r = b − A x; rows of held nodes are without meaning.
  void residual(const SingleField& b, const SingleField& x, SingleField& r) const;

  /// x from zero towards A⁻¹ b.
  /// @return b − A x, until the next smoothing
  const SingleField& smooth_from_zero(const SingleField& b, SingleField& x) const;

  /// x on towards A⁻¹ b.
  void smooth(const SingleField& b, SingleField& x) const;

  /// x = A⁻¹ b by factors, which `factorise` makes.
  void factorise();
  void solve(const SingleField& b, SingleField& x) const { direct_.solve(b, x); }

 private:
  template <typename Work>
  void for_nodes(const Work& work) const;
  struct Chebyshev;
  void sweep(float keep, float add, const SingleField& b, const SingleField& x, SingleField& before,
             bool ignores_before) const;
  void sweep_on(Chebyshev& chebyshev, const SingleField& b, SingleField& x, bool from_zero) const;
  void scale(const SingleField& r, float factor, SingleField& z) const;
  void correct_for_constraints(const Eigen::VectorXf& kept, SingleField& z) const;
  void add_scaled_to_nodes(const ConstraintRow& row, float force, SingleField& y) const;
  void prepare_constraints();
  void invert_blocks();
  double largest_eigenvalue(int max_steps) const;

  ElementProduct product_;
  Smoothing smoothing_{1, 0.1};
  std::vector<char> held_;
  double mean_at_rest_ = 0.0;  // N/m, of a node's diagonal in Σ K
  double largest_ = 0.0;       // of M⁻¹ A's eigenvalues, at rest or adapted; 0: not known yet
  Eigen::VectorXf node_diagonal_;
  float stiffness_factor_ = 1.0f;
  std::vector<ConstraintRow> constraints_;
  bool inverse_fits_ = false;
  std::vector<NodeBlock> inverse_;           // m/N, M⁻¹ without constraints; zero for held nodes
  Eigen::LDLT<Eigen::MatrixXf> compliance_;  // m/N, of the constraints: k⁻¹ + Cᵀ D⁻¹ C
  DirectSolver direct_;
  mutable SingleField before_;  // the last sweep's x, or a residual
};

}  // namespace cfem_cutting
