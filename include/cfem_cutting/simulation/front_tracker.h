#pragma once

#include <vector>

#include "cfem_cutting/blade/blade.h"
#include "cfem_cutting/cutting/sweep.h"
#include "cfem_cutting/volume/inside.h"

namespace cfem_cutting {

/// A point of the front that lies in tissue.
struct Touch {
  double along;         ///< m, arc length on the edge from the heel
  Vec3 on_edge;         ///< m, in T
  Vec3 X;               ///< m, material: where it entered the skin in this motion, else where it is
  int voxel;            ///< linked voxel that carries X
  bool enters = false;  ///< it was outside before this motion
};

/// What the front did in one motion, in material space.
struct FrontMotion {
  MaterialFront before;
  MaterialFront after;
  std::vector<Touch> touches;  ///< along the edge
};

/// Where the edge, followed from a place on it, ends or leaves the tissue.
struct FrontEnd {
  Vec3 X;           ///< m, material, the last point in tissue
  bool edge_ends;   ///< in tissue, at X
  bool goes_on;     ///< in tissue, as far as it was followed
  Vec3 X_at_start;  ///< m, of the front at the place where it starts
  Polyline way;     ///< m, material, points of the front from there on
};

/// Follows the blade's front in world and material space. Front points, once pulled back, are kept as
/// material points: a sweep starts exactly where the last one ended, so no link slips through the seam.
class FrontTracker {
 public:
  /// @param segment m, longest segment of the front, and longest way of its points in one motion
  FrontTracker(const Blade& blade, double segment) : blade_(blade), segment_(segment) {}

  /// Sets the front without a way to there.
  void place_anew(const Pose& X_TB, const InverseMap& reference);

  /// Poses between the present one and X_TB such that no point of the edge moves farther than a segment at
  /// once.
  std::vector<Pose> subdivide(const Pose& X_TB) const;

  /// Moves the front and pulls it back to material space.
  FrontMotion move(const Pose& X_TB, const VoxelVolume& volume, const InverseMap& reference);

  bool placed() const { return !front_.points.empty(); }
  const Pose& pose() const { return X_TB_; }
  const Front& front() const { return front_; }
  const MaterialFront& material() const { return material_; }

  /// Points of the front inside tissue, where they are now.
  std::vector<Touch> inside() const;

  /// Follows the edge towards its heel (step −1) or tip (1) as long as it is in tissue.
  /// @param along, until m, arc lengths of the start and of where to stop
  /// @return nothing if the start is not in tissue
  std::optional<FrontEnd> end_beyond(double along, double until, int step, const VoxelVolume& volume) const;

  /// From a place on the edge to its heel (step −1) or tip (1), m.
  double length_beyond(double along, int step) const;

  /// Of the front at a place on it, m; nothing far from tissue.
  std::optional<Vec3> material_at(double along) const;

  /// Unit, of the front in material space at a place on it, towards its heel (step −1) or tip (1); zero where
  /// it is far from tissue.
  Vec3 material_tangent(double along, int step) const;

  /// The front's runs inside tissue, in material space.
  std::vector<Polyline> runs_inside() const;

  /// The front's runs in and beside tissue, in material space.
  std::vector<Polyline> runs_near() const;

 private:
  template <typename Predicate>
  std::vector<Polyline> runs_where(const Predicate& belongs) const;
  int segment_at(double along) const;
  MaterialFront pull_back(const Front& front, const InverseMap& reference) const;

  Blade blade_;
  double segment_;
  Pose X_TB_ = Pose::Identity();
  Front front_;
  MaterialFront material_;
};

}  // namespace cfem_cutting
