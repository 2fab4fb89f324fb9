#pragma once

#include <vector>

#include "multigrid.h"

namespace cfem_cutting {

/// Of residuals: double where less is asked for than single precision carries.
enum class Precision { kSingle, kDouble };
inline Precision precision_for(double tolerance) {
  return tolerance < 1e-5 ? Precision::kDouble : Precision::kSingle;
}

/// A symmetric positive definite system in node displacements, A = D + s Σ R K Rᵀ + Σ k (w ⊗ d)(w ⊗ d)ᵀ, in
/// which some nodes are held.
class LinearSystem {
 public:
  /// Sets the hierarchy up for this system.
  /// @param rotations of the elements; exchanged for those of the last system, whose memory is of use
  LinearSystem(Multigrid& multigrid, const ElasticModel& model, std::vector<Mat3>&& rotations,
               SystemValues values, const std::vector<int>& held, Precision precision);

  /// r = b − A x on the free nodes, zero on the held ones.
  void residual(const NodeField& b, const NodeField& x, Precision precision, NodeField& r) const;
  Precision precision() const { return precision_; }  ///< to begin with
  const std::vector<int>& held() const { return held_; }
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

}  // namespace cfem_cutting
