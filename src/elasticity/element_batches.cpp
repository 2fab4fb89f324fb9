#include "element_batches.h"

#include <algorithm>
#include <unordered_map>

namespace cfem_cutting {
namespace {

constexpr int kFewestShared = kLanes / 2;  // elements that make a batch with one matrix worthwhile

/// Elements by matrix, in the order of first occurrence.
std::vector<std::vector<int>> group_by_matrix(const ElementSet& elements) {
  std::vector<std::vector<int>> groups;
  std::unordered_map<const ElementMatrix*, std::size_t> group_of_matrix;
  for (int e = 0; e < elements.size(); ++e) {
    const auto [it, added] = group_of_matrix.try_emplace(elements.stiffness[e].get(), groups.size());
    if (added) groups.emplace_back();
    groups[it->second].push_back(e);
  }
  return groups;
}

}  // namespace

ElementBatches::ElementBatches(const ElementSet& elements) {
  std::vector<int> others;
  for (const std::vector<int>& group : group_by_matrix(elements)) {
    if (static_cast<int>(group.size()) >= kFewestShared) {
      add(group, true);
    } else {
      others.insert(others.end(), group.begin(), group.end());
    }
  }
  std::sort(others.begin(), others.end());
  add(others, false);

  nodes.assign(batches.size() * 8 * kLanes, 0);
  std::vector<int> base_of_element(elements.size());
  for (int b = 0; b < size(); ++b) {
    for (int lane = 0; lane < batches[b].count; ++lane) {
      const int e = element_of_lane[batches[b].first + lane];
      base_of_element[e] = b * kEntries + lane;
      for (int n = 0; n < 8; ++n) nodes[(b * 8 + n) * kLanes + lane] = elements.nodes[e][n];
    }
  }
  NodeCorners at(elements);
  for (int node = 0; node < elements.node_count; ++node)
    first_element.push_back(at.corners[at.first[node]] / 8);
  for (int corner : at.corners) slots.push_back(base_of_element[corner / 8] + 3 * (corner % 8) * kLanes);
  first_slot = std::move(at.first);
}

void ElementBatches::add(const std::vector<int>& elements, bool shared) {
  for (std::size_t first = 0; first < elements.size(); first += kLanes) {
    const auto count = std::min<std::size_t>(kLanes, elements.size() - first);
    batches.push_back({static_cast<int>(element_of_lane.size()), static_cast<int>(count), shared});
    element_of_lane.insert(element_of_lane.end(), elements.begin() + first, elements.begin() + first + count);
  }
}

}  // namespace cfem_cutting
