#include "cfem_cutting/cutting/fracture.h"

#include <algorithm>

namespace cfem_cutting {
namespace {

Fracture sever_all(const std::vector<Candidate>& candidates) {
  Fracture fracture;
  fracture.happens = fracture.advances = !candidates.empty();
  for (const Candidate& c : candidates) fracture.severed.push_back(c.crossing);
  return fracture;
}

}  // namespace

Fracture decide(const FractureOptions& options, const std::vector<Candidate>& candidates,
                double contact_offset, double block) {
  if (options.mode == FractureMode::kImmediate) return sever_all(candidates);
  const double left_behind = std::max(options.onset_offset, 2.0 * block);
  double largest = contact_offset;
  bool any_left = false;
  for (const Candidate& c : candidates) {
    largest = std::max(largest, c.offset);
    any_left |= c.passed_by > left_behind;
  }
  Fracture fracture;
  const bool onset = largest > options.onset_offset;
  fracture.happens = onset || any_left;
  fracture.advances = onset;
  for (const Candidate& c : candidates) {
    const bool released = (onset && c.offset > options.release_offset) || c.passed_by > left_behind;
    if (fracture.happens && released)
      fracture.severed.push_back(c.crossing);
    else
      fracture.waiting.push_back(c);
  }
  return fracture;
}

}  // namespace cfem_cutting
