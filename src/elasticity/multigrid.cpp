#include "multigrid.h"

#include <algorithm>
#include <cmath>

#include "node_loops.h"
#include "rotation.h"

namespace cfem_cutting {
namespace {

constexpr int kCoarsestNodes = 40;  // few enough to be factorised in every solve
constexpr std::size_t kMostLevels = 12;

/// Less inertia (see LevelSystem) takes a second cycle, hardly any also more smoothing, for partly filled,
/// cut and mixed elements.
constexpr double kLittleInertia = 0.01, kHardlyAny = 0.001;
constexpr Smoothing kFinest{2, 0.06}, kWithInertia{3, 0.05}, kWithout{7, 0.01};

std::vector<ConstraintRow> rows_of(const std::vector<PointConstraint>& constraints) {
  std::vector<ConstraintRow> rows;
  for (const PointConstraint& c : constraints) {
    if (!(c.stiffness > 0.0)) continue;
    ConstraintRow row{
        c.at.element, c.at.nodes, {}, c.direction.cast<float>(), static_cast<float>(c.stiffness)};
    for (int n = 0; n < 8; ++n) row.weights[n] = static_cast<float>(c.at.weights[n]);
    rows.push_back(row);
  }
  return rows;
}

/// Held rows interpolate nothing.
Interpolation without_held(const Interpolation& all, const std::vector<char>& held) {
  Interpolation kept;
  for (int row = 0; row < all.rows(); ++row) {
    if (!held[row])
      kept.terms.insert(kept.terms.end(), all.terms.begin() + all.first[row],
                        all.terms.begin() + all.first[row + 1]);
    kept.first.push_back(static_cast<int>(kept.terms.size()));
  }
  return kept;
}

}  // namespace

void Multigrid::arrange(const ElasticModel& model, const std::vector<int>& held) {
  if (version_ == model.version() && held_ == held) return;
  version_ = 0;
  std::vector<char> flags(model.mesh().node_count(), 0);
  for (int node : held) flags[node] = 1;
  levels_.clear();
  node_diagonal_.resize(0);
  add_level(model.elements(), std::move(flags));
  while (levels_.size() < kMostLevels &&
         levels_.back().system.product().elements().set.node_count > kCoarsestNodes) {
    Level& fine = levels_.back();
    const ElementSet& elements = fine.system.product().elements().set;
    Coarsening coarsening(fine.system.product().elements());
    if (coarsening.coarse.size() == elements.size()) break;
    if (galerkin_.size() < levels_.size()) galerkin_.emplace_back();
    coarsening.coarse.stiffness =
        galerkin_[levels_.size() - 1].assemble(elements, fine.system.held(), coarsening);
    fine.parts = ElementParts(coarsening.parent, coarsening.coarse.size());
    fine.parent = std::move(coarsening.parent);
    fine.interpolation = without_held(coarsening.interpolation, fine.system.held());
    fine.prolongation = Prolongation(fine.interpolation);
    fine.restriction = fine.interpolation.transposed(coarsening.coarse.node_count);
    std::vector<char> none(coarsening.coarse.node_count, 0);
    add_level(std::make_shared<TiledElements>(std::move(coarsening.coarse)), std::move(none));
  }
  version_ = model.version();
  held_ = held;
}

void Multigrid::add_level(ElementsPointer elements, std::vector<char> held) {
  LevelSystem& system = levels_.emplace_back(pool_).system;
  system.arrange(std::move(elements), std::move(held));
  if (largest_.size() < levels_.size()) largest_.emplace_back();
  system.expect_largest(largest_[levels_.size() - 1].update(system));
}

void Multigrid::set(std::vector<Mat3>&& rotations, const SystemValues& values) {
  set_diagonals(values.node_diagonal, static_cast<float>(values.stiffness_factor));
  levels_.front().system.set(std::move(rotations), rows_of(*values.constraints));
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    const Level& fine = levels_[l - 1];
    LevelSystem& coarse = levels_[l].system;
    coarse.set(coarse_rotations(fine), coarse_constraints(fine, coarse.product().elements().set));
  }
  levels_.back().system.factorise();
}

