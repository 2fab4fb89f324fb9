#include "cfem_cutting/cutting/swept_trail.h"

#include <algorithm>
#include <utility>

namespace cfem_cutting {
namespace {

bool in_same_place(const std::optional<MaterialPoint>& a, const std::optional<MaterialPoint>& b) {
  return a.has_value() == b.has_value() && (!a || a->inside == b->inside);
}

/// Whether the same points of both fronts are inside tissue, beside it and far from it.
bool alike(const MaterialFront& a, const MaterialFront& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), in_same_place);
}

/// The longest way of a point from one front to the other, m.
double longest_way(const MaterialFront& a, const MaterialFront& b) {
  double longest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] && b[i]) longest = std::max(longest, (b[i]->X - a[i]->X).norm());
  return longest;
}

}  // namespace

void SweptTrail::follow(const MaterialFront& before, const MaterialFront& after) {
  if (row_.empty()) row_ = before;
  if (!alike(before, after)) {
    end_row(before);
    end_row(after);
  } else if (longest_way(row_, after) >= grain_) {
    end_row(after);
  }
  last_ = after;
}

std::vector<SweptTriangle> SweptTrail::take() {
  if (!last_.empty()) end_row(last_);
  return std::exchange(triangles_, {});
}

void SweptTrail::give_back(const std::vector<SweptTriangle>& uncut) {
  triangles_.insert(triangles_.begin(), uncut.begin(), uncut.end());
}

void SweptTrail::drop() {
  row_.clear();
  last_.clear();
  triangles_.clear();
}

void SweptTrail::end_row(const MaterialFront& at) {
  const std::vector<SweptTriangle> strip = sweep(row_, at);
  triangles_.insert(triangles_.end(), strip.begin(), strip.end());
  row_ = at;
}

}  // namespace cfem_cutting
