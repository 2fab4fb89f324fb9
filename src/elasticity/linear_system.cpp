#include "linear_system.h"

#include <cmath>
#include <limits>

namespace cfem_cutting {
namespace {

/// A solve stops at this part of (stiffness × size) too: below it there is only rounding.
constexpr double kRounding = 1e-15;

/// Conjugate gradients in single precision reduce a residual by no more than this at once.
constexpr double kMostReduction = 1e-4;

/// b − A dx on the free nodes.
NodeField residual(const LinearSystem& system, const NodeField& b, const NodeField& dx) {
  NodeField r;
  system.apply(dx, r);
  r = b - r;
  system.clear_held(r);
  return r;
}

/// ‖b − A dx‖ on the free nodes for the held dx alone.
double free_load(const LinearSystem& system, const NodeField& b, const NodeField& dx) {
  NodeField free_part = dx;
  system.clear_held(free_part);
  const NodeField held_part = dx - free_part;
  if (!held_part.isZero(0.0)) return residual(system, b, held_part).norm();
  NodeField load = b;
  system.clear_held(load);
  return load.norm();
}

double dot(const SingleField& a, const SingleField& b) {
  double sum = 0.0;
  for (Eigen::Index n = 0; n < a.cols(); ++n) sum += a.col(n).dot(b.col(n));
  return sum;
}

/// x ≈ A⁻¹ r by conjugate gradients until the residual, which r becomes, is `goal` at most.
/// @return the iterations
int conjugate_gradients(const LinearSystem& system, SingleField& r, SingleField& x, double goal,
                        int max_iterations) {
  SingleField z, p, Ap;
  x = SingleField::Zero(3, r.cols());
  system.multigrid().precondition(r, z);
  p = z;
  double rz = dot(r, z);
  int iteration = 0;
  while (iteration < max_iterations && std::sqrt(dot(r, r)) > goal) {
    system.multigrid().finest().apply(p, Ap);
    system.clear_held(Ap);
    const double curvature = dot(p, Ap);
    if (!(curvature > 0.0)) break;
    const auto length = static_cast<float>(rz / curvature);
    x += length * p;
    r -= length * Ap;
    ++iteration;
    if (!(std::sqrt(dot(r, r)) > goal)) break;
    system.multigrid().precondition(r, z);
    const double next_rz = dot(r, z);
    p = z + static_cast<float>(next_rz / rz) * p;
    rz = next_rz;
  }
  return iteration;
}

}  // namespace

LinearSystem::LinearSystem(Multigrid& multigrid, const ElasticModel& model, std::vector<Mat3> rotations,
                           SystemValues values, const std::vector<int>& held, Precision precision)
    : multigrid_(multigrid), values_(std::move(values)), held_(held), precision_(precision) {
  multigrid_.arrange(model, held);
  multigrid_.set(std::move(rotations), values_);
}

void LinearSystem::apply(const NodeField& p, NodeField& y) const {
  const ElementProduct& product = multigrid_.finest().product();
  if (precision_ == Precision::kDouble) {
    product.apply(p, y);
  } else {
    SingleField sum;
    product.apply(p.cast<float>(), sum);
    y = sum.cast<double>();
  }
  for (Eigen::Index n = 0; n < p.cols(); ++n)
    y.col(n) = values_.stiffness_factor * y.col(n) + values_.node_diagonal[n] * p.col(n);
  for (const PointConstraint& c : *values_.constraints) {
    const Vec3 force = c.stiffness * c.direction.dot(c.at.apply(p)) * c.direction;
    for (int n = 0; n < 8; ++n) y.col(c.at.nodes[n]) += c.at.weights[n] * force;
  }
}

void LinearSystem::clear_held(NodeField& field) const {
  for (int node : held_) field.col(node).setZero();
}

void LinearSystem::clear_held(SingleField& field) const {
  for (int node : held_) field.col(node).setZero();
}

void add_constraint_forces(const std::vector<PointConstraint>& constraints, const NodeField& x,
                           NodeField& forces) {
  for (const PointConstraint& c : constraints)
    for (int n = 0; n < 8; ++n) forces.col(c.at.nodes[n]) += c.at.weights[n] * c.force(x) * c.direction;
}

SolveReport solve(const LinearSystem& system, const NodeField& b, NodeField& dx, double tolerance,
                  int max_iterations, double length) {
  const double load = free_load(system, b, dx);
  const double rounding = kRounding * system.multigrid().finest().mean_stiffness() * length *
                          std::sqrt(static_cast<double>(dx.cols()));
  const double goal = std::max(tolerance * load, rounding);

  SolveReport report;
  for (double before = std::numeric_limits<double>::infinity();;) {
    const NodeField r = residual(system, b, dx);
    const double size = r.norm();
    report.residual = load > 0.0 ? size / load : 0.0;
    report.converged = size <= goal;
    const bool stagnates = !(size < 0.5 * before);
    if (report.converged || report.iterations >= max_iterations || stagnates) return report;
    before = size;
    SingleField scaled = (r / size).cast<float>(), change;
    report.iterations +=
        conjugate_gradients(system, scaled, change, std::max(0.9 * goal / size, kMostReduction),
                            max_iterations - report.iterations);
    dx += size * change.cast<double>();
  }
}

}  // namespace cfem_cutting
