#include "equilibrium.h"

#include <algorithm>
#include <cmath>

#include "cfem_cutting/elasticity/floating.h"

namespace cfem_cutting {
namespace {

constexpr double kWeakSpring = 1e-3;       // of E h
constexpr double kNegligibleForce = 1e-6;  // of E h²
constexpr double kLoosestSolve = 0.1;      // inner tolerance
constexpr double kPartOfFirst = 1e-2;      // of the first residual: what residuals are relative to at least
constexpr double kTightestSolve = 1e-13;
// Steps that gain less of the forces' size tell nothing of the tangent, but near equilibrium (residual),
// where little gain is the tangent's fault.
constexpr double kGoodGain = 0.7, kNear = 1e-2;

/// Of a Newton step's solve: as loose as the last step was poor (Eisenstat and Walker 1996, choice 2), and no
/// tighter than the whole needs.
/// @param gain of the forces' size, the last step's; 1: there was none
double inner_tolerance(double tolerance, double gain, double residual) {
  constexpr double kForcing = 0.9, kLeft = 0.3;
  const double needed = kLeft * tolerance / std::max(residual, 1e-300);
  return std::clamp(std::max(kForcing * gain * gain, needed), kTightestSolve, kLoosestSolve);
}

}  // namespace

Equilibrium::Equilibrium(const ElasticModel& model, const NodeField& start, const Vec3& gravity,
                         const HeldNodes& held, const std::vector<PointConstraint>& constraints)
    : model_(model),
      start_(start),
      held_(held),
      constraints_(constraints),
      spring_(Eigen::VectorXd::Zero(start.cols())) {
  find_floating_nodes();
  weight_ = gravity * model.mass().transpose();
  for (Eigen::Index n = 0; n < start.cols(); ++n)
    if (spring_[n] > 0.0) weight_.col(n).setZero();
}

void Equilibrium::find_floating_nodes() {
  std::vector<int> holding = held_.nodes;
  for (const PointConstraint& c : constraints_) holding.push_back(c.at.nodes[0]);
  const std::vector<char> floating = floating_nodes(model_.mesh(), holding);

  // The stiffest element stands for E h.
  double stiffness = 0.0;
  for (const MatrixPointer& K : model_.elements()->set.stiffness)
    stiffness = std::max(stiffness, K->trace / 24.0);
  force_unit_ = stiffness * model_.mesh().block_size().mean();
  for (int node = 0; node < model_.mesh().node_count(); ++node)
    if (floating[node]) spring_[node] = kWeakSpring * stiffness;
}

void Equilibrium::clear_held(NodeField& field) const {
  for (int node : held_.nodes) field.col(node).setZero();
}

double Equilibrium::energy(const ElasticResponse& elastic, const NodeField& x) const {
  const NodeField moved = x - start_;
  double sum = elastic.energy - weight_.cwiseProduct(moved).sum();
  for (Eigen::Index n = 0; n < x.cols(); ++n) sum += 0.5 * spring_[n] * moved.col(n).squaredNorm();
  for (const PointConstraint& c : constraints_) {
    const double gap = c.target - c.direction.dot(c.at.apply(x));
    sum += c.multiplier * gap + 0.5 * c.stiffness * gap * gap;
  }
  return sum;
}

NodeField Equilibrium::forces(const ElasticResponse& elastic, const NodeField& x) const {
  NodeField forces = elastic.forces + weight_ - (x - start_) * spring_.asDiagonal();
  add_constraint_forces(constraints_, x, forces);
  return forces;
}

double Equilibrium::load(const NodeField& forces) const {
  double squares = weight_.squaredNorm();
  for (int node : held_.nodes) squares += forces.col(node).squaredNorm();
  for (const PointConstraint& c : constraints_) squares += c.multiplier * c.multiplier;
  return std::max(std::sqrt(squares), kNegligibleForce * force_unit_);
}

double Equilibrium::rounding(const NodeField& x) const {
  const double extent = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  return 4e-16 * force_unit_ / model_.mesh().block_size().mean() * extent *
         std::sqrt(static_cast<double>(x.size()));
}

SolveReport Equilibrium::solve_newton(Multigrid& multigrid, ConjugateGradients& solver,
                                      const SolverOptions& options, NodeField& x, int max_newton) {
  SolveReport total;
  double initial = 0.0;
  NodeField last_x, last_f;
  model_.respond(x, multigrid.pool(), elastic_);
  for (int newton = 0;; ++newton) {
    NodeField f = forces(elastic_, x);
    const double reference = std::max(load(f), kPartOfFirst * initial);
    clear_held(f);
    const bool held_in_place = are_held(x);
    const double size = f.norm();
    initial = std::max(initial, size);
    total.residual = size / reference;
    total.inverted_elements = elastic_.inverted;
    total.converged = held_in_place && (total.residual <= options.tolerance || size <= rounding(x));
    if (total.converged || newton == max_newton) return total;
    const double gain = newton > 0 ? size / last_f.norm() : 1.0;
    if (last_x.cols() > 0 && (total.residual < kNear || gain < kGoodGain)) {
      secants_.add(x - last_x, last_f - f);
    } else {
      secants_.clear();
    }
    last_x = held_in_place ? x : NodeField();
    last_f = f;
    const double inner = inner_tolerance(options.tolerance, gain, total.residual);
    if (!newton_step(multigrid, solver, options, inner, f, x, total)) return total;
  }
}

bool Equilibrium::are_held(const NodeField& x) const {
  for (std::size_t i = 0; i < held_.nodes.size(); ++i)
    if (x.col(held_.nodes[i]) != held_.positions[i]) return false;
  return true;
}

/// @return false if no step along the direction lowers the energy
bool Equilibrium::newton_step(Multigrid& multigrid, ConjugateGradients& solver, const SolverOptions& options,
                              double tolerance, const NodeField& f, NodeField& x, SolveReport& total) {
  const LinearSystem system(multigrid, model_, std::move(elastic_.rotations), {spring_, 1.0, &constraints_},
                            held_.nodes, precision_for(tolerance));
  const SolveGoal goal{tolerance, options.max_iterations, model_.mesh().block_size().mean()};
  NodeField held_dx = NodeField::Zero(3, x.cols());
  for (std::size_t i = 0; i < held_.nodes.size(); ++i)
    held_dx.col(held_.nodes[i]) = held_.positions[i] - x.col(held_.nodes[i]);
  const auto solve = [&](const NodeField& load) {
    NodeField dx = held_dx;
    total.iterations += solver.solve(system, load, dx, goal).iterations;
    return dx;
  };
  ThreadPool& pool = multigrid.pool();
  if (!are_held(x)) {
    x += solve(f);
    for (std::size_t i = 0; i < held_.nodes.size(); ++i) x.col(held_.nodes[i]) = held_.positions[i];
    model_.respond(x, pool, elastic_);
    return true;
  }
  if (search_line(pool, secants_.direction(f, solve), f, x)) return true;
  if (secants_.empty()) return false;
  secants_.clear();
  model_.respond(x, pool, elastic_);
  return search_line(pool, solve(f), f, x);
}

/// Backtracking to a sufficient decrease of the energy (Armijo 1966), up to its rounding.
bool Equilibrium::search_line(ThreadPool& pool, const NodeField& dx, const NodeField& f, NodeField& x) {
  const double slope = -f.cwiseProduct(dx).sum();
  const double before = energy(elastic_, x);
  const double size = std::abs(before) + kNegligibleForce * force_unit_ * model_.mesh().block_size().mean();
  for (double length = 1.0; length > 1e-4; length *= 0.5) {
    const NodeField moved = x + length * dx;
    model_.respond(moved, pool, elastic_);
    if (!(energy(elastic_, moved) <= before + 1e-4 * length * slope + 1e-12 * size)) continue;
    x = moved;
    return true;
  }
  return false;
}

}  // namespace cfem_cutting
