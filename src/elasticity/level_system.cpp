#include "level_system.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cfem_cutting {
namespace {

/// The smoother damps the eigenvalues from a part of the largest one to that, by a Chebyshev polynomial of
/// this degree.
constexpr int kDegree = 3;
constexpr double kSmoothedPart = 0.05;
constexpr double kSafety = 1.1;
constexpr int kPowerIterations = 10;

/// Values without pattern, the same every time.
SingleField noise(int columns) {
  SingleField field(3, columns);
  std::uint32_t state = 1;
  for (Eigen::Index i = 0; i < field.size(); ++i) {
    state = state * 1664525u + 1013904223u;
    field.data()[i] = static_cast<float>(state >> 8) / (1 << 23) - 1.0f;
  }
  return field;
}

Mat3 inverse_or_zero(const Mat3& block) {
  const double size = block.trace();
  if (!(size > 0.0) || !(block.determinant() > 1e-15 * size * size * size)) return Mat3::Zero();
  return block.inverse();
}

/// A 3 × 3 block times a vector.
template <typename Block>
Eigen::Vector3f times(const Block& block, const float* v) {
  return (v[0] * block.col(0) + v[1] * block.col(1) + v[2] * block.col(2)).template head<3>();
}

}  // namespace

void LevelSystem::arrange(ElementSet elements, std::vector<char> held) {
  held_ = std::move(held);
  node_diagonal_ = Eigen::VectorXf::Zero(elements.node_count);
  stiffness_factor_ = 1.0f;
  constraints_.clear();
  product_.arrange(std::move(elements));
  diagonal_at_rest_ = product_.diagonal_at_rest();
  invert_at_rest();
  turn_inverses();
  largest_ = kSafety * largest_eigenvalue();
}

void LevelSystem::set(std::vector<Mat3> rotations, Eigen::VectorXf node_diagonal, float stiffness_factor,
                      std::vector<ConstraintRow> constraints) {
  product_.rotate(std::move(rotations));
  constraints_ = std::move(constraints);
  const bool same = stiffness_factor == stiffness_factor_ && node_diagonal == node_diagonal_;
  node_diagonal_ = std::move(node_diagonal);
  stiffness_factor_ = stiffness_factor;
  if (!same) invert_at_rest();
  turn_inverses();
  prepare_constraints();
}

/// Power iteration.
double LevelSystem::largest_eigenvalue() const {
  SingleField x = noise(static_cast<int>(held_.size())), y;
  double eigenvalue = 1.0;
  for (int i = 0; i < kPowerIterations; ++i) {
    x /= std::max(x.norm(), 1e-30f);
    apply(x, y);
    scale(y, 1.0f, x);
    eigenvalue = std::max<double>(x.norm(), 1e-3);
  }
  return eigenvalue;
}

float LevelSystem::mean_stiffness() const {
  double trace = 0.0;
  for (std::size_t n = 0; n < diagonal_at_rest_.size(); ++n)
    trace += stiffness_factor_ * diagonal_at_rest_[n].trace() + 3.0 * node_diagonal_[n];
  return static_cast<float>(trace / (3.0 * diagonal_at_rest_.size()));
}

/// Calls work(begin, end) on small ranges of nodes, on several threads.
template <typename Work>
void LevelSystem::for_nodes(const Work& work) const {
  constexpr int kPart = 256;  // stays in the cache
  product_.pool().for_range(static_cast<int>(held_.size()), ElementBatches::kFewest, [&](int begin, int end) {
    for (int n = begin; n < end; n += kPart) work(n, std::min(n + kPart, end));
  });
}

void LevelSystem::invert_at_rest() {
  inverse_at_rest_.assign(held_.size(), Eigen::Matrix3f::Zero());
  added_ = node_diagonal_.transpose().replicate<3, 1>();
  for_nodes([&](int begin, int end) {
    for (int n = begin; n < end; ++n) {
      const Mat3 block = stiffness_factor_ * diagonal_at_rest_[n] + node_diagonal_[n] * Mat3::Identity();
      if (!held_[n]) inverse_at_rest_[n] = inverse_or_zero(block).cast<float>();
    }
  });
}

