#include "cfem_cutting/cutting/sweep.h"

#include <algorithm>
#include <cassert>

namespace cfem_cutting {
namespace {

/// The strip between neighbouring front points i and i + 1.
class Strip {
 public:
  Strip(const MaterialFront& before, const MaterialFront& after, std::size_t i)
      : corners_{&before[i], &before[i + 1], &after[i + 1], &after[i]} {}

  bool complete() const {
    return std::all_of(corners_.begin(), corners_.end(), [](const auto* c) { return c->has_value(); });
  }
  bool near_links() const {
    return std::any_of(corners_.begin(), corners_.end(),
                       [](const auto* c) { return c->has_value() && (*c)->near_links; });
  }
  void append_to(std::vector<SweptTriangle>& swept) const {
    append(swept, 0, 1, 2);
    append(swept, 0, 2, 3);
  }

 private:
  void append(std::vector<SweptTriangle>& swept, int a, int b, int c) const {
    // Not by the computed area, which may vanish where the exact one doesn't and a link slips by.
    const SweptTriangle triangle{{(*corners_[a])->X, (*corners_[b])->X, (*corners_[c])->X}};
    const auto& [p, q, r] = triangle.corners;
    if (p != q && q != r && r != p) swept.push_back(triangle);
  }

  std::array<const std::optional<MaterialPoint>*, 4> corners_;
};

}  // namespace

std::vector<SweptTriangle> sweep(const MaterialFront& before, const MaterialFront& after) {
  assert(before.size() == after.size());
  std::vector<Strip> strips;
  for (std::size_t i = 0; i + 1 < after.size(); ++i) strips.emplace_back(before, after, i);
  std::vector<SweptTriangle> swept;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    const bool beside =
        (i > 0 && strips[i - 1].near_links()) || (i + 1 < strips.size() && strips[i + 1].near_links());
    if (strips[i].complete() && (strips[i].near_links() || beside)) strips[i].append_to(swept);
  }
  return swept;
}

}  // namespace cfem_cutting
