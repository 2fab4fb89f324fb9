#include "cfem_cutting/simulation/grips.h"

#include <algorithm>

namespace cfem_cutting {

void Grips::find_nodes(const CompositeMesh& mesh) {
  held_ = {};
  grip_of_held_.clear();
  for (int node = 0; node < mesh.node_count(); ++node) {
    const Vec3 X = mesh.rest().col(node);
    const auto grip =
        std::find_if(grips_.begin(), grips_.end(), [&](const auto& g) { return g.box.contains(X); });
    if (grip == grips_.end()) continue;
    held_.nodes.push_back(node);
    held_.positions.push_back(X);
    grip_of_held_.push_back(static_cast<int>(grip - grips_.begin()));
  }
}

double Grips::move(const CompositeMesh& mesh, double time, const std::map<std::string, Pose>& frames) {
  for (const auto& [name, pose] : frames)
    carriers_.try_emplace(name, Carrier{pose, pose}).first->second.now = pose;
  double farthest = 0.0;
  for (std::size_t i = 0; i < held_.nodes.size(); ++i) {
    const Vec3 next = position(grip_of_held_[i], mesh.rest().col(held_.nodes[i]), time);
    farthest = std::max(farthest, (next - held_.positions[i]).norm());
    held_.positions[i] = next;
  }
  return farthest;
}

Vec3 Grips::position(int grip, const Vec3& X, double time) const {
  const GripConfig& g = grips_[grip];
  const double share = g.ramp > 0.0 ? std::min(1.0, time / g.ramp) : 1.0;
  Vec3 displaced = X + share * g.displacement;
  const auto carrier = carriers_.find(g.follow);
  if (carrier == carriers_.end()) return displaced;
  return carrier->second.now * (carrier->second.first.inverse() * displaced);
}

std::vector<int> Grips::idle() const {
  std::vector<int> idle;
  for (int grip = 0; grip < static_cast<int>(grips_.size()); ++grip)
    if (std::find(grip_of_held_.begin(), grip_of_held_.end(), grip) == grip_of_held_.end())
      idle.push_back(grip);
  return idle;
}

}  // namespace cfem_cutting
