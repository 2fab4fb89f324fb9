#include "cfem_cutting/simulation/front_tracker.h"

#include <algorithm>
#include <cmath>

namespace cfem_cutting {

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
    t.enters = true;
  }
  return motion;
}

std::vector<Touch> FrontTracker::inside() const {
  const std::vector<double> along = arc_lengths(front_.points);
  std::vector<Touch> touches;
  for (std::size_t i = 0; i < material_.size(); ++i) {
    if (material_[i] && material_[i]->inside)
      touches.push_back({along[i], front_.points[i], material_[i]->X, material_[i]->voxel});
  }
  return touches;
}

int FrontTracker::segment_at(double along) const {
  const std::vector<double> at = arc_lengths(front_.points);
  const int next = static_cast<int>(std::upper_bound(at.begin(), at.end(), along) - at.begin());
  return std::clamp(next, 1, static_cast<int>(at.size()) - 1) - 1;
}

std::optional<Vec3> FrontTracker::material_at(double along) const {
  const int i = segment_at(along);
  if (!material_[i] || !material_[i + 1]) return std::nullopt;
  const std::vector<double> at = arc_lengths(front_.points);
  if (!(at[i + 1] > at[i])) return material_[i]->X;
  const double part = std::clamp((along - at[i]) / (at[i + 1] - at[i]), 0.0, 1.0);
  return material_[i]->X + part * (material_[i + 1]->X - material_[i]->X);
}

Vec3 FrontTracker::material_tangent(double along, int step) const {
  const int i = segment_at(along);
  if (!material_[i] || !material_[i + 1]) return Vec3::Zero();
  return step * (material_[i + 1]->X - material_[i]->X).normalized();
}

std::optional<FrontEnd> FrontTracker::end_beyond(double along, double until, int step,
                                                 const VoxelVolume& volume) const {
  const std::vector<double> at = arc_lengths(front_.points);
  const int count = static_cast<int>(at.size());
  const auto inside = [&](int i) { return i >= 0 && i < count && material_[i] && material_[i]->inside; };
  const int before = segment_at(along), next = before + 1;
  if (!material_[before] || !material_[next]) return std::nullopt;
  const double part = (along - at[before]) / (at[next] - at[before]);
  FrontEnd end;
  end.X_at_start = material_[before]->X + part * (material_[next]->X - material_[before]->X);
  if (tissue_voxel_at(volume, end.X_at_start) < 0) return std::nullopt;
  end.X = end.X_at_start;
  int i = step > 0 ? next : before;
  const double rounding = 1e-9 * at.back();
  for (; inside(i) && step * (until - at[i]) > rounding; i += step) {
    end.X = material_[i]->X;
    end.way.push_back(end.X);
  }
  end.edge_ends = i < 0 || i == count;
  end.goes_on = inside(i);
  const bool leaves = i >= 0 && i < count && material_[i] && tissue_voxel_at(volume, material_[i]->X) < 0;
  if (leaves) end.X = find_entry(volume, material_[i]->X, end.X).X;
  return end;
}

double FrontTracker::length_beyond(double along, int step) const {
  return step > 0 ? arc_lengths(front_.points).back() - along : along;
}

template <typename Predicate>
std::vector<Polyline> FrontTracker::runs_where(const Predicate& belongs) const {
  std::vector<Polyline> runs;
  bool running = false;
  for (const auto& point : material_) {
    const bool goes_on = point && belongs(*point);
    if (goes_on && !running) runs.emplace_back();
    if (goes_on) runs.back().push_back(point->X);
    running = goes_on;
  }
  return runs;
}

std::vector<Polyline> FrontTracker::runs_inside() const {
  return runs_where([](const MaterialPoint& point) { return point.inside; });
}

std::vector<Polyline> FrontTracker::runs_near() const {
  return runs_where([](const MaterialPoint&) { return true; });
}

MaterialFront FrontTracker::pull_back(const Front& front, const InverseMap& reference) const {
  MaterialFront material;
  material.reserve(front.points.size());
  for (const Vec3& x_T : front.points) material.push_back(reference(x_T));
  return material;
}

}  // namespace cfem_cutting
