#pragma once

#include <optional>

#include "cfem_cutting/volume/lattice.h"

namespace cfem_cutting {

/// Hermite datum: where a link meets a surface and the surface's unit normal there.
struct SurfacePoint {
  Vec3 point;   ///< m, material space
  Vec3 normal;  ///< unit
};

/// A source of tissue in the tissue frame: a box, a closed mesh, a label volume.
class Shape {
 public:
  virtual ~Shape() = default;

  /// Bounds of the tissue, m.
  virtual Box bounds() const = 0;

  /// Labels (≥ 0) along a column of points parallel to z, −1 where there is no tissue. Batched so that a
  /// mesh is intersected once per column. Meshes and boxes have the label 0.
  /// @param z ascending, m
  virtual std::vector<int> labels_along_z(double x, double y, const std::vector<double>& z) const = 0;

  /// Where the segment from `inside` (tissue) to `outside` (none) leaves the tissue, with the outward
  /// normal; the last crossing if there are several.
  virtual SurfacePoint exit(const Vec3& inside, const Vec3& outside) const = 0;

  /// Exact volume of the source, m³.
  virtual double volume() const = 0;
};

}  // namespace cfem_cutting
