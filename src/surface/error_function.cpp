#include "error_function.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace cfem_cutting {
namespace {

constexpr double kTruncation = 0.1;

/// Of the room's edges: where there is a cut, the skin's planes may be missed by less.
constexpr double kSkinGives = 0.2;

/// Of the room's edges.
constexpr double kMargin = 0.15;

Vec3 clamp(const Vec3& X, const Box& room) { return X.cwiseMax(room.min()).cwiseMin(room.max()); }

/// How far a way from a point in the room stays there: a part of it, and the axis of the wall that ends it,
/// or −1.
struct Reach {
  Reach(const Vec3& from, const Vec3& way, const Box& room) {
    for (int i = 0; i < 3; ++i) {
      const double end = (way[i] > 0.0 ? room.max() : room.min())[i] - from[i];
      if (!(std::abs(way[i]) > std::abs(end)) || end / way[i] >= part) continue;
      part = end / way[i];
      axis = i;
    }
  }
  double part = 1.0;
  int axis = -1;
};

Vec3 go(const Vec3& from, const Vec3& way, const Box& room) {
  return from + Reach(from, way, room).part * way;
}

/// Towards the planes' minimum along allowed directions: along a wall of the room, too, where it is in the
/// way.
Vec3 slide(Vec3 X, const ErrorFunction& planes, Mat3 allowed, const Box& room) {
  for (int walls = 0; walls < 3; ++walls) {
    const Vec3 way = planes.way_to_minimum(X, kTruncation, allowed);
    const Reach reach(X, way, room);
    X += reach.part * way;
    if (reach.axis < 0) break;
    const Vec3 normal = allowed.col(reach.axis);  // of the wall, as far as allowed
    if (normal[reach.axis] < 1e-6) break;
    allowed -= normal * normal.transpose() / normal[reach.axis];
  }
  return X;
}

/// The way off the room's walls along directions that the planes hardly fix: vertices of neighbouring cells
/// that meet there make needles.
Vec3 way_off_walls(const Vec3& X, const ErrorFunction& planes, double truncation, const Box& room) {
  const Vec3 margin = kMargin * room.sizes();
  const Vec3 inwards = clamp(X, Box(room.min() + margin, room.max() - margin)) - X;
  return planes.free_directions(truncation) * inwards;
}

/// Begins below the mean of all crossings if that is in the room, else at the cut's own crossings, which are.
Vec3 minimum_on_cut(const Vec3& start, const ErrorFunction& skin, const ErrorFunction& cut, const Box& room) {
  const Mat3 in_plane = cut.free_directions(kTruncation);
  const auto onto_cut = [&](const Vec3& from) -> Vec3 {
    return from + cut.way_to_minimum(from, kTruncation);
  };
  const Vec3 below = onto_cut(start);
  const Vec3 on_cut = room.contains(below) ? below : clamp(onto_cut(cut.sum() / cut.count()), room);
  const Vec3 X = slide(on_cut, skin, in_plane, room);
  return go(X, in_plane * way_off_walls(X, skin + cut, kCrease, room), room);
}

Vec3 minimum_on_skin(const Vec3& start, const ErrorFunction& skin, const ErrorFunction& cut,
                     const Box& room) {
  const Vec3 on_skin = clamp(start + skin.way_to_minimum(start, kCrease), room);
  const Vec3 X = go(on_skin, cut.way_to_minimum(on_skin, kTruncation, skin.free_directions(kCrease)), room);
  return clamp(X + way_off_walls(X, skin + cut, kCrease, room), room);
}

}  // namespace

void ErrorFunction::add(const SurfacePoint& plane) {
  if (count_++ == 0) first_ = plane.point;
  const Vec3 p = plane.point - first_;
  AtA_ += plane.normal * plane.normal.transpose();
  Atb_ += plane.normal * plane.normal.dot(p);
  btb_ += std::pow(plane.normal.dot(p), 2);
  sum_ += p;
}

ErrorFunction operator+(ErrorFunction a, const ErrorFunction& b) {
  const Vec3 shift = b.first_ - a.first_;
  a.Atb_ += b.Atb_ + b.AtA_ * shift;
  a.btb_ += b.btb_ + shift.dot(2.0 * b.Atb_ + b.AtA_ * shift);
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

double ErrorFunction::misfit(const Vec3& X) const {
  const Vec3 x = X - first_;
  return std::sqrt(std::max(0.0, x.dot(AtA_ * x - 2.0 * Atb_) + btb_) / count_);
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
  const Vec3 on_cut = minimum_on_cut(start, skin, cut, room);
  const bool near_skin = skin.misfit(on_cut) < kSkinGives * room.sizes().minCoeff();
  return near_skin ? on_cut : minimum_on_skin(start, skin, cut, room);
}

}  // namespace cfem_cutting
