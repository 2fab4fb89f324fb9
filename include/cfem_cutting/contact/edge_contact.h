#pragma once

#include <algorithm>
#include <vector>

#include "cfem_cutting/blade/blade.h"
#include "cfem_cutting/elasticity/integrator.h"

namespace cfem_cutting {

/// A material point that the blade's edge holds: on the skin where the blade first touched, or at the cut's
/// end.
struct EdgeContactPoint {
  Vec3 X;                        ///< m, material
  int voxel;                     ///< a linked voxel whose element carries X
  double along = 0.0;            ///< m, where it sits on the edge, arc length from the heel
  Vec3 on_edge = Vec3::Zero();   ///< m, its point of the edge, in T
  Vec3 tangent = Vec3::UnitX();  ///< unit, of the edge there
  Vec3 push = Vec3::UnitZ();     ///< unit, −back made normal to the tangent: the way the blade cuts
  Vec3 force = Vec3::Zero();     ///< N, on the tissue
  double slip = 0.0;             ///< m, the edge's way along the tangent in this step, for friction
  bool active = false;           ///< the blade pushes at it; else the tissue is still ahead of the blade
  bool at_cut_end = false;       ///< bound in this step, where a cut has just ended
};

/// Unilateral contact of the edge. A bound point becomes active when the blade reaches it: then it is held on
/// the edge in the two directions normal to it and slides along it, with Coulomb friction if set; it becomes
/// inactive when the blade would have to pull at it. A point that leaves the edge's ends is let go.
/// Multipliers (augmented Lagrangian) carry over from step to step; they are the forces.
class EdgeContact {
 public:
  /// @param spacing m, between contact points along the edge
  /// @param stiffness N/m, penalty of a contact point
  EdgeContact(double spacing, double stiffness, double friction);

  bool empty() const { return points_.empty(); }
  bool pushes() const;                                                     ///< whether any point is active
  const std::vector<EdgeContactPoint>& points() const { return points_; }  ///< sorted along the edge

  /// Whether a bound point sits within three quarters of the spacing of this place on the edge.
  bool covers(double along) const;
  void bind(const EdgeContactPoint& point);
  void clear() { points_.clear(); }

  /// Lets go of the points for which `leaves` is true.
  template <typename Predicate>
  void release_if(Predicate leaves) {
    points_.erase(std::remove_if(points_.begin(), points_.end(), leaves), points_.end());
  }

  /// Finds each point's place on the edge now; points beyond its ends are let go.
  /// @param motion what moved the blade in this step, in T (new pose · old pose⁻¹)
  void follow(const Front& front, const Pose& motion, const CompositeMesh& mesh, const NodeField& x);

  /// Constraints of the active points for the next solve.
  std::vector<PointConstraint> constraints(const CompositeMesh& mesh, const NodeField& x, double dt) const;

  /// Takes the forces of solved constraints as multipliers, and frees the points that would pull.
  void take_forces(const std::vector<PointConstraint>& constraints, const NodeField& x);

 private:
  static constexpr int kRows = 3;  // push, sideways, friction
  double spacing_;
  double stiffness_;
  double friction_;
  std::vector<EdgeContactPoint> points_;
};

}  // namespace cfem_cutting
