#pragma once

#include <Eigen/Core>
#include <array>

namespace cfem_cutting {

/// A symmetric 3 × 3 matrix of a node, for quads.
struct NodeBlock {
  std::array<float, 6> entries{};  ///< xx, yy, zz, yz, xz, xy

  Eigen::Map<Eigen::Vector3f> diagonal() { return Eigen::Map<Eigen::Vector3f>(entries.data()); }
  Eigen::Map<Eigen::Vector3f> beside() { return Eigen::Map<Eigen::Vector3f>(entries.data() + 3); }

  /// A v, with a zero as fourth if v has one
  EIGEN_ALWAYS_INLINE Eigen::Vector4f operator*(const Eigen::Vector4f& v) const {
    const Lanes r = *reinterpret_cast<const Lanes*>(v.data());
    const Lanes a = *reinterpret_cast<const Lanes*>(entries.data());      // xx, yy, zz, yz
    const Lanes b = *reinterpret_cast<const Lanes*>(entries.data() + 2);  // zz, yz, xz, xy
    const Lanes sum = a * r +
                      __builtin_shufflevector(b, b, 3, 3, 2, 1) * __builtin_shufflevector(r, r, 1, 0, 0, 3) +
                      __builtin_shufflevector(b, b, 2, 1, 1, 1) * __builtin_shufflevector(r, r, 2, 2, 1, 3);
    return {sum[0], sum[1], sum[2], sum[3]};
  }

  /// (factor A + more I)⁻¹; that of the diagonal alone if the whole is not positive definite beyond rounding
  NodeBlock inverse(double factor, double more) const {
    const Eigen::Vector3d d =
        (factor * Eigen::Map<const Eigen::Vector3f>(entries.data()).cast<double>()).array() + more;
    const Eigen::Vector3d b = factor * Eigen::Map<const Eigen::Vector3f>(entries.data() + 3).cast<double>();
    const Eigen::Vector3d minors(d[1] * d[2] - b[0] * b[0], d[0] * d[2] - b[1] * b[1],
                                 d[0] * d[1] - b[2] * b[2]);
    const Eigen::Vector3d others(b[1] * b[2] - b[0] * d[0], b[0] * b[2] - b[1] * d[1],
                                 b[0] * b[1] - b[2] * d[2]);
    const double determinant = d[0] * minors[0] + b[2] * others[2] + b[1] * others[1];
    const double size = d.sum();
    NodeBlock inverse;
    if (!(size > 0.0)) return inverse;
    if (!(minors[2] > 0.0) || !(determinant > kRounding * size * size * size)) {
      inverse.diagonal() = d.cwiseMax(kRounding * size).cwiseInverse().cast<float>();
      return inverse;
    }
    inverse.diagonal() = (minors / determinant).cast<float>();
    inverse.beside() = (others / determinant).cast<float>();
    return inverse;
  }

 private:
  static constexpr double kRounding = 1e-9;
  typedef float Lanes __attribute__((vector_size(16), aligned(4), may_alias));
};

}  // namespace cfem_cutting
