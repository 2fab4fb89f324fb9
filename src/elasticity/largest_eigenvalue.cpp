#include "largest_eigenvalue.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <tuple>

#include "morton.h"

namespace cfem_cutting {
namespace {

/// Of conjugate gradients. A whole level has more to look at, and is looked at once.
constexpr int kStepsAnew = 20, kStepsNear = 10;

std::uint64_t mix(std::uint64_t hash, std::uint64_t more) { return (hash ^ more) * 0x9E3779B97F4A7C15u; }

std::uint64_t mix_diagonal(const ElementMatrix& K) {
  std::uint64_t hash = 0;
  for (int i = 0; i < K.rows(); ++i) {
    const double entry = K(i, i);
    std::uint64_t bits = 0;
    std::memcpy(&bits, &entry, sizeof bits);
    hash = mix(hash, bits);
  }
  return hash;
}

/// Nodes that are not held, of elements.
std::vector<char> free_nodes(const ElementSet& set, const std::vector<char>& held,
                             const std::vector<int>& elements) {
  std::vector<char> free(set.node_count, 0);
  for (int e : elements)
    for (int node : set.nodes[e]) free[node] = !held[node];
  return free;
}

/// The elements that meet at flagged nodes, with nodes numbered anew.
struct Part {
  Part(const TiledElements& whole, const std::vector<char>& flagged) {
    std::vector<int> number(flagged.size(), -1);
    for (int e = 0; e < whole.set.size(); ++e) {
      const ElementNodes& nodes = whole.set.nodes[e];
      if (std::none_of(nodes.begin(), nodes.end(), [&](int n) { return flagged[n] != 0; })) continue;
      set.block.push_back(whole.set.block[e]);
      set.stiffness.push_back(whole.set.stiffness[e]);
      set.nodes.push_back(nodes);
      for (int& node : set.nodes.back()) {
        if (number[node] < 0) {
          number[node] = set.node_count++;
          held.push_back(!flagged[node]);
        }
        node = number[node];
      }
    }
  }
  ElementSet set;
  std::vector<char> held;
};

}  // namespace

bool LargestEigenvalue::before(const Print& a, const Print& b) {
  return std::tie(a.place, a.look) < std::tie(b.place, b.look);
}

std::vector<LargestEigenvalue::Print> LargestEigenvalue::prints_of(const LevelSystem& level) {
  const ElementSet& set = level.product().elements().set;
  const NodeCorners& at = level.product().elements().corners;
  std::vector<Print> prints(set.size());
  std::uint64_t matrix = 0;
  for (int e = 0; e < set.size(); ++e) {
    if (e == 0 || set.stiffness[e] != set.stiffness[e - 1]) matrix = mix_diagonal(set.stiffness[e]->whole);
    std::uint64_t look = matrix;
    for (int node : set.nodes[e])
      look = mix(look, 2 * (at.first[node + 1] - at.first[node]) + (level.held()[node] ? 1 : 0));
    prints[e] = {morton_place(set.block[e]), look, e};
  }
  if (!std::is_sorted(prints.begin(), prints.end(), before)) std::sort(prints.begin(), prints.end(), before);
  return prints;
}

double LargestEigenvalue::largest_near(const std::vector<Print>& changed, const LevelSystem& level) {
  std::vector<int> elements;
  elements.reserve(changed.size());
  for (const Print& print : changed) elements.push_back(print.element);
  const TiledElements& whole = level.product().elements();
  Part part(whole, free_nodes(whole.set, level.held(), elements));
  LevelSystem system(level.product().pool());
  system.arrange(std::make_shared<TiledElements>(std::move(part.set)), std::move(part.held));
  return system.largest_at_rest(kStepsNear);
}

double LargestEigenvalue::update(LevelSystem& level) {
  std::vector<Print> now = prints_of(level);
  std::vector<Print> changed;
  std::set_difference(now.begin(), now.end(), known_.begin(), known_.end(), std::back_inserter(changed),
                      before);
  if (changed.size() > now.size() / 2) {
    largest_ = level.largest_at_rest(kStepsAnew);
  } else if (!changed.empty()) {
    largest_ = std::max(largest_, largest_near(changed, level));
  }
  known_ = std::move(now);
  return largest_;
}

}  // namespace cfem_cutting
