#include "linear_system.h"

#include <Eigen/LU>
#include <cmath>

namespace cfem_cutting {
namespace {

/// A solve stops at this part of (stiffness × size) too: below it there is only rounding.
constexpr double kRounding = 1e-15;

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

/// Conjugate gradients from dx with residual r until ‖r‖ ≤ goal.
/// @return the iterations
int conjugate_gradients(const LinearSystem& system, NodeField& r, NodeField& dx, double goal,
                        int max_iterations) {
  NodeField z = system.precondition(r), p = z, Ap;
  double rz = r.cwiseProduct(z).sum();
  int iteration = 0;
  while (iteration < max_iterations && r.norm() > goal) {
    system.apply(p, Ap);
    system.clear_held(Ap);
    const double curvature = p.cwiseProduct(Ap).sum();
    if (!(curvature > 0.0)) break;
    const double step_length = rz / curvature;
    dx += step_length * p;
    r -= step_length * Ap;
    z = system.precondition(r);
    const double next_rz = r.cwiseProduct(z).sum();
    p = z + (next_rz / rz) * p;
    rz = next_rz;
    ++iteration;
  }
  return iteration;
}

}  // namespace

LinearSystem::LinearSystem(const ElementProduct& product, Eigen::VectorXd node_diagonal,
                           double stiffness_factor, const std::vector<PointConstraint>& constraints,
                           const std::vector<int>& held, Precision precision)
    : product_(product),
      node_diagonal_(std::move(node_diagonal)),
      stiffness_factor_(stiffness_factor),
      constraints_(constraints),
      held_(held),
      precision_(precision) {}

void LinearSystem::prepare(const ElasticModel& model) {
  inverse_blocks_ = product_.diagonal_blocks(model);
  double trace = 0.0;
  for (std::size_t n = 0; n < inverse_blocks_.size(); ++n) {
    inverse_blocks_[n] = stiffness_factor_ * inverse_blocks_[n] + node_diagonal_[n] * Mat3::Identity();
    trace += inverse_blocks_[n].trace();
  }
  node_stiffness_ = trace / (3.0 * inverse_blocks_.size());
  for (Mat3& block : inverse_blocks_) block = block.inverse().eval();
  for (int node : held_) inverse_blocks_[node].setZero();
  prepare_constraints();
}

void LinearSystem::prepare_constraints() {
  for (const PointConstraint& c : constraints_)
    if (c.stiffness > 0.0) stiff_constraints_.push_back(&c);
  const int count = static_cast<int>(stiff_constraints_.size());
  if (count == 0) return;
  Eigen::MatrixXd compliance(count, count);
  NodeField moved = NodeField::Zero(3, static_cast<Eigen::Index>(inverse_blocks_.size()));
  for (int i = 0; i < count; ++i) {
    const Embedding& at = stiff_constraints_[i]->at;
    for (int n = 0; n < 8; ++n)
      moved.col(at.nodes[n]) +=
          at.weights[n] * inverse_blocks_[at.nodes[n]] * stiff_constraints_[i]->direction;
    for (int j = 0; j < count; ++j)
      compliance(j, i) = stiff_constraints_[j]->direction.dot(stiff_constraints_[j]->at.apply(moved));
    compliance(i, i) += 1.0 / stiff_constraints_[i]->stiffness;
    for (int node : at.nodes) moved.col(node).setZero();
  }
  constraint_compliance_.compute(compliance);
}

void LinearSystem::apply(const NodeField& p, NodeField& y) const {
  product_.apply(p, y, precision_);
  for (Eigen::Index n = 0; n < p.cols(); ++n)
    y.col(n) = stiffness_factor_ * y.col(n) + node_diagonal_[n] * p.col(n);
  for (const PointConstraint& c : constraints_) {
    const Vec3 force = c.stiffness * c.direction.dot(c.at.apply(p)) * c.direction;
    for (int n = 0; n < 8; ++n) y.col(c.at.nodes[n]) += c.at.weights[n] * force;
  }
}

NodeField LinearSystem::precondition(const NodeField& r) const {
  NodeField z(3, r.cols());
  for (Eigen::Index n = 0; n < r.cols(); ++n) z.col(n).noalias() = inverse_blocks_[n] * r.col(n);
  if (stiff_constraints_.empty()) return z;
  Eigen::VectorXd along(stiff_constraints_.size());
  for (std::size_t i = 0; i < stiff_constraints_.size(); ++i)
    along[i] = stiff_constraints_[i]->direction.dot(stiff_constraints_[i]->at.apply(z));
  along = constraint_compliance_.solve(along).eval();
  for (std::size_t i = 0; i < stiff_constraints_.size(); ++i) {
    const PointConstraint& c = *stiff_constraints_[i];
    for (int n = 0; n < 8; ++n)
      z.col(c.at.nodes[n]) -= c.at.weights[n] * along[i] * inverse_blocks_[c.at.nodes[n]] * c.direction;
  }
  return z;
}

void LinearSystem::clear_held(NodeField& field) const {
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
  const double rounding =
      kRounding * system.node_stiffness() * length * std::sqrt(static_cast<double>(dx.cols()));
  const double goal = std::max(tolerance * load, rounding);

  SolveReport report;
  const int restarts = 4;  // recurrences drift from the true residual
  for (int restart = 0; restart < restarts; ++restart) {
    NodeField r = residual(system, b, dx);
    report.residual = load > 0.0 ? r.norm() / load : 0.0;
    report.converged = r.norm() <= goal;
    if (report.converged || report.iterations >= max_iterations) break;
    report.iterations += conjugate_gradients(system, r, dx, 0.9 * goal, max_iterations - report.iterations);
    report.residual = load > 0.0 ? r.norm() / load : 0.0;
    report.converged = r.norm() <= goal;
  }
  return report;
}

}  // namespace cfem_cutting
