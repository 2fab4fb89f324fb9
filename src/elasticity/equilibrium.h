#pragma once

#include <vector>

#include "conjugate_gradients.h"
#include "secant_pairs.h"

namespace cfem_cutting {

/// A static problem: elastic energy, weight, constraints, and weak springs on pieces that nothing holds.
class Equilibrium {
 public:
  /// @param start positions at which the springs of floating nodes are at rest, m
  Equilibrium(const ElasticModel& model, const NodeField& start, const Vec3& gravity, const HeldNodes& held,
              const std::vector<PointConstraint>& constraints);

  /// Newton's method with backtracking. The tangent leaves out ∂R/∂x; secants make up for it. (Without them
  /// convergence would be linear, at a rate of about the strain.)
  SolveReport solve_newton(Multigrid& multigrid, ConjugateGradients& solver, const SolverOptions& options,
                           NodeField& x, int max_newton);

 private:
  double energy(const ElasticResponse& elastic, const NodeField& x) const;     // J
  NodeField forces(const ElasticResponse& elastic, const NodeField& x) const;  // N, also on held nodes
  double load(const NodeField& forces) const;  // N, size of what acts on the tissue
  double rounding(const NodeField& x) const;   // N, of a sum of forces at x
  bool newton_step(Multigrid& multigrid, ConjugateGradients& solver, const SolverOptions& options,
                   double tolerance, const NodeField& forces, NodeField& x, SolveReport& total);
  bool search_line(ThreadPool& pool, const NodeField& dx, const NodeField& forces, NodeField& x);
  void find_floating_nodes();
  void clear_held(NodeField& field) const;
  bool are_held(const NodeField& x) const;

  const ElasticModel& model_;
  NodeField start_;
  HeldNodes held_;
  const std::vector<PointConstraint>& constraints_;
  Eigen::VectorXd spring_;   // N/m, per node; 0 unless floating
  NodeField weight_;         // N
  double force_unit_;        // N, E h²
  ElasticResponse elastic_;  // where Newton's method is
  SecantPairs secants_;
};

}  // namespace cfem_cutting
