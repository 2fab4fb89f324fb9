#include "cutter.h"

namespace cfem_cutting::random_cuts {

Cutter::Cutter(const VoxelVolume& volume, int composite_level)
    : volume_(volume), level_(composite_level), extractor_(volume_) {
  refresh_reference();
  extractor_.extract({});
}

void Cutter::set_down(const Stroke& stroke) {
  const double segment = 0.5 * volume_.lattice().spacing.minCoeff();
  tracker_ = std::make_unique<FrontTracker>(stroke.blade, segment);
  tracker_->place_anew(stroke.poses.front(), *pull_back_);
}

void Cutter::move(const Pose& X_TB) {
  for (const Pose& pose : tracker_->subdivide(X_TB)) {
    const Polyline before = tracker_->front().points;
    const FrontMotion motion = tracker_->move(pose, volume_, *pull_back_);
    record(motion, before, tracker_->front().points);
    const std::vector<Crossing> met = find_crossings(volume_, sweep(motion.before, motion.after));
    candidates_.insert(candidates_.end(), met.begin(), met.end());
  }
}

/// Far from tissue, where a front isn't pulled back, material and world points are the same.
void Cutter::record(const FrontMotion& motion, const Polyline& before, const Polyline& after) {
  const auto point = [](const std::optional<MaterialPoint>& X, const Vec3& x) { return X ? X->X : x; };
  for (std::size_t i = 0; i + 1 < after.size(); ++i) {
    const Vec3 a = point(motion.before[i], before[i]), b = point(motion.before[i + 1], before[i + 1]),
               c = point(motion.after[i + 1], after[i + 1]), d = point(motion.after[i], after[i]);
    sheet_.push_back({{a, b, c}});
    sheet_.push_back({{a, c, d}});
  }
}

void Cutter::sever() {
  bool any = false;
  for (const Crossing& crossing : candidates_) any |= volume_.sever(crossing.link, crossing.at);
  candidates_.clear();
  if (any) {
    refresh_reference();
    extractor_.freeze();
  }
  const std::vector<Polyline> runs = tracker_->runs_inside();
  extractor_.extract(FrontTrace(runs.begin(), runs.end()));
}

void Cutter::lift() { extractor_.extract({}); }

void Cutter::refresh_reference() {
  mesh_ = std::make_unique<CompositeMesh>(volume_, level_);
  pull_back_ = std::make_unique<InverseMap>(volume_, *mesh_, mesh_->rest());
}

}  // namespace cfem_cutting::random_cuts
