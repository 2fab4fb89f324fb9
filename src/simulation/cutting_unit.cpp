#include "cfem_cutting/simulation/cutting_unit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cfem_cutting/geometry/polyline.h"

namespace cfem_cutting {
namespace {

/// The nearest point of a front's runs to a query, if there is one.
std::optional<Vec3> nearest_on(const std::vector<Polyline>& front, const Vec3& query) {
  std::optional<Vec3> nearest;
  const auto take = [&](const Vec3& point) {
    if (!nearest || (point - query).norm() < (*nearest - query).norm()) nearest = point;
  };
  for (const Polyline& run : front) {
    if (run.size() == 1) take(run.front());
    if (run.size() > 1) take(project(run, query).point);
  }
  return nearest;
}

}  // namespace

void CuttingUnit::collect(const std::vector<Crossing>& crossings) {
  for (const Crossing& crossing : crossings) {
    const auto at =
        std::lower_bound(candidates_.begin(), candidates_.end(), crossing.link,
                         [](const Candidate& c, const LinkId& link) { return c.crossing.link < link; });
    if (at != candidates_.end() && at->crossing.link == crossing.link) continue;
    Candidate candidate;
    candidate.crossing = crossing;
    candidates_.insert(at, candidate);
  }
}

void CuttingUnit::measure(const VoxelVolume& volume, const OffsetField& offsets,
                          const std::vector<Polyline>& front, const Vec3& push, double block) {
  for (Candidate& c : candidates_) {
    const int a = c.crossing.link.voxel;
    const int b = volume.voxel(a).neighbour[2 * c.crossing.link.axis + 1];
    c.offset = std::max(offsets.offset(a, volume.centre(a)), offsets.offset(b, volume.centre(b)));
    const std::optional<Vec3> nearest = nearest_on(front, c.crossing.at.point);
    if (!nearest || std::isinf(c.passed_by)) continue;
    const Vec3 way = *nearest - c.crossing.at.point;
    const bool passed = way.dot(push) > 0.0;
    c.passed_by = passed ? way.norm() : 0.0;
    c.front_distance = passed ? 0.0 : way.norm();
  }
  drop_if([&](const Candidate& c) { return c.front_distance > 2.0 * block; });
}

void CuttingUnit::leave_behind() {
  for (Candidate& c : candidates_) {
    c.passed_by = std::numeric_limits<double>::infinity();
    c.front_distance = 0.0;
  }
}

void CuttingUnit::begin_next(const std::vector<Candidate>& waiting) {
  ++number;
  blade_work = 0.0;
  peak_force = 0.0;
  candidates_ = waiting;
}

}  // namespace cfem_cutting
