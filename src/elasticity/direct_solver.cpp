#include "direct_solver.h"

namespace cfem_cutting {

void DirectSolver::add(int row_node, int column_node, const Mat3& block) {
  if (held_[row_node] || held_[column_node]) return;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) entries_.emplace_back(3 * row_node + i, 3 * column_node + j, block(i, j));
}

void DirectSolver::factorise(const ElementProduct& product, float stiffness_factor,
                             const Eigen::VectorXf& node_diagonal,
                             const std::vector<ConstraintRow>& constraints, const std::vector<char>& held) {
  held_ = held;
  entries_.clear();
  const ElementSet& elements = product.elements().set;
  for (int e = 0; e < elements.size(); ++e) {
    const Mat3& R = product.rotations()[e];
    for (int n = 0; n < 8; ++n)
      for (int m = 0; m < 8; ++m)
        add(elements.nodes[e][n], elements.nodes[e][m],
            stiffness_factor * R * elements.stiffness[e]->whole.block<3, 3>(3 * n, 3 * m) * R.transpose());
  }
  for (const ConstraintRow& row : constraints) {
    const Vec3 d = row.direction.cast<double>();
    for (int n = 0; n < 8; ++n)
      for (int m = 0; m < 8; ++m)
        add(row.nodes[n], row.nodes[m], row.stiffness * row.weights[n] * row.weights[m] * d * d.transpose());
  }
  for (int n = 0; n < static_cast<int>(held.size()); ++n)
    for (int i = 3 * n; i < 3 * n + 3; ++i) entries_.emplace_back(i, i, held[n] ? 1.0 : node_diagonal[n]);
  const auto size = 3 * static_cast<Eigen::Index>(held.size());
  Eigen::SparseMatrix<double> A(size, size);
  A.setFromTriplets(entries_.begin(), entries_.end());
  if (!analysed_) factors_.analyzePattern(A);
  analysed_ = true;
  factors_.factorize(A);
}

void DirectSolver::solve(const SingleField& b, SingleField& x) const {
  NodeField load = from_quads(b);
  for (std::size_t n = 0; n < held_.size(); ++n)
    if (held_[n]) load.col(static_cast<Eigen::Index>(n)).setZero();
  if (factors_.info() != Eigen::Success) return void(x = to_quads(load));
  const Eigen::VectorXd solution =
      factors_.solve(Eigen::Map<const Eigen::VectorXd>(load.data(), load.size()));
  x = to_quads(Eigen::Map<const NodeField>(solution.data(), 3, b.cols()));
}

}  // namespace cfem_cutting
