#include "error_function.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace cfem_cutting {
namespace {

constexpr double kTruncation = 0.1;

/// Beside a cut, and where a vertex is near its cell's walls, the skin's planes fix a second direction only
/// if they differ by more than a crease of 33°.
constexpr double kCrease = 0.3;

/// Of the room's edges.
constexpr double kMargin = 0.15;

Vec3 clamp(const Vec3& X, const Box& room) { return X.cwiseMax(room.min()).cwiseMin(room.max()); }

/// As far along a way from a point in the room as the room reaches.
Vec3 go(const Vec3& from, const Vec3& way, const Box& room) {
  double part = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double end = (way[axis] > 0.0 ? room.max() : room.min())[axis] - from[axis];
    if (std::abs(way[axis]) > std::abs(end)) part = std::min(part, end / way[axis]);
  }
  return from + part * way;
}

/// The way off the room's walls along directions that the planes hardly fix: vertices of neighbouring cells
/// that meet there make needles.
Vec3 way_off_walls(const Vec3& X, const ErrorFunction& planes, double truncation, const Box& room) {
  const Vec3 margin = kMargin * room.sizes();
  const Vec3 inwards = clamp(X, Box(room.min() + margin, room.max() - margin)) - X;
  return planes.free_directions(truncation) * inwards;
}

}  // namespace

void ErrorFunction::add(const SurfacePoint& plane) {
  if (count_++ == 0) first_ = plane.point;
  const Vec3 p = plane.point - first_;
  AtA_ += plane.normal * plane.normal.transpose();
  Atb_ += plane.normal * plane.normal.dot(p);
  sum_ += p;
}

ErrorFunction operator+(ErrorFunction a, const ErrorFunction& b) {
  const Vec3 shift = b.first_ - a.first_;
  a.Atb_ += b.Atb_ + b.AtA_ * shift;
  a.AtA_ += b.AtA_;
  a.sum_ += b.sum_ + b.count_ * shift;
  a.count_ += b.count_;
  return a;
}

Vec3 ErrorFunction::way_to_minimum(const Vec3& X, double truncation, const Mat3& allowed) const {
  const Vec3 residual = allowed * (Atb_ - AtA_ * (X - first_));
  Vec3 way = Vec3::Zero();
  if (residual.isZero(0.0)) return way;
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(allowed * AtA_ * allowed);
  const double largest = Eigen::SelfAdjointEigenSolver<Mat3>(AtA_, Eigen::EigenvaluesOnly).eigenvalues()[2];
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = eigen.eigenvectors().col(i);
    if (eigen.eigenvalues()[i] > truncation * truncation * largest)
      way += axis * (axis.dot(residual) / eigen.eigenvalues()[i]);
  }
  return way;
}

Mat3 ErrorFunction::free_directions(double truncation) const {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(AtA_);
  Mat3 projector = Mat3::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = eigen.eigenvectors().col(i);
    if (eigen.eigenvalues()[i] <= truncation * truncation * eigen.eigenvalues()[2])
      projector += axis * axis.transpose();
  }
  return projector;
}

Vec3 mean(const ErrorFunction& skin, const ErrorFunction& cut, const Box& room) {
  return clamp((skin.sum() + cut.sum()) / (skin.count() + cut.count()), room);
}

Vec3 minimum(const ErrorFunction& skin, const ErrorFunction& cut, const Box& room) {
  const Vec3 start = (skin.sum() + cut.sum()) / (skin.count() + cut.count());
  if (skin.empty() || cut.empty()) {
    const ErrorFunction& planes = skin.empty() ? cut : skin;
    const Vec3 X = clamp(start + planes.way_to_minimum(start, kTruncation), room);
    return skin.empty() ? go(X, way_off_walls(X, cut, kTruncation, room), room)  // stays in a plane
                        : clamp(X + way_off_walls(X, skin, kCrease, room), room);
  }
  const Vec3 on_skin = clamp(start + skin.way_to_minimum(start, kCrease), room);
  const Vec3 X = go(on_skin, cut.way_to_minimum(on_skin, kTruncation, skin.free_directions(kCrease)), room);
  return clamp(X + way_off_walls(X, skin + cut, kCrease, room), room);
}

}  // namespace cfem_cutting