/// A node's block turns with the first element there. That is exact where rotations are alike; where they
/// aren't, the V-cycle loses quality, and conjugate gradients notice if it is no longer positive.
void LevelSystem::turn_inverses() {
  inverse_.assign(held_.size(), NodeBlock::Zero());
  for_nodes([&](int begin, int end) {
    for (int n = begin; n < end; ++n) {
      const Eigen::Matrix3f R = product_.rotation_at(n).cast<float>();
      inverse_[n].topRows<3>().noalias() = R * inverse_at_rest_[n] * R.transpose();
    }
  });
}

void LevelSystem::prepare_constraints() {
  const int count = static_cast<int>(constraints_.size());
  if (count == 0) return;
  Eigen::MatrixXf compliance(count, count);
  SingleField moved = SingleField::Zero(3, static_cast<Eigen::Index>(held_.size()));
  const auto& nodes = product_.elements().nodes;
  for (int i = 0; i < count; ++i) {
    const ConstraintRow& row = constraints_[i];
    for (int n = 0; n < 8; ++n) {
      const int node = nodes[row.element][n];
      moved.col(node) += row.weights[n] * times(inverse_[node], row.direction.data());
    }
    for (int j = 0; j < count; ++j) {
      const ConstraintRow& other = constraints_[j];
      Eigen::Vector3f at = Eigen::Vector3f::Zero();
      for (int n = 0; n < 8; ++n) at += other.weights[n] * moved.col(nodes[other.element][n]);
      compliance(j, i) = other.direction.dot(at);
    }
    compliance(i, i) += 1.0f / row.stiffness;
    for (int node : nodes[row.element]) moved.col(node).setZero();
  }
  compliance_.compute(compliance);
}

void LevelSystem::apply(const SingleField& p, SingleField& y) const {
  product_.apply(p, y);
  const float s = stiffness_factor_;
  for_nodes([=, in = p.data(), d = added_.data(), out = y.data()](int begin, int end) {
#pragma GCC ivdep
    for (int i = 3 * begin; i < 3 * end; ++i) out[i] = s * out[i] + d[i] * in[i];
  });
  add_constraints(p, 1.0f, y);
}

void LevelSystem::add_constraints(const SingleField& p, float factor, SingleField& y) const {
  for (const ConstraintRow& row : constraints_) {
    const ElementNodes& nodes = product_.elements().nodes[row.element];
    Eigen::Vector3f at = Eigen::Vector3f::Zero();
    for (int n = 0; n < 8; ++n) at += row.weights[n] * p.col(nodes[n]);
    const Eigen::Vector3f force = factor * row.stiffness * row.direction.dot(at) * row.direction;
    for (int n = 0; n < 8; ++n) y.col(nodes[n]) += row.weights[n] * force;
  }
}

/// z = factor M⁻¹ r with M the nodes' blocks and the constraints.
void LevelSystem::scale(const SingleField& r, float factor, SingleField& z) const {
  z.resize(3, r.cols());
  for_nodes([&](int begin, int end) {
    for (int n = begin; n < end; ++n) z.col(n) = factor * times(inverse_[n], r.col(n).data());
  });
  correct_for_constraints(r, factor, z);
}

/// What constraints, which are stiff and few, change in factor M⁻¹ r (Woodbury's formula).
void LevelSystem::correct_for_constraints(const SingleField& r, float factor, SingleField& z) const {
  if (constraints_.empty()) return;
  const auto& nodes = product_.elements().nodes;
  Eigen::VectorXf along(constraints_.size());
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const ConstraintRow& row = constraints_[i];
    Eigen::Vector3f at = Eigen::Vector3f::Zero();
    for (int n = 0; n < 8; ++n) {
      const int node = nodes[row.element][n];
      at += row.weights[n] * times(inverse_[node], r.col(node).data());
    }
    along[i] = factor * row.direction.dot(at);
  }
  along = compliance_.solve(along).eval();
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const ConstraintRow& row = constraints_[i];
    for (int n = 0; n < 8; ++n) {
      const int node = nodes[row.element][n];
      z.col(node) -= row.weights[n] * along[i] * times(inverse_[node], row.direction.data());
    }
  }
}

