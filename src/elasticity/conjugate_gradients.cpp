#include "conjugate_gradients.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "first_guess.h"
#include "node_loops.h"

namespace cfem_cutting {
namespace {

/// A solve stops at this part of (stiffness × size) too: below it there is only rounding.
constexpr double kRounding = 1e-15;

/// Conjugate gradients in single precision reduce a residual by no more than this at once.
constexpr double kMostReduction = 1e-5;

double norm(ThreadPool& pool, const NodeField& field) {
  return std::sqrt(sum_over_nodes(pool, field.cols(), [&](int n) { return field.col(n).squaredNorm(); }));
}

/// ‖b − A dx‖ on the free nodes for the held dx alone.
double free_load(const LinearSystem& system, const NodeField& b, const NodeField& dx) {
  ThreadPool& pool = system.multigrid().pool();
  NodeField held_part = NodeField::Zero(3, dx.cols()), r;
  bool moves = false;
  for (int node : system.held()) {
    held_part.col(node) = dx.col(node);
    moves = moves || !dx.col(node).isZero(0.0);
  }
  if (!moves) {
    r = b;
    system.clear_held(r);
  } else {
    system.residual(b, held_part, r);
  }
  return norm(pool, r);
}

/// What conjugate gradients are preconditioned by, one after the other fails to be positive: with rotations
/// that differ much from element to element a W-cycle may.
enum class Preconditioner { kMultigrid, kAdaptedMultigrid, kNodeBlocks };

struct Outcome {
  int iterations = 0;
  bool broke_down = false;  // the preconditioner is not positive
};

/// x on towards A⁻¹ b by conjugate gradients until its residual r is `goal` at most.
Outcome conjugate_gradients(const LinearSystem& system, Preconditioner preconditioner, SingleField& r,
                            SingleField& x, double goal, int max_iterations) {
  const Multigrid& multigrid = system.multigrid();
  const int count = static_cast<int>(r.cols());
  const auto sum = [&](const auto& term) { return sum_over_nodes(multigrid.pool(), count, term); };
  SingleField z, p = SingleField::Zero(4, count), Ap;
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
    for_each_node(multigrid.pool(), count, [&](int n) { p.col(n) = z.col(n) + keep * p.col(n); });
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

SolveReport solve(const LinearSystem& system, const NodeField& b, NodeField& dx, double tolerance,
                  int max_iterations, double length, double least_load, std::vector<SingleField> directions) {
  assert(tolerance > 0.0);
  const double load = std::max(free_load(system, b, dx), least_load);
  const double rounding = kRounding * system.multigrid().finest().mean_stiffness() * length *
                          std::sqrt(static_cast<double>(dx.cols()));
  const double reference = std::max(load, rounding / tolerance);

  ThreadPool& pool = system.multigrid().pool();
  SolveReport report;
  report.converged = false;  // nor if the load is not finite
  NodeField last = dx, r;
  SingleField scaled(4, dx.cols()), change;
  auto preconditioner = Preconditioner::kMultigrid;
  bool broke_down = false;
  for (double before = std::numeric_limits<double>::infinity();;) {
    system.residual(b, dx, r);
    const double size = norm(pool, r);
    if (!(size < before) && !(broke_down && size == before)) {  // rounding, or worse
      dx = last;
      return report;
    }
    report.residual = size / reference;
    report.converged = report.residual <= tolerance;
    const bool stagnates = !broke_down && !(size < 0.9 * before);
    if (report.converged || report.iterations >= max_iterations || stagnates) return report;
    before = size;
    for_each_node(pool, dx.cols(), [&](int n) { scaled.col(n) << (r.col(n) / size).cast<float>(), 0.0f; });
    change = SingleField::Zero(4, dx.cols());
    minimise_over(system, std::move(directions), scaled, change);
    directions.clear();
    const Outcome outcome = conjugate_gradients(system, preconditioner, scaled, change,
                                                std::max(0.8 * tolerance * reference / size, kMostReduction),
                                                max_iterations - report.iterations);
    report.iterations += outcome.iterations;
    broke_down = outcome.broke_down && preconditioner != Preconditioner::kNodeBlocks;
    if (broke_down) {
      preconditioner = next_after(preconditioner, system);
    } else {
      last = dx;
      for_each_node(pool, dx.cols(),
                    [&](int n) { dx.col(n) += size * change.col(n).head<3>().cast<double>(); });
    }
  }
}

}  // namespace cfem_cutting
