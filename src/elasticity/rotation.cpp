#include "rotation.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

namespace cfem_cutting {
namespace {

Mat3 cofactors(const Mat3& A) {
  Mat3 C;
  C.col(0) = A.col(1).cross(A.col(2));
  C.col(1) = A.col(2).cross(A.col(0));
  C.col(2) = A.col(0).cross(A.col(1));
  return C;
}

/// Newton's iteration R ← ½ (R + R⁻ᵀ) (Higham 1986); converges quadratically for det F > 0.
bool iterate_polar(const Mat3& F, Mat3& R) {
  R = F;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Mat3 C = cofactors(R);
    const Mat3 next = 0.5 * (R + C / R.col(0).dot(C.col(0)));
    const double change = (next - R).squaredNorm();
    R = next;
    if (change < 1e-18) return true;
  }
  return false;
}

Mat3 rotation_by_svd(const Mat3& F) {
  const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) *= -1.0;
  return U * svd.matrixV().transpose();
}

}  // namespace

PolarRotation polar_rotation(const Mat3& F) {
  PolarRotation result;
  const double volume_ratio = F.determinant();
  result.inverted = !(volume_ratio > kFlatVolumeRatio);
  if (!F.allFinite()) {
    result.R.setIdentity();
  } else if (result.inverted || !iterate_polar(F, result.R)) {
    result.R = rotation_by_svd(F);
  }
  return result;
}

Vec3 rodrigues_parameters(const Mat3& R) {
  const double w_doubled_squared = 1.0 + R.trace();
  if (w_doubled_squared > 1.0) {
    const double scale = 1.0 / (w_doubled_squared + 2.0 * std::sqrt(w_doubled_squared));
    return scale * Vec3(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  }
  const Eigen::Quaterniond q(R);
  return q.vec() / (q.w() + std::copysign(1.0, q.w()));  // q and −q are the same rotation
}

Vec3 solve_spin(const Mat3& S, const Vec3& t) {
  const Mat3 G = S.trace() * Mat3::Identity() - S;
  if (G.determinant() > 1e-2) return G.inverse() * t;
  const double smallest = 0.05;  // sum of two principal stretches; 2 at rest
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(0.5 * (G + G.transpose()));
  if (eigen.info() != Eigen::Success) return Vec3::Zero();
  const Vec3 lambda = eigen.eigenvalues().cwiseMax(smallest);
  return eigen.eigenvectors() * (eigen.eigenvectors().transpose() * t).cwiseQuotient(lambda);
}

}  // namespace cfem_cutting
