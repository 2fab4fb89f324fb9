#include "level_system.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>

// A lambda's body goes into the loop that calls it.
#if defined(__GNUC__)
#define CFEM_CUTTING_INLINE __attribute__((always_inline))
#else
#define CFEM_CUTTING_INLINE
#endif

namespace cfem_cutting {
namespace {

constexpr double kSafety = 1.1;
constexpr float kWeakSpring = 1e-7f;  // of a node's mean stiffness
constexpr int kLanczosSteps = 10;

/// Values without pattern, the same every time.
SingleField noise(int columns) {
  SingleField field = SingleField::Zero(4, columns);
  std::uint32_t state = 1;
  for (int n = 0; n < columns; ++n) {
    for (int i = 0; i < 3; ++i) {
      state = state * 1664525u + 1013904223u;
      field(i, n) = static_cast<float>(state >> 8) / (1 << 23) - 1.0f;
    }
  }
  return field;
}

}  // namespace

void LevelSystem::arrange(ElementsPointer elements, std::vector<char> held) {
  assert(elements->set.node_count > 0);
  held_ = std::move(held);
  largest_ = 0.0;
  set_diagonal(Eigen::VectorXf::Zero(elements->set.node_count), 1.0f);
  constraints_.clear();
  direct_.forget_pattern();
  product_.arrange(std::move(elements));
  mean_at_rest_ = product_.elements().set.trace() / (3.0 * held_.size());
}

double LevelSystem::largest_at_rest(int steps) {
  product_.update_diagonal();
  invert_blocks();
  return largest_eigenvalue(steps);
}

void LevelSystem::expect_largest(double eigenvalue) { largest_ = kSafety * eigenvalue; }

void LevelSystem::estimate_largest() {
  largest_ = std::max(largest_, kSafety * largest_eigenvalue(kLanczosSteps));
}

void LevelSystem::set_diagonal(Eigen::VectorXf node_diagonal, float stiffness_factor) {
  node_diagonal_ = std::move(node_diagonal);
  stiffness_factor_ = stiffness_factor;
  inverse_fits_ = false;
}

void LevelSystem::set(std::vector<Mat3>&& rotations, std::vector<ConstraintRow> constraints) {
  product_.rotate(std::move(rotations));
  constraints_ = std::move(constraints);
  if (product_.update_diagonal() || !inverse_fits_) invert_blocks();
  inverse_fits_ = true;
  prepare_constraints();
}

/// Of M⁻¹ A, by the tridiagonal matrix of conjugate gradients (Saad 2003, section 6.7.3). Single sliver nodes
/// can have the largest one, which a power iteration finds too late.
double LevelSystem::largest_eigenvalue(int max_steps) const {
  SingleField r = noise(static_cast<int>(held_.size())), z, p, Ap;
  for (std::size_t n = 0; n < held_.size(); ++n)
    if (held_[n]) r.col(static_cast<Eigen::Index>(n)).setZero();
  scale(r, 1.0f, z);
  p = z;
  double rz = r.cwiseProduct(z).sum(), ratio = 0.0;
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(max_steps);
  Eigen::VectorXd beside = Eigen::VectorXd::Zero(max_steps - 1);
  int steps = 0;
  for (double length = 1.0; steps < max_steps && rz > 0.0; ++steps) {
    apply(p, Ap);
    const double curvature = p.cwiseProduct(Ap).sum();
    if (!(curvature > 0.0)) break;
    diagonal[steps] = ratio / length;
    length = rz / curvature;
    diagonal[steps] += 1.0 / length;
    r -= static_cast<float>(length) * Ap;
    scale(r, 1.0f, z);
    const double next_rz = r.cwiseProduct(z).sum();
    ratio = next_rz / rz;
    rz = next_rz;
    if (steps + 1 < max_steps) beside[steps] = std::sqrt(std::max(ratio, 0.0)) / length;
    p = z + static_cast<float>(ratio) * p;
  }
  if (steps == 0) return 1.0;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal.head(steps), beside.head(steps - 1), Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

float LevelSystem::mean_stiffness() const {
  return static_cast<float>(stiffness_factor_ * mean_at_rest_ + node_diagonal_.cast<double>().mean());
}

/// Calls work(begin, end) on small ranges of nodes, on several threads.
template <typename Work>
void LevelSystem::for_nodes(const Work& work) const {
  constexpr int kPart = 256;  // stays in the cache
  product_.pool().for_range(static_cast<int>(held_.size()), ElementTiles::kFewest, [&](int begin, int end) {
    for (int n = begin; n < end; n += kPart) work(n, std::min(n + kPart, end));
  });
}

void LevelSystem::invert_blocks() {
  const std::vector<NodeBlock>& blocks = product_.diagonal();
  inverse_.resize(held_.size());
  for_nodes([&](int begin, int end) {
    for (int n = begin; n < end; ++n)
      inverse_[n] = held_[n] ? NodeBlock() : blocks[n].inverse(stiffness_factor_, node_diagonal_[n]);
  });
}

void LevelSystem::prepare_constraints() {
  const int count = static_cast<int>(constraints_.size());
  if (count == 0) return;
  Eigen::MatrixXf compliance(count, count);
  SingleField moved = SingleField::Zero(4, static_cast<Eigen::Index>(held_.size()));
  for (int i = 0; i < count; ++i) {
    const ConstraintRow& row = constraints_[i];
    add_scaled_to_nodes(row, 1.0f, moved);
    for (int j = 0; j < count; ++j) compliance(j, i) = constraints_[j].displacement(moved);
    compliance(i, i) += 1.0f / row.stiffness;
    for (int node : row.nodes) moved.col(node).setZero();
  }
  compliance_.compute(compliance);
}

void LevelSystem::apply(const SingleField& p, SingleField& y) const {
  y.resize(4, p.cols());
  product_.apply(p, [p = quads_of(p), y = quads_of(y), d = node_diagonal_.data(), s = stiffness_factor_](
                        int n, const Quad& sum) CFEM_CUTTING_INLINE { y[n] = s * sum + d[n] * p[n]; });
  for (const ConstraintRow& row : constraints_) row.add(row.force(p), y);
}

void LevelSystem::residual(const SingleField& b, const SingleField& x, SingleField& r) const {
  r.resize(4, x.cols());
  product_.apply(x, [b = quads_of(b), x = quads_of(x), r = quads_of(r), d = node_diagonal_.data(),
                     s = stiffness_factor_](int n, const Quad& sum)
                        CFEM_CUTTING_INLINE { r[n] = b[n] - (s * sum + d[n] * x[n]); });
  for (const ConstraintRow& row : constraints_) row.add(-row.force(x), r);
}

/// y += force M⁻¹ (w ⊗ d)
void LevelSystem::add_scaled_to_nodes(const ConstraintRow& row, float force, SingleField& y) const {
  Quad direction = Quad::Zero();
  direction.head<3>() = row.direction;
  for (int n = 0; n < 8; ++n)
    y.col(row.nodes[n]) += row.weights[n] * force * (inverse_[row.nodes[n]] * direction);
}

/// z = factor M⁻¹ r with M the nodes' blocks and the constraints.
void LevelSystem::scale(const SingleField& r, float factor, SingleField& z) const {
  z.resize(4, r.cols());
  for_nodes([&](int begin, int end) {
    for (int n = begin; n < end; ++n) z.col(n) = factor * (inverse_[n] * Quad(r.col(n)));
  });
  correct_for_constraints(Eigen::VectorXf::Zero(constraints_.size()), z);
}

/// What constraints, which are stiff and few, change in z = z₀ + M⁻¹ r (Woodbury's formula).
/// @param kept of each, its displacement by z₀
void LevelSystem::correct_for_constraints(const Eigen::VectorXf& kept, SingleField& z) const {
  if (constraints_.empty()) return;
  Eigen::VectorXf along(constraints_.size());
  for (std::size_t i = 0; i < constraints_.size(); ++i) along[i] = constraints_[i].displacement(z) - kept[i];
  along = compliance_.solve(along).eval();
  for (std::size_t i = 0; i < constraints_.size(); ++i) add_scaled_to_nodes(constraints_[i], -along[i], z);
}

/// One sweep of Chebyshev's iteration for A x = b: `before` becomes x + keep (x − before) + add M⁻¹ (b − A
/// x).
/// @param ignores_before it is zero, whatever it holds, or `keep` is
void LevelSystem::sweep(float keep, float add, const SingleField& b, const SingleField& x,
                        SingleField& before, bool ignores_before) const {
  Eigen::VectorXf forces(constraints_.size()), kept(constraints_.size());
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const float at = constraints_[i].displacement(x);
    forces[i] = constraints_[i].stiffness * at;
    kept[i] = at + keep * (at - (ignores_before ? 0.0f : constraints_[i].displacement(before)));
  }
  before.resize(4, x.cols());
  const auto sweep_from = [&](const auto& start) {
    product_.apply(x, [b = quads_of(b), x = quads_of(x), next = quads_of(before), inverse = inverse_.data(),
                       d = node_diagonal_.data(), s = stiffness_factor_, add, start](int n, const Quad& sum)
                          CFEM_CUTTING_INLINE {
                            const Quad residual = b[n] - (s * sum + d[n] * x[n]);
                            next[n] = start(x[n], next[n]) + add * (inverse[n] * residual);
                          });
  };
  const float grow = 1.0f + keep;
  if (ignores_before) {
    sweep_from([grow](const Quad& at, const Quad&) CFEM_CUTTING_INLINE -> Quad { return grow * at; });
  } else {
    sweep_from([grow, keep](const Quad& at, const Quad& earlier)
                   CFEM_CUTTING_INLINE -> Quad { return grow * at - keep * earlier; });
  }
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    add_scaled_to_nodes(constraints_[i], -add * forces[i], before);
  correct_for_constraints(kept, before);
}

/// Chebyshev's iteration (Saad 2003, algorithm 12.1) for the eigenvalues to be smoothed.
struct LevelSystem::Chebyshev {
  Chebyshev(double largest, double part)
      : half_width(static_cast<float>(0.5 * largest * (1.0 - part))),
        sigma(static_cast<float>((1.0 + part) / (1.0 - part))),
        rho(1.0f / sigma),
        add(1.0f / (sigma * half_width)) {}
  void next() {
    const float before = rho;
    rho = 1.0f / (2.0f * sigma - before);
    keep = rho * before;
    add = 2.0f * rho / half_width;
  }
  float half_width, sigma, rho, keep = 0.0f, add;
};

/// Sweeps after the first one, which began from zero or not.
void LevelSystem::sweep_on(Chebyshev& chebyshev, const SingleField& b, SingleField& x, bool from_zero) const {
  for (int k = 1; k < smoothing_.degree; ++k) {
    chebyshev.next();
    sweep(chebyshev.keep, chebyshev.add, b, x, before_, from_zero && k == 1);
    x.swap(before_);
  }
}

const SingleField& LevelSystem::smooth_from_zero(const SingleField& b, SingleField& x) const {
  Chebyshev chebyshev(largest_, smoothing_.part);
  scale(b, chebyshev.add, x);
  sweep_on(chebyshev, b, x, true);
  residual(b, x, before_);
  return before_;
}

void LevelSystem::smooth(const SingleField& b, SingleField& x) const {
  Chebyshev chebyshev(largest_, smoothing_.part);
  sweep(0.0f, chebyshev.add, b, x, before_, true);
  x.swap(before_);
  sweep_on(chebyshev, b, x, false);
}

/// Rigid motions of free bodies get a weak spring.
void LevelSystem::factorise() {
  const Eigen::VectorXf diagonal = node_diagonal_.array() + kWeakSpring * mean_stiffness();
  direct_.factorise(product_, stiffness_factor_, diagonal, constraints_, held_);
}

}  // namespace cfem_cutting
