#include "linear_system.h"

namespace cfem_cutting {

LinearSystem::LinearSystem(Multigrid& multigrid, const ElasticModel& model, std::vector<Mat3>&& rotations,
                           SystemValues values, const std::vector<int>& held, Precision precision)
    : multigrid_(multigrid), values_(std::move(values)), held_(held), precision_(precision) {
  multigrid_.arrange(model, held);
  multigrid_.set(std::move(rotations), values_);
}

void LinearSystem::residual(const NodeField& b, const NodeField& x, Precision precision, NodeField& r) const {
  r.resize(3, x.cols());
  const auto finish = [&](int n, const auto& sum) {
    r.col(n) = b.col(n) - values_.stiffness_factor * sum.template head<3>().template cast<double>() -
               values_.node_diagonal[n] * x.col(n);
  };
  const ElementProduct& product = multigrid_.finest().product();
  if (precision == Precision::kDouble) {
    product.apply(x, finish);
  } else {
    thread_local SingleField quads;  // keeps its memory
    to_quads(x, multigrid_.pool(), quads);
    product.apply(quads, finish);
  }
  for (const PointConstraint& c : *values_.constraints) {
    const Vec3 force = c.stiffness * c.direction.dot(c.at.apply(x)) * c.direction;
    for (int n = 0; n < 8; ++n) r.col(c.at.nodes[n]) -= c.at.weights[n] * force;
  }
  clear_held(r);
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

}  // namespace cfem_cutting
