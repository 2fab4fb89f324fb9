#pragma once

#include <cmath>

#include "cfem_cutting/volume/shape.h"

namespace cfem_cutting::test {

/// A ball, exactly.
class Ball final : public Shape {
 public:
  explicit Ball(double radius, const Vec3& centre = Vec3::Zero()) : radius_(radius), centre_(centre) {}
  Box bounds() const override { return {centre_.array() - radius_, centre_.array() + radius_}; }
  std::vector<int> labels_along_z(double x, double y, const std::vector<double>& z) const override {
    std::vector<int> labels;
    for (const double at : z) labels.push_back((Vec3(x, y, at) - centre_).norm() < radius_ ? 0 : -1);
    return labels;
  }
  SurfacePoint exit(const Vec3& inside, const Vec3& outside) const override {
    const Vec3 along = outside - inside, from = inside - centre_;
    const double a = along.squaredNorm(), b = along.dot(from);
    const double c = from.squaredNorm() - radius_ * radius_;
    const Vec3 p = from + (-b + std::sqrt(b * b - a * c)) / a * along;
    return {centre_ + p, p.normalized()};
  }
  double volume() const override { return 4.0 / 3.0 * EIGEN_PI * std::pow(radius_, 3); }

 private:
  double radius_;
  Vec3 centre_;
};

}  // namespace cfem_cutting::test