/// x += step, r −= A step (of which the elements' part is in change_), step = keep step + add M⁻¹ r
void LevelSystem::advance(float keep, float add, SingleField& x, SingleField& r) const {
  const float s = stiffness_factor_;
  for_nodes([&, x = x.data(), r = r.data(), step = step_.data(), change = change_.data(), d = added_.data()](
                int begin, int end) {
#pragma GCC ivdep
    for (int i = 3 * begin; i < 3 * end; ++i) {
      x[i] += step[i];
      r[i] -= s * change[i] + d[i] * step[i];
    }
    for (int n = begin; n < end; ++n)
      step_.col(n) = keep * step_.col(n) + add * times(inverse_[n], r + 3 * n);
  });
}

/// Chebyshev's iteration (Saad 2003, algorithm 12.1) from x with residual r; r goes along to the end if
/// wanted.
void LevelSystem::polish(SingleField& x, SingleField& r, bool residual_wanted) const {
  const auto centre = static_cast<float>(0.5 * largest_ * (1.0 + kSmoothedPart));
  const auto half_width = static_cast<float>(0.5 * largest_ * (1.0 - kSmoothedPart));
  const float sigma = centre / half_width;
  float rho = 1.0f / sigma;
  scale(r, 1.0f / centre, step_);
  for (int k = 1; k < kDegree || residual_wanted; ++k) {
    const float next = 1.0f / (2.0f * sigma - rho);
    const float keep = k < kDegree ? next * rho : 0.0f, add = k < kDegree ? 2.0f * next / half_width : 0.0f;
    product_.apply(step_, change_);
    add_constraints(step_, 1.0f / stiffness_factor_, change_);
    advance(keep, add, x, r);
    if (k == kDegree) return;
    correct_for_constraints(r, add, step_);
    rho = next;
  }
  x += step_;
}

void LevelSystem::smooth_from_zero(const SingleField& b, SingleField& x, SingleField& r) const {
  x = SingleField::Zero(3, b.cols());
  r = b;
  polish(x, r, true);
}

void LevelSystem::smooth(const SingleField& b, SingleField& x) const {
  SingleField& r = residual_;
  apply(x, r);
  r = b - r;
  polish(x, r, false);
}

void LevelSystem::factorise() {
  const ElementSet& elements = product_.elements();
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int row_node, int column_node, const Mat3& block) {
    if (held_[row_node] || held_[column_node]) return;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) entries.emplace_back(3 * row_node + i, 3 * column_node + j, block(i, j));
  };
  for (int e = 0; e < elements.size(); ++e) {
    const Mat3& R = product_.rotations()[e];
    for (int n = 0; n < 8; ++n)
      for (int m = 0; m < 8; ++m)
        add(elements.nodes[e][n], elements.nodes[e][m],
            stiffness_factor_ * R * elements.stiffness[e]->block<3, 3>(3 * n, 3 * m) * R.transpose());
  }
  for (const ConstraintRow& row : constraints_) {
    const Vec3 d = row.direction.cast<double>();
    for (int n = 0; n < 8; ++n)
      for (int m = 0; m < 8; ++m)
        add(elements.nodes[row.element][n], elements.nodes[row.element][m],
            row.stiffness * row.weights[n] * row.weights[m] * d * d.transpose());
  }
  const double shift = 1e-7 * mean_stiffness();  // rigid motions of free bodies
  for (int n = 0; n < static_cast<int>(held_.size()); ++n)
    for (int i = 3 * n; i < 3 * n + 3; ++i)
      entries.emplace_back(i, i, held_[n] ? 1.0 : node_diagonal_[n] + shift);
  const auto size = 3 * static_cast<Eigen::Index>(held_.size());
  Eigen::SparseMatrix<double> A(size, size);
  A.setFromTriplets(entries.begin(), entries.end());
  factors_.compute(A);
}

void LevelSystem::solve(const SingleField& b, SingleField& x) const {
  Eigen::VectorXd flat = Eigen::Map<const Eigen::VectorXf>(b.data(), b.size()).cast<double>();
  for (std::size_t n = 0; n < held_.size(); ++n)
    if (held_[n]) flat.segment<3>(3 * static_cast<Eigen::Index>(n)).setZero();
  if (factors_.info() == Eigen::Success) flat = factors_.solve(flat).eval();
  x = Eigen::Map<const NodeField>(flat.data(), 3, b.cols()).cast<float>();
}

}  // namespace cfem_cutting
