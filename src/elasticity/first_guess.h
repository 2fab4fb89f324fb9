#pragma once

#include <array>

#include "linear_system.h"

namespace cfem_cutting {

/// Directions along which a step's solution is likely to differ from the last step's: what changed the
/// velocities in the last steps. Keeps its fields from step to step.
class RecentChanges {
 public:
  void take(const ElasticState& state, ThreadPool& pool);

  /// Moves x by the combination of directions that minimises the energy ½ x·A x − b·x (Fischer 1998,
  /// "Projection techniques for iterative solution of Ax = b with successive right-hand sides").
  /// @param r b − A x before and after
  void minimise(const LinearSystem& system, SingleField& r, SingleField& x);

 private:
  struct Direction {
    SingleField p, Ap;
    double curvature;  // p·Ap
  };
  void make_conjugate(const LinearSystem& system, int i);

  std::array<Direction, 2> directions_;
  int count_ = 0;
};

}  // namespace cfem_cutting