/// And the smoothing that suits them.
void Multigrid::set_diagonals(const Eigen::VectorXd& finest, float stiffness_factor) {
  if (stiffness_factor == stiffness_factor_ && finest.size() == node_diagonal_.size() &&
      finest == node_diagonal_)
    return;
  node_diagonal_ = finest;
  stiffness_factor_ = stiffness_factor;
  levels_.front().system.set_diagonal(finest.cast<float>(), stiffness_factor);
  levels_.front().system.smooth_with(kFinest);
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    const Level& fine = levels_[l - 1];
    LevelSystem& coarse = levels_[l].system;
    Eigen::VectorXf diagonal = Eigen::VectorXf::Zero(coarse.node_diagonal().size());
    for (int n = 0; n < fine.interpolation.rows(); ++n)
      for (const Interpolation::Term& term : fine.interpolation.row(n))
        diagonal[term.node] += term.weight() * fine.system.node_diagonal()[n];
    coarse.set_diagonal(std::move(diagonal), stiffness_factor);
    coarse.smooth_with(coarse.inertia() < kHardlyAny ? kWithout : kWithInertia);
    const bool little = coarse.inertia() < kLittleInertia;
    levels_[l].cycles = little && l > 1 && l + 1 < levels_.size() ? 2 : 1;
  }
}

void Multigrid::adapt_smoothers() {
  for (Level& level : levels_) level.system.estimate_largest();
}

/// The rotations nearest to the sums of the parts'.
std::vector<Mat3> Multigrid::coarse_rotations(const Level& fine) const {
  const std::vector<Mat3>& rotations = fine.system.product().rotations();
  const ElementParts& parts = fine.parts;
  std::vector<Mat3> coarse(parts.size());
  constexpr int kFewest = 256;  // worth waking a thread for
  pool_.for_range(parts.size(), kFewest, [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      Mat3 sum = Mat3::Zero();
      for (int i = parts.first[c]; i < parts.first[c + 1]; ++i) sum += rotations[parts.elements[i]];
      coarse[c] = polar_rotation(sum / std::max(sum.norm(), 1e-6) * std::sqrt(3.0)).R;
    }
  });
  return coarse;
}

std::vector<ConstraintRow> Multigrid::coarse_constraints(const Level& fine, const ElementSet& coarse) const {
  std::vector<ConstraintRow> rows = fine.system.constraints();
  for (ConstraintRow& row : rows) {
    const ElementNodes from = row.nodes;
    row.element = fine.parent[row.element];
    row.nodes = coarse.nodes[row.element];
    Eigen::Matrix<float, 8, 1> weights = Eigen::Matrix<float, 8, 1>::Zero();
    for (int n = 0; n < 8; ++n)
      for (const Interpolation::Term& term : fine.interpolation.row(from[n]))
        for (int m = 0; m < 8; ++m)
          if (row.nodes[m] == static_cast<int>(term.node)) weights[m] += row.weights[n] * term.weight();
    row.weights = weights;
  }
  return rows;
}

void Multigrid::cycle(std::size_t l, const SingleField& b, SingleField& x) const {
  const Level& level = levels_[l];
  if (l + 1 == levels_.size()) return level.system.solve(b, x);
  const SingleField& residual = level.system.smooth_from_zero(b, x);
  level.restriction.apply(pool_, residual, level.coarse_load);
  cycle(l + 1, level.coarse_load, level.coarse_x);
  for (int i = 1; i < levels_[l + 1].cycles; ++i) cycle_again(l + 1, level.coarse_load, level.coarse_x);
  level.prolongation.add(pool_, level.coarse_x, x);
  level.system.smooth(b, x);
}

/// x += one cycle for b − A x
void Multigrid::cycle_again(std::size_t l, const SingleField& b, SingleField& x) const {
  const Level& level = levels_[l];
  level.system.residual(b, x, level.left);
  cycle(l, level.left, level.change);
  x += level.change;
}

}  // namespace cfem_cutting
