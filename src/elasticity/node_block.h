#pragma once

#include <Eigen/Core>

namespace cfem_cutting {

/// A symmetric 3 × 3 matrix of a node, for quads: its diagonal, and (yz, xz, xy).
class NodeBlock {
 public:
  NodeBlock() = default;
  explicit NodeBlock(const Eigen::Matrix3f& A)
      : diagonal_{A(0, 0), A(1, 1), A(2, 2), 0.0f}, others_{A(1, 2), A(0, 2), A(0, 1), 0.0f} {}

  /// A v, with a zero as fourth
  template <typename Vector>
  EIGEN_ALWAYS_INLINE Eigen::Vector4f operator*(const Vector& v) const {
    const Lanes r = {v[0], v[1], v[2], 0.0f};
    return product(r);
  }
  EIGEN_ALWAYS_INLINE Eigen::Vector4f operator*(const Eigen::Vector4f& v) const {
    return product(*reinterpret_cast<const Lanes*>(v.data()));
  }

 private:
  typedef float Lanes __attribute__((vector_size(16), may_alias));

  EIGEN_ALWAYS_INLINE Eigen::Vector4f product(Lanes r) const {
    const Lanes a = diagonal_, b = others_;
    const Lanes sum = a * r +
                      __builtin_shufflevector(b, b, 2, 2, 1, 3) * __builtin_shufflevector(r, r, 1, 0, 0, 3) +
                      __builtin_shufflevector(b, b, 1, 0, 0, 3) * __builtin_shufflevector(r, r, 2, 2, 1, 3);
    return {sum[0], sum[1], sum[2], sum[3]};
  }

  Lanes diagonal_ = {}, others_ = {};
};

}  // namespace cfem_cutting
