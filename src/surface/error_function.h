#pragma once

#include "cfem_cutting/volume/shape.h"

namespace cfem_cutting {

/// Beside a cut, and where a vertex is near its cell's walls, the skin's planes fix a second direction only
/// if they differ by more than a crease of 33°.
constexpr double kCrease = 0.3;

/// Quadratic error function Σ (nᵢ·(X − pᵢ))² of tangent planes (Ju et al. 2002).
class ErrorFunction {
 public:
  void add(const SurfacePoint& plane);

  /// Of the planes of both, which have some.
  friend ErrorFunction operator+(ErrorFunction a, const ErrorFunction& b);

  bool empty() const { return count_ == 0; }
  int count() const { return count_; }
  Vec3 sum() const { return count_ * first_ + sum_; }  ///< m, of the crossings

  /// The way from X to the nearest minimum, without directions that the planes hardly fix: singular values
  /// below `truncation` of the largest count as zero (Ju et al. 2002, section 2.3).
  /// @param allowed projector onto the directions that the way may have
  Vec3 way_to_minimum(const Vec3& X, double truncation, const Mat3& allowed = Mat3::Identity()) const;

  /// Root mean square of the planes' distances, m.
  double misfit(const Vec3& X) const;

  /// Projector onto the directions that the planes hardly fix.
  Mat3 free_directions(double truncation) const;

 private:
  Mat3 AtA_ = Mat3::Zero();    // Σ n nᵀ
  Vec3 Atb_ = Vec3::Zero();    // Σ n (n·p), m, about the first point
  double btb_ = 0.0;           // Σ (n·p)², m², about the first point
  Vec3 sum_ = Vec3::Zero();    // Σ p, m, about the first point
  Vec3 first_ = Vec3::Zero();  // m
  int count_ = 0;
};

/// The minimum of skin and cut planes in a box that holds the crossings: on the cut, if the skin can be near
/// it there; else the skin comes first and the cut's planes decide where it leaves a choice (cuts known by
/// their links alone must not move the skin far: else the volume changes by up to 2.5 %). Near the box's
/// walls the minimum gives way along directions that the planes hardly fix: those of a cut, and of skin with
/// creases under 33°. Either may be empty, not both.
Vec3 minimum(const ErrorFunction& skin, const ErrorFunction& cut, const Box& room);

/// The mean of the crossings, as far as a box allows.
Vec3 mean(const ErrorFunction& skin, const ErrorFunction& cut, const Box& room);

}  // namespace cfem_cutting
