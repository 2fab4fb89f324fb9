#pragma once

#include "first_guess.h"

namespace cfem_cutting {

/// What a solve is to reach.
struct SolveGoal {
  double tolerance;         ///< > 0, of the residual, see below
  int max_iterations;       ///< in total
  double length;            ///< m, of a block
  double least_load = 0.0;  ///< N
};

/// Conjugate gradients in single precision, preconditioned by the multigrid cycle, inside iterative
/// refinement. Where rounding ends that, as in tissues of very different stiffness, residuals are taken in
/// double. Keeps its fields from solve to solve.
class ConjugateGradients {
 public:
  /// Solves A dx = b; held nodes keep their dx. The residual ‖b − A dx‖ over free nodes is relative to the
  /// largest of three: that with the free dx = 0, the least load, and the force of rounding (1e-15 ×
  /// stiffness × length) over the tolerance.
  /// @param dx initial guess, and the solution
  /// @param changes improve the guess first; nullptr: none
  SolveReport solve(const LinearSystem& system, const NodeField& b, NodeField& dx, const SolveGoal& goal,
                    RecentChanges* changes = nullptr);

 private:
  /// What preconditions, one after the other fails to be positive: with rotations that differ much from
  /// element to element a W-cycle may.
  enum class Preconditioner { kMultigrid, kAdaptedMultigrid, kNodeBlocks };
  struct Outcome {
    int iterations = 0;
    bool broke_down = false;  // the preconditioner is not positive
  };
  static Preconditioner next_after(Preconditioner failed, const LinearSystem& system);
  double reference(const LinearSystem& system, const NodeField& b, const NodeField& dx,
                   const SolveGoal& goal);
  double measure(const LinearSystem& system, const NodeField& b, const NodeField& dx, Precision precision);
  Outcome reduce(const LinearSystem& system, Preconditioner preconditioner, double goal, int max_iterations);

  NodeField last_, residual_;
  SingleField r_, x_, z_, p_, Ap_;
};

}  // namespace cfem_cutting
