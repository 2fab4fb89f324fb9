#include "cfem_cutting/simulation/front_tracker.h"

#include <cmath>

namespace cfem_cutting {

void FrontTracker::lift() {
  front_ = {};
  material_.clear();
}

void FrontTracker::place_anew(const Pose& X_TB, const InverseMap& reference) {
  X_TB_ = X_TB;
  front_ = place(blade_, X_TB, segment_);
  material_ = pull_back(front_, reference);
}

std::vector<Pose> FrontTracker::subdivide(const Pose& X_TB) const {
  const int parts = std::max(1, static_cast<int>(std::ceil(travel(blade_, X_TB_, X_TB) / segment_)));
  std::vector<Pose> poses;
  for (int i = 1; i < parts; ++i) poses.push_back(interpolate(X_TB_, X_TB, static_cast<double>(i) / parts));
  poses.push_back(X_TB);
  return poses;
}

FrontMotion FrontTracker::move(const Pose& X_TB, const VoxelVolume& volume, const InverseMap& reference) {
  FrontMotion motion;
  motion.before = std::move(material_);
  place_anew(X_TB, reference);
  motion.after = material_;
  motion.touches = inside();
  const MaterialFront& before = motion.before;
  std::size_t touch = 0;
  for (std::size_t i = 0; i < material_.size(); ++i) {
    if (!material_[i] || !material_[i]->inside) continue;
    Touch& t = motion.touches[touch++];
    const bool enters =
        before[i] && tissue_voxel_at(volume, before[i]->X) < 0 && tissue_voxel_at(volume, t.X) >= 0;
    if (!enters) continue;
    const Entry entry = find_entry(volume, before[i]->X, t.X);
    t.X = entry.X;
    t.voxel = entry.voxel;
  }
  return motion;
}

std::vector<Touch> FrontTracker::inside() const {
  const std::vector<double> along = arc_lengths();
  std::vector<Touch> touches;
  for (std::size_t i = 0; i < material_.size(); ++i) {
    if (material_[i] && material_[i]->inside)
      touches.push_back({along[i], front_.points[i], material_[i]->X, material_[i]->voxel});
  }
  return touches;
}

std::vector<Polyline> FrontTracker::runs_inside() const {
  std::vector<Polyline> runs;
  bool running = false;
  for (const auto& point : material_) {
    const bool inside = point && point->inside;
    if (inside && !running) runs.emplace_back();
    if (inside) runs.back().push_back(point->X);
    running = inside;
  }
  return runs;
}

std::vector<double> FrontTracker::arc_lengths() const {
  std::vector<double> along(front_.points.size(), 0.0);
  for (std::size_t i = 1; i < along.size(); ++i)
    along[i] = along[i - 1] + (front_.points[i] - front_.points[i - 1]).norm();
  return along;
}

MaterialFront FrontTracker::pull_back(const Front& front, const InverseMap& reference) const {
  MaterialFront material;
  material.reserve(front.points.size());
  for (const Vec3& x_T : front.points) material.push_back(reference(x_T));
  return material;
}

}  // namespace cfem_cutting
