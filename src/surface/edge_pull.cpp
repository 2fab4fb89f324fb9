#include "edge_pull.h"

#include <algorithm>
#include <cmath>

namespace cfem_cutting {
namespace {

double square(double value) { return value * value; }

}  // namespace

void EdgePull::add(const Vec3& X, const Vec3& way) {
  held_.push_back({X, way});
  const Vec3 around = Vec3::Constant(reach_);
  box_.extend(X - around).extend(X + around);
}

/// Weighted mean (Franke and Little) times a slope of the nearest distance.
Vec3 EdgePull::at(const Vec3& X) const {
  if (!box_.contains(X)) return Vec3::Zero();
  const double smallest = square(1e-6 * reach_);
  double nearest = square(reach_), weights = 0.0;
  Vec3 sum = Vec3::Zero();
  for (const Held& held : held_) {
    const double distance = (held.X - X).squaredNorm();
    if (distance >= square(reach_)) continue;
    nearest = std::min(nearest, distance);
    const double weight = square(reach_ - std::sqrt(distance)) / std::max(distance, smallest);
    weights += weight;
    sum += weight * held.way;
  }
  return weights > 0.0 ? Vec3(square(1.0 - nearest / square(reach_)) / weights * sum) : Vec3::Zero();
}

}  // namespace cfem_cutting
