#include "cfem_cutting/contact/edge_contact.h"

#include <cmath>

namespace cfem_cutting {
namespace {

constexpr double kSlowestSlip = 1.0e-3;  // m/s, below which friction is viscous

/// How far a query lies beyond the polyline's nearer end, m; 0 between the ends.
double beyond_ends(const Polyline& line, const PolylineProjection& at) {
  const double length = (line[at.segment + 1] - line[at.segment]).norm();
  if (at.segment == 0 && at.t < 0.0) return -at.t * length;
  const bool last = at.segment + 2 == static_cast<int>(line.size());
  return last && at.t > 1.0 ? (at.t - 1.0) * length : 0.0;
}

}  // namespace

EdgeContact::EdgeContact(double spacing, double stiffness, double friction)
    : spacing_(spacing), stiffness_(stiffness), friction_(friction) {}

bool EdgeContact::pushes() const {
  return std::any_of(points_.begin(), points_.end(), [](const auto& p) { return p.active; });
}

bool EdgeContact::covers(double along) const {
  return std::any_of(points_.begin(), points_.end(),
                     [&](const auto& p) { return std::abs(p.along - along) < 0.75 * spacing_; });
}

void EdgeContact::bind(const EdgeContactPoint& point) {
  const auto after = std::upper_bound(points_.begin(), points_.end(), point,
                                      [](const auto& a, const auto& b) { return a.along < b.along; });
  points_.insert(after, point);
}

void EdgeContact::follow(const Front& front, const Pose& motion, const CompositeMesh& mesh,
                         const NodeField& x) {
  release_if([&](EdgeContactPoint& p) {
    const Vec3 x_T = mesh.embed(p.voxel, p.X).apply(x);
    const PolylineProjection at = project(front.points, x_T);
    p.along = arc_length(front.points, at);
    p.on_edge = at.point;
    p.tangent = at.tangent;
    p.push = (-front.back + front.back.dot(at.tangent) * at.tangent).normalized();
    p.slip = (at.point - motion.inverse() * at.point).dot(at.tangent);
    p.active = p.active || p.push.dot(p.on_edge - x_T) > 0.0;
    p.at_cut_end = false;
    return beyond_ends(front.points, at) > 0.5 * spacing_;
  });
  std::stable_sort(points_.begin(), points_.end(),
                   [](const auto& a, const auto& b) { return a.along < b.along; });
}

std::vector<PointConstraint> EdgeContact::constraints(const CompositeMesh& mesh, const NodeField& x,
                                                      double dt) const {
  std::vector<PointConstraint> rows;
  rows.reserve(kRows * points_.size());
  for (const EdgeContactPoint& p : points_) {
    if (!p.active) continue;
    const Embedding at = mesh.embed(p.voxel, p.X);
    for (const Vec3& direction : {p.push, Vec3(p.tangent.cross(p.push))})
      rows.push_back({at, direction, direction.dot(p.on_edge), stiffness_, direction.dot(p.force)});
    // Coulomb friction, regularised and lagged by a step: a damper between edge and tissue along the tangent.
    const double normal_force = (p.force - p.force.dot(p.tangent) * p.tangent).norm();
    const double damper = friction_ * normal_force / std::max(std::abs(p.slip), kSlowestSlip * dt);
    rows.push_back({at, p.tangent, p.tangent.dot(at.apply(x)) + p.slip, damper, 0.0});
  }
  return rows;
}

void EdgeContact::take_forces(const std::vector<PointConstraint>& constraints, const NodeField& x) {
  auto row = constraints.begin();
  for (EdgeContactPoint& p : points_) {
    p.force.setZero();
    if (!p.active) continue;
    for (int i = 0; i < kRows; ++i, ++row) p.force += row->force(x) * row->direction;
    p.active = p.force.dot(p.push) > 0.0;
    if (!p.active) p.force.setZero();
  }
}

}  // namespace cfem_cutting
