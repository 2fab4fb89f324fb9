#pragma once

#include <functional>

#include "cfem_cutting/volume/lattice.h"

namespace cfem_cutting {

/// A binary indicator, smoothed with a Gaussian; its 0.5 level is a surface without the image's steps.
class SmoothField {
 public:
  /// @param lattice the image's voxels
  /// @param inside first, last: the corners (inclusive) of the indicator's bounds
  /// @param sigma m, of the Gaussian
  SmoothField(const Lattice& lattice, const Vec3i& first, const Vec3i& last, double sigma,
              const std::function<bool(const Vec3i&)>& inside);

  /// 0 (outside) to 1 (inside), trilinear between voxel centres.
  double value(const Vec3& p) const;

  /// By central differences over ± `distance`.
  Vec3 gradient(const Vec3& p, double distance) const;

 private:
  void blur(int axis, double sigma_in_voxels);
  float at(const Vec3i& v) const { return lattice_.contains(v) ? values_[lattice_.index(v)] : 0.0f; }

  Lattice lattice_;
  std::vector<float> values_;
};

}  // namespace cfem_cutting
