#pragma once

#include "cfem_cutting/volume/shape.h"

namespace cfem_cutting {

/// Quadratic error function Σ (nᵢ·(X − pᵢ))² of tangent planes (Ju et al. 2002).
class ErrorFunction {
 public:
  void add(const SurfacePoint& plane);

  /// The minimum nearest to the crossings' mean, without directions that the planes hardly fix (truncated
  /// singular value decomposition), kept within a box.
  Vec3 minimum(const Box& bounds) const;

 private:
  Mat3 AtA_ = Mat3::Zero();    // Σ n nᵀ
  Vec3 Atb_ = Vec3::Zero();    // Σ n (n·p), m, about the first point
  Vec3 sum_ = Vec3::Zero();    // Σ p, m, about the first point
  Vec3 first_ = Vec3::Zero();  // m
  int count_ = 0;
};

}  // namespace cfem_cutting
