#pragma once

#include <vector>

#include "multigrid.h"

namespace cfem_cutting {

/// Residuals are taken in double where less is asked for than single precision carries.
enum class Precision { kSingle, kDouble };
inline Precision precision_for(double tolerance) {
  return tolerance < 1e-5 ? Precision::kDouble : Precision::kSingle;
}

/// A symmetric positive definite system in node displacements, A = D + s Σ R K Rᵀ + Σ k (w ⊗ d)(w ⊗ d)ᵀ, in
/// which some nodes are held.
class LinearSystem {
 public:
  /// Sets the hierarchy up for this system.
  LinearSystem(Multigrid& multigrid, const ElasticModel& model, std::vector<Mat3> rotations,
               SystemValues values, const std::vector<int>& held, Precision precision);

  void apply(const NodeField& p, NodeField& y) const;
  void clear_held(NodeField& field) const;
  void clear_held(SingleField& field) const;
  const Multigrid& multigrid() const { return multigrid_; }
  void adapt_smoothers() const { multigrid_.adapt_smoothers(); }

 private:
  Multigrid& multigrid_;
  SystemValues values_;
  const std::vector<int>& held_;
  Precision precision_;
};

/// Forces of the constraints on the nodes at x, N.
void add_constraint_forces(const std::vector<PointConstraint>& constraints, const NodeField& x,
                           NodeField& forces);

/// Solves A dx = b by conjugate gradients in single precision, preconditioned by the V-cycle, inside
/// iterative refinement; held nodes keep their dx.
/// @param dx initial guess, and the solution
/// @param tolerance of ‖b − A dx‖ over free nodes, relative to that with the free dx = 0 or, if larger,
/// `least_load` (N)
/// @param max_iterations in total
/// @param length m, of a block: the size of dx below which there is only rounding
SolveReport solve(const LinearSystem& system, const NodeField& b, NodeField& dx, double tolerance,
                  int max_iterations, double length, double least_load = 0.0);

}  // namespace cfem_cutting
