#include "linear_system.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cfem_cutting {
namespace {

/// A solve stops at this part of (stiffness × size) too: below it there is only rounding.
constexpr double kRounding = 1e-15;

/// Conjugate gradients in single precision reduce a residual by no more than this at once.
constexpr double kMostReduction = 1e-5;

constexpr int kFewest = 2048;  // nodes worth waking a thread for

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

/// Σ term(n) over nodes in parts of fixed size, so that the sum is the same for any number of threads.
template <typename Term>
double sum_over_nodes(ThreadPool& pool, int count, const Term& term) {
  constexpr int kPart = 1024;
  std::vector<double> sums(count / kPart + 1, 0.0);
  pool.for_range(static_cast<int>(sums.size()), 2, [&](int begin, int end) {
    for (int part = begin; part < end; ++part)
      for (int n = part * kPart; n < std::min(count, (part + 1) * kPart); ++n) sums[part] += term(n);
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

/// What conjugate gradients are preconditioned by, one after the other fails to be positive: rotations that
/// differ much from element to element can make the smoother diverge.
enum class Preconditioner { kMultigrid, kAdaptedMultigrid, kNodeBlocks };

struct Outcome {
  int iterations = 0;
  bool broke_down = false;  // the preconditioner is not positive
};

/// x ≈ A⁻¹ r by conjugate gradients until the residual, which r becomes, is `goal` at most.
Outcome conjugate_gradients(const LinearSystem& system, Preconditioner preconditioner, SingleField& r,
                            SingleField& x, double goal, int max_iterations) {
  const Multigrid& multigrid = system.multigrid();
  const int count = static_cast<int>(r.cols());
  const auto sum = [&](const auto& term) { return sum_over_nodes(multigrid.pool(), count, term); };
  SingleField z, p = SingleField::Zero(4, count), Ap;
  x = SingleField::Zero(4, count);
  double rz = 1.0;
  double size = std::sqrt(sum([&](int n) { return r.col(n).squaredNorm(); }));
  Outcome outcome;
  int& iteration = outcome.iterations;
  for (; iteration < max_iterations && size > goal; ++iteration) {
    if (preconditioner == Preconditioner::kNodeBlocks) {
      multigrid.finest().scale(r, z);
    } else {
      multigrid.precondition(r, z);
    }
    const double next_rz = sum([&](int n) { return r.col(n).dot(z.col(n)); });
    outcome.broke_down = !(next_rz > 0.0);
    if (outcome.broke_down) break;
    const auto keep = static_cast<float>(iteration > 0 ? next_rz / rz : 0.0);
    rz = next_rz;
    multigrid.pool().for_range(count, kFewest, [&](int begin, int end) {
      p.middleCols(begin, end - begin) =
          z.middleCols(begin, end - begin) + keep * p.middleCols(begin, end - begin);
    });
    multigrid.finest().apply(p, Ap);
    system.clear_held(Ap);
    const double curvature = sum([&](int n) { return p.col(n).dot(Ap.col(n)); });
    if (!(curvature > 0.0)) break;
    const auto length = static_cast<float>(rz / curvature);
    size = std::sqrt(sum([&](int n) {  // takes the step, too
      x.col(n) += length * p.col(n);
      r.col(n) -= length * Ap.col(n);
      return r.col(n).squaredNorm();
    }));
  }
  return outcome;
}

Preconditioner next_after(Preconditioner failed, const LinearSystem& system) {
  if (failed != Preconditioner::kMultigrid) return Preconditioner::kNodeBlocks;
  system.adapt_smoothers();
  return Preconditioner::kAdaptedMultigrid;
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
    product.apply(to_quads(p), sum);
    y = from_quads(sum);
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
                  int max_iterations, double length, double least_load) {
  const double load = std::max(free_load(system, b, dx), least_load);
  const double rounding = kRounding * system.multigrid().finest().mean_stiffness() * length *
                          std::sqrt(static_cast<double>(dx.cols()));
  const double goal = std::max(tolerance * load, rounding);

  SolveReport report;
  report.converged = false;  // nor if the load is not finite
  NodeField last = dx;
  auto preconditioner = Preconditioner::kMultigrid;
  bool broke_down = false;
  for (double before = std::numeric_limits<double>::infinity();;) {
    const NodeField r = residual(system, b, dx);
    const double size = r.norm();
    if (!(size < before) && !(broke_down && size == before)) {  // rounding, or worse
      dx = last;
      return report;
    }
    report.residual = load > 0.0 ? size / load : 0.0;
    report.converged = size <= goal;
    const bool stagnates = !broke_down && !(size < 0.9 * before);
    if (report.converged || report.iterations >= max_iterations || stagnates) return report;
    before = size;
    last = dx;
    SingleField scaled = to_quads(r / size), change;
    const Outcome outcome =
        conjugate_gradients(system, preconditioner, scaled, change,
                            std::max(0.8 * goal / size, kMostReduction), max_iterations - report.iterations);
    report.iterations += outcome.iterations;
    broke_down = outcome.broke_down && preconditioner != Preconditioner::kNodeBlocks;
    if (broke_down) {
      preconditioner = next_after(preconditioner, system);
    } else {
      dx += size * from_quads(change);
    }
  }
}

}  // namespace cfem_cutting
