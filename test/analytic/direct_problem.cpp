#include "direct_problem.h"

#include <cmath>

namespace cfem_cutting {

SparseMatrix assemble_stiffness(const ElasticModel& model) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int e = 0; e < static_cast<int>(model.mesh().elements().size()); ++e) {
    const CompositeElement& element = model.mesh().elements()[e];
    const ElementMatrix& K = model.stiffness(e);
    for (int i = 0; i < 24; ++i)
      for (int j = 0; j < 24; ++j)
        entries.emplace_back(3 * element.nodes[i / 3] + i % 3, 3 * element.nodes[j / 3] + j % 3, K(i, j));
  }
  SparseMatrix stiffness(3 * model.mesh().node_count(), 3 * model.mesh().node_count());
  stiffness.setFromTriplets(entries.begin(), entries.end());
  return stiffness;
}

void DirectProblem::hold(int node, int axis, double displacement) {
  free_[3 * node + axis] = 0;
  prescribed_[3 * node + axis] = displacement;
}

void DirectProblem::factor() {
  stiffness_ = assemble_stiffness(model_);
  number_.assign(free_.size(), -1);
  free_count_ = 0;
  for (std::size_t i = 0; i < free_.size(); ++i)
    if (free_[i]) number_[i] = free_count_++;
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < stiffness_.outerSize(); ++column)
    for (SparseMatrix::InnerIterator it(stiffness_, column); it; ++it)
      if (free_[it.row()] && free_[it.col()])
        entries.emplace_back(number_[it.row()], number_[it.col()], it.value());
  free_stiffness_.resize(free_count_, free_count_);
  free_stiffness_.setFromTriplets(entries.begin(), entries.end());
  factors_.compute(free_stiffness_);
}

Eigen::VectorXd DirectProblem::of_free(const Eigen::VectorXd& all) const {
  Eigen::VectorXd some(free_count_);
  for (std::size_t i = 0; i < free_.size(); ++i)
    if (free_[i]) some[number_[i]] = all[static_cast<Eigen::Index>(i)];
  return some;
}

NodeField DirectProblem::solve(const NodeField& loads) {
  factor();
  Eigen::VectorXd u = Eigen::VectorXd::Zero(loads.size());
  for (const auto& [component, displacement] : prescribed_) u[component] = displacement;
  const Eigen::VectorXd rhs = Eigen::Map<const Eigen::VectorXd>(loads.data(), loads.size()) - stiffness_ * u;
  const Eigen::VectorXd solution = factors_.solve(of_free(rhs));
  for (Eigen::Index i = 0; i < u.size(); ++i)
    if (free_[i]) u[i] = solution[number_[i]];
  return Eigen::Map<NodeField>(u.data(), 3, loads.cols());
}

std::vector<double> DirectProblem::frequencies(int count) {
  factor();
  Eigen::VectorXd masses(3 * model_.mesh().node_count());
  for (Eigen::Index i = 0; i < masses.size(); ++i) masses[i] = model_.mass()[i / 3];
  const Eigen::VectorXd m = of_free(masses);
  std::vector<Eigen::VectorXd> modes;  // unit in the mass norm
  std::vector<double> frequencies;
  for (int k = 0; k < count; ++k) {
    Eigen::VectorXd mode = Eigen::VectorXd::LinSpaced(free_count_, 1.0, 2.0).array().sin();
    double squared = 0.0;
    for (int iteration = 0; iteration < 200; ++iteration) {
      for (const Eigen::VectorXd& other : modes) mode -= other.dot(m.cwiseProduct(mode)) * other;
      mode /= std::sqrt(mode.dot(m.cwiseProduct(mode)));
      const double rayleigh = mode.dot(free_stiffness_ * mode);
      if (std::abs(rayleigh - squared) < 1e-10 * rayleigh) break;
      squared = rayleigh;
      mode = factors_.solve(m.cwiseProduct(mode)).eval();
    }
    modes.push_back(mode);
    frequencies.push_back(std::sqrt(squared) / (2.0 * M_PI));
  }
  return frequencies;
}

}  // namespace cfem_cutting
