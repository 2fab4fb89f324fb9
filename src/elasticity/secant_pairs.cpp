#include "secant_pairs.h"

namespace cfem_cutting {
namespace {

constexpr std::size_t kMostPairs = 4;

double dot(const NodeField& a, const NodeField& b) { return a.cwiseProduct(b).sum(); }

}  // namespace

void SecantPairs::add(NodeField step, NodeField drop) {
  constexpr double kLeastCosine = 1e-8;  // less has no stable system
  const double work = dot(step, drop);
  if (!(work > kLeastCosine * step.norm() * drop.norm())) return;
  pairs_.push_front({std::move(step), std::move(drop), work});
  if (pairs_.size() > kMostPairs) pairs_.pop_back();
}

/// The first of the method's two loops.
std::vector<double> SecantPairs::take_parts(NodeField& forces) const {
  std::vector<double> parts;
  for (const Pair& pair : pairs_) {
    parts.push_back(dot(pair.step, forces) / pair.work);
    forces -= parts.back() * pair.drop;
  }
  return parts;
}

void SecantPairs::put_parts(const std::vector<double>& parts, NodeField& direction) const {
  for (std::size_t i = pairs_.size(); i-- > 0;) {
    const Pair& pair = pairs_[i];
    direction += (parts[i] - dot(pair.drop, direction) / pair.work) * pair.step;
  }
}

}  // namespace cfem_cutting
