#include "conjugate_gradients.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "node_loops.h"

namespace cfem_cutting {
namespace {

/// A solve stops at this part of (stiffness × size) too: below it there is only rounding.
constexpr double kRounding = 1e-15;

/// Conjugate gradients in single precision reduce a residual by no more than this at once.
constexpr double kMostReduction = 1e-5;

double norm(ThreadPool& pool, const NodeField& field) { return std::sqrt(dot(pool, field, field)); }

void set_zero(ThreadPool& pool, Eigen::Index count, SingleField& field) {
  field.resize(4, count);
  for_each_node(pool, count, [&](int n) { field.col(n).setZero(); });
}

}  // namespace

/// What residuals are relative to. The load of the held nodes' dx counts, that of the free ones' does not.
double ConjugateGradients::reference(const LinearSystem& system, const NodeField& b, const NodeField& dx,
                                     const SolveGoal& goal) {
  ThreadPool& pool = system.multigrid().pool();
  last_.setZero(3, dx.cols());
  bool moves = false;
  for (int node : system.held()) {
    last_.col(node) = dx.col(node);
    moves = moves || !dx.col(node).isZero(0.0);
  }
  if (moves) {
    system.residual(b, last_, system.precision(), residual_);
  } else {
    residual_ = b;
    system.clear_held(residual_);
  }
  const double rounding = kRounding * system.multigrid().finest().mean_stiffness() * goal.length *
                          std::sqrt(static_cast<double>(dx.cols()));
  return std::max({norm(pool, residual_), goal.least_load, rounding / goal.tolerance});
}

/// @return the size of the residual, which it leaves in residual_, N
double ConjugateGradients::measure(const LinearSystem& system, const NodeField& b, const NodeField& dx,
                                   Precision precision) {
  system.residual(b, dx, precision, residual_);
  return norm(system.multigrid().pool(), residual_);
}

/// Moves x_ towards A⁻¹ b until its residual r_ is `goal` at most.
ConjugateGradients::Outcome ConjugateGradients::reduce(const LinearSystem& system,
                                                       Preconditioner preconditioner, double goal,
                                                       int max_iterations) {
  const Multigrid& multigrid = system.multigrid();
  const int count = static_cast<int>(r_.cols());
  ThreadPool& pool = multigrid.pool();
  double rz = 1.0;
  double size = std::sqrt(dot(pool, r_, r_));
  Outcome outcome;
  int& iteration = outcome.iterations;
  set_zero(pool, count, p_);
  for (; iteration < max_iterations && size > goal; ++iteration) {
    if (preconditioner == Preconditioner::kNodeBlocks) {
      multigrid.finest().scale(r_, z_);
    } else {
      multigrid.precondition(r_, z_);
    }
    const double next_rz = dot(pool, r_, z_);
    outcome.broke_down = !(next_rz > 0.0);
    if (outcome.broke_down) break;
    const auto keep = static_cast<float>(iteration > 0 ? next_rz / rz : 0.0);
    rz = next_rz;
    for_each_node(pool, count, [&](int n) { p_.col(n) = z_.col(n) + keep * p_.col(n); });
    multigrid.finest().apply(p_, Ap_);
    system.clear_held(Ap_);
    const double curvature = dot(pool, p_, Ap_);
    if (!(curvature > 0.0)) break;
    const auto length = static_cast<float>(rz / curvature);
    size = std::sqrt(sum_over_nodes(pool, count, [&](int n) {  // takes the step, too
      x_.col(n) += length * p_.col(n);
      r_.col(n) -= length * Ap_.col(n);
      return r_.col(n).cwiseAbs2();
    }));
  }
  return outcome;
}

ConjugateGradients::Preconditioner ConjugateGradients::next_after(Preconditioner failed,
                                                                  const LinearSystem& system) {
  if (failed != Preconditioner::kMultigrid) return Preconditioner::kNodeBlocks;
  system.adapt_smoothers();
  return Preconditioner::kAdaptedMultigrid;
}

SolveReport ConjugateGradients::solve(const LinearSystem& system, const NodeField& b, NodeField& dx,
                                      const SolveGoal& goal, RecentChanges* changes) {
  assert(goal.tolerance > 0.0);
  ThreadPool& pool = system.multigrid().pool();
  const Eigen::Index count = dx.cols();
  const double relative_to = reference(system, b, dx, goal);
  SolveReport report;
  report.converged = false;  // nor if the load is not finite
  last_ = dx;
  auto preconditioner = Preconditioner::kMultigrid;
  auto precision = system.precision();
  bool broke_down = false;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (double before = kInfinity;;) {
    double size = measure(system, b, dx, precision);
    if (precision == Precision::kSingle && !broke_down && !(size < 0.9 * before)) {
      precision = Precision::kDouble;
      before = kInfinity;
      size = measure(system, b, dx, precision);
    }
    if (!(size < before) && !(broke_down && size == before)) {  // rounding, or worse
      dx = last_;
      return report;
    }
    report.residual = size / relative_to;
    report.converged = report.residual <= goal.tolerance;
    const bool stagnates = !broke_down && !(size < 0.9 * before);
    if (report.converged || report.iterations >= goal.max_iterations || stagnates) return report;
    r_.resize(4, count);
    for_each_node(pool, count, [&](int n) { r_.col(n) << (residual_.col(n) / size).cast<float>(), 0.0f; });
    set_zero(pool, count, x_);
    if (changes && report.iterations == 0) changes->minimise(system, r_, x_);
    before = size;
    const Outcome outcome =
        reduce(system, preconditioner, std::max(0.8 * goal.tolerance * relative_to / size, kMostReduction),
               goal.max_iterations - report.iterations);
    report.iterations += outcome.iterations;
    broke_down = outcome.broke_down && preconditioner != Preconditioner::kNodeBlocks;
    if (broke_down) {
      preconditioner = next_after(preconditioner, system);
    } else {
      last_ = dx;
      for_each_node(pool, count, [&](int n) { dx.col(n) += size * x_.col(n).head<3>().cast<double>(); });
    }
  }
}

}  // namespace cfem_cutting
