#include "trilinear_inverse.h"

#include <Eigen/LU>

namespace cfem_cutting {
namespace {

/// Coefficients of x(t) = c₀ + c₁t₀ + c₂t₁ + c₃t₂ + c₄t₁t₂ + c₅t₀t₂ + c₆t₀t₁ + c₇t₀t₁t₂.
struct Polynomial {
  explicit Polynomial(const Eigen::Matrix<double, 3, 8>& p) {
    c.col(0) = p.col(0);
    c.col(1) = p.col(1) - p.col(0);
    c.col(2) = p.col(2) - p.col(0);
    c.col(3) = p.col(4) - p.col(0);
    c.col(4) = p.col(6) - p.col(2) - p.col(4) + p.col(0);
    c.col(5) = p.col(5) - p.col(1) - p.col(4) + p.col(0);
    c.col(6) = p.col(3) - p.col(1) - p.col(2) + p.col(0);
    c.col(7) = p.col(7) - p.col(3) - p.col(5) - p.col(6) + p.col(1) + p.col(2) + p.col(4) - p.col(0);
  }
  Vec3 value(const Vec3& t) const {
    return c.col(0) + t[0] * (c.col(1) + t[2] * c.col(5) + t[1] * (c.col(6) + t[2] * c.col(7))) +
           t[1] * (c.col(2) + t[2] * c.col(4)) + t[2] * c.col(3);
  }
  Mat3 jacobian(const Vec3& t) const {
    Mat3 J;
    J.col(0) = c.col(1) + t[2] * c.col(5) + t[1] * c.col(6) + t[1] * t[2] * c.col(7);
    J.col(1) = c.col(2) + t[2] * c.col(4) + t[0] * c.col(6) + t[0] * t[2] * c.col(7);
    J.col(2) = c.col(3) + t[1] * c.col(4) + t[0] * c.col(5) + t[0] * t[1] * c.col(7);
    return J;
  }
  Eigen::Matrix<double, 3, 8> c;
};

}  // namespace

std::optional<Vec3> invert_trilinear(const Eigen::Matrix<double, 3, 8>& corners, const Vec3& x,
                                     double largest) {
  const Polynomial map(corners);
  const double size = (corners.col(7) - corners.col(0)).norm() + map.c.middleCols<3>(1).norm();
  Vec3 t = Vec3::Constant(0.5);
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Vec3 residual = x - map.value(t);
    const Mat3 J = map.jacobian(t);
    const double determinant = J.determinant();
    if (!(std::abs(determinant) > 1e-12 * size * size * size)) return std::nullopt;
    const Vec3 step = J.inverse() * residual;
    t += step;
    if (!((t.array() - 0.5).abs().maxCoeff() < 2.0 * largest)) return std::nullopt;
    if (step.cwiseAbs().maxCoeff() > 1e-12) continue;
    if ((t.array() - 0.5).abs().maxCoeff() > largest) return std::nullopt;
    return t;
  }
  return std::nullopt;
}

}  // namespace cfem_cutting
