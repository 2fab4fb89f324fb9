#pragma once
/// Linear elasticity assembled and factored directly: an independent solver of the library's elements, in
/// which single axes of nodes can be held.

#include <Eigen/SparseCholesky>
#include <map>
#include <vector>

#include "cfem_cutting/elasticity/elastic_model.h"

namespace cfem_cutting {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// (3 |nodes|)², N/m.
SparseMatrix assemble_stiffness(const ElasticModel& model);

class DirectProblem {
 public:
  explicit DirectProblem(const ElasticModel& model)
      : model_(model), free_(3 * model.mesh().node_count(), 1) {}

  /// Prescribes a displacement (m) of one axis of a node.
  void hold(int node, int axis, double displacement);

  /// @param loads (3 × |nodes|), N
  /// @return displacements, m
  NodeField solve(const NodeField& loads);

  /// The lowest natural frequencies, Hz, with lumped masses; by inverse iteration.
  std::vector<double> frequencies(int count);

 private:
  void factor();
  Eigen::VectorXd of_free(const Eigen::VectorXd& all) const;

  const ElasticModel& model_;
  std::vector<char> free_;            // per displacement component
  std::map<int, double> prescribed_;  // m
  std::vector<int> number_;           // among the free, −1
  int free_count_ = 0;
  SparseMatrix stiffness_, free_stiffness_;
  Eigen::SimplicialLDLT<SparseMatrix> factors_;
};

}  // namespace cfem_cutting
