#include "error_function.h"

#include <Eigen/Eigenvalues>

namespace cfem_cutting {
namespace {

/// Singular values below this part of the largest count as zero (Ju et al. 2002, section 2.3).
constexpr double kTruncation = 0.1;

}  // namespace

void ErrorFunction::add(const SurfacePoint& plane) {
  if (count_++ == 0) first_ = plane.point;
  const Vec3 p = plane.point - first_;
  AtA_ += plane.normal * plane.normal.transpose();
  Atb_ += plane.normal * plane.normal.dot(p);
  sum_ += p;
}

Vec3 ErrorFunction::minimum(const Box& bounds) const {
  const Vec3 mean = sum_ / count_;
  const Vec3 residual = Atb_ - AtA_ * mean;
  Vec3 X = first_ + mean;
  if (!residual.isZero(0.0)) {
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(AtA_);
    const double smallest = kTruncation * kTruncation * eigen.eigenvalues()[2];
    for (int i = 0; i < 3; ++i) {
      const Vec3 axis = eigen.eigenvectors().col(i);
      if (eigen.eigenvalues()[i] > smallest) X += axis * (axis.dot(residual) / eigen.eigenvalues()[i]);
    }
  }
  return X.cwiseMax(bounds.min()).cwiseMin(bounds.max());
}

}  // namespace cfem_cutting
