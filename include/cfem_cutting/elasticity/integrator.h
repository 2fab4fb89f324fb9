#pragma once

#include <array>
#include <memory>
#include <vector>

#include "cfem_cutting/elasticity/elastic_model.h"

namespace cfem_cutting {

/// Node positions and velocities.
struct ElasticState {
  NodeField x;  ///< m
  NodeField v;  ///< m/s
  /// m/s, of the steps before, the latest first; empty: none. Only first guesses of solves use them.
  std::array<NodeField, 2> past_v{};
};

/// Nodes whose positions are prescribed at the end of the step.
struct HeldNodes {
  std::vector<int> nodes;
  std::vector<Vec3> positions;  ///< m
};

/// A penalty on one direction of a material point, with a multiplier: the force on the point along
/// `direction` is multiplier + stiffness · (target − direction · x), N.
struct PointConstraint {
  Embedding at;
  Vec3 direction;           ///< unit
  double target = 0.0;      ///< m, along direction
  double stiffness = 0.0;   ///< N/m
  double multiplier = 0.0;  ///< N
  double force(const NodeField& x) const {
    return multiplier + stiffness * (target - direction.dot(at.apply(x)));
  }
};

struct SolverOptions {
  double tolerance = 1.0e-4;         ///< relative residual of a linear solve
  int max_iterations = 100;          ///< of a linear solve
  double rayleigh_mass = 0.1;        ///< 1/s
  double rayleigh_stiffness = 0.01;  ///< s
  int threads = 0;                   ///< 0: as many as there are cores
};

struct SolveReport {
  int iterations = 0;     ///< of conjugate gradients, summed (the first guess takes two products beside)
  double residual = 0.0;  ///< relative, of the last linear solve
  bool converged = true;
  int inverted_elements = 0;  ///< flat or inverted elements where the last tangent was taken
};

/// Time integration and equilibrium of an elastic model.
class Integrator {
 public:
  explicit Integrator(const SolverOptions& options);
  ~Integrator();

  /// One step of implicit Euler with Rayleigh damping, linearised once at the current rotations:
  /// ((1/dt² + α/dt) M + (1 + β/dt) K) Δx = M v/dt + f(x) + gravity + constraints.
  /// @param gravity m/s²
  SolveReport step(const ElasticModel& model, ElasticState& state, double dt, const Vec3& gravity,
                   const HeldNodes& held, const std::vector<PointConstraint>& constraints);

  /// Moves x to static equilibrium by Newton's method with line search on the energy. Pieces that nothing
  /// holds stay where they are (`floating` nodes feel no gravity and a weak spring to where they started).
  SolveReport equilibrate(const ElasticModel& model, NodeField& x, const Vec3& gravity, const HeldNodes& held,
                          const std::vector<PointConstraint>& constraints, int max_newton = 60);

 private:
  struct Workspace;
  SolverOptions options_;
  std::unique_ptr<Workspace> workspace_;
};

/// Forces that the holders exert on the held nodes in equilibrium, N: minus elastic forces, weight and
/// constraint forces there. One per held node.
std::vector<Vec3> reactions(const ElasticModel& model, const NodeField& x, const Vec3& gravity,
                            const HeldNodes& held, const std::vector<PointConstraint>& constraints);

}  // namespace cfem_cutting
