#pragma once

#include <deque>
#include <vector>

#include "cfem_cutting/elasticity/composite_mesh.h"

namespace cfem_cutting {

/// What the last steps towards an equilibrium tell about the true tangent, which the one that is solved with
/// only comes near (L-BFGS: Nocedal 1980; with a solver of elasticity as its first guess: Liu, Bouaziz and
/// Kavan 2017).
class SecantPairs {
 public:
  /// Takes over the last step; the oldest is forgotten.
  /// @param step m
  /// @param drop N, by how much the forces fell
  void add(NodeField step, NodeField drop);

  void clear() { pairs_.clear(); }
  bool empty() const { return pairs_.empty(); }

  /// Where forces push to, m.
  /// @param solve takes a load, N, to a displacement, m, by the tangent at hand
  template <typename Solve>
  NodeField direction(NodeField forces, const Solve& solve) const {
    const std::vector<double> parts = take_parts(forces);
    NodeField direction = solve(forces);
    put_parts(parts, direction);
    return direction;
  }

 private:
  struct Pair {
    NodeField step, drop;
    double work;  // J, step · drop: positive
  };
  std::vector<double> take_parts(NodeField& forces) const;
  void put_parts(const std::vector<double>& parts, NodeField& direction) const;
  std::deque<Pair> pairs_;  // the newest first
};

}  // namespace cfem_cutting
