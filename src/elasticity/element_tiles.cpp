#include "element_tiles.h"

#include <algorithm>
#include <unordered_map>

namespace cfem_cutting {
namespace {

constexpr int kFewestShared = kLanes / 2;  // elements that make a batch with one matrix worthwhile

/// Elements by matrix, in the order of first occurrence.
std::vector<std::vector<int>> group_by_matrix(const ElementSet& elements, int begin, int end) {
  std::vector<std::vector<int>> groups;
  std::unordered_map<const ElementMatrix*, std::size_t> group_of_matrix;
  for (int e = begin; e < end; ++e) {
    const auto [it, added] = group_of_matrix.try_emplace(elements.stiffness[e].get(), groups.size());
    if (added) groups.emplace_back();
    groups[it->second].push_back(e);
  }
  return groups;
}

}  // namespace

ElementTiles::ElementTiles(const ElementSet& elements, const NodeCorners& at)
    : tile_size_(std::clamp(elements.size() / 4, kTile / 4, kTile)) {
  nodes.reserve(static_cast<std::size_t>(elements.size()) * 9);  // batches are hardly ever full
  for (int begin = 0; begin < elements.size(); begin += tile_size_)
    add_tile(elements, begin, std::min(elements.size(), begin + tile_size_));
  add_nodes(elements, at);
  add_totals(elements.node_count);
}

void ElementTiles::add_batches(const std::vector<int>& elements, bool shared) {
  for (std::size_t first = 0; first < elements.size(); first += kLanes) {
    const auto count = std::min<std::size_t>(kLanes, elements.size() - first);
    batches.push_back({static_cast<int>(element_of_lane.size()), static_cast<int>(count), shared});
    element_of_lane.insert(element_of_lane.end(), elements.begin() + first, elements.begin() + first + count);
  }
}

void ElementTiles::add_tile(const ElementSet& elements, int begin, int end) {
  const int first = size();
  std::vector<int> others;
  for (const std::vector<int>& group : group_by_matrix(elements, begin, end)) {
    if (static_cast<int>(group.size()) >= kFewestShared) {
      add_batches(group, true);
    } else {
      others.insert(others.end(), group.begin(), group.end());
    }
  }
  add_batches(others, false);
  tiles_.push_back({first, size()});
  nodes.resize(batches.size() * 8 * kLanes, 0);
  for (int b = first; b < size(); ++b)
    for (int lane = 0; lane < batches[b].count; ++lane)
      for (int n = 0; n < 8; ++n)
        nodes[(b * 8 + n) * kLanes + lane] = elements.nodes[element_of_lane[batches[b].first + lane]][n];
}

/// Per tile its nodes with the quads that they add up.
void ElementTiles::add_nodes(const ElementSet& elements, const NodeCorners& at) {
  std::vector<int> slot_of_corner(8 * static_cast<std::size_t>(elements.size()));
  for (const Tile& tile : tiles_)
    for (int b = tile.first_batch; b < tile.end_batch; ++b)
      for (int lane = 0; lane < batches[b].count; ++lane)
        for (int n = 0; n < 8; ++n)
          slot_of_corner[8 * element_of_lane[batches[b].first + lane] + n] =
              ((b - tile.first_batch) * 8 + n) * kLanes + place_of_lane(lane);

  // Of each tile: the corners of its elements, by node.
  std::vector<std::vector<std::pair<int, int>>> corners(tiles_.size());
  for (auto& of_tile : corners) of_tile.reserve(8 * static_cast<std::size_t>(tile_size_));
  std::vector<char> on_border(elements.node_count, 0);
  for (int node = 0; node < elements.node_count; ++node) {
    const int first = at.corners[at.first[node]];
    for (int i = at.first[node]; i < at.first[node + 1]; ++i) {
      const int tile = at.corners[i] / 8 / tile_size_;
      corners[tile].emplace_back(node, slot_of_corner[at.corners[i]]);
      if (tile != first / 8 / tile_size_) on_border[node] = 1;
    }
  }
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    Tile& tile = tiles_[t];
    tile.inner = static_cast<int>(inner_sums_.nodes.size());
    tile.border = static_cast<int>(border_sums_.nodes.size());
    for (std::size_t i = 0; i < corners[t].size(); ++i) {
      const auto [node, slot] = corners[t][i];
      Sums<std::uint16_t>& sums = on_border[node] ? border_sums_ : inner_sums_;
      sums.add(node, i == 0 || corners[t][i - 1].first != node, static_cast<std::uint16_t>(slot));
    }
    tile.end_inner = static_cast<int>(inner_sums_.nodes.size());
    tile.end_border = static_cast<int>(border_sums_.nodes.size());
  }
}

/// Gathers the sums on borders by node, and numbers them.
void ElementTiles::add_totals(int node_count) {
  const int count = static_cast<int>(border_sums_.nodes.size());
  std::vector<std::vector<int>> entries_of_node;
  std::vector<int> place(node_count, -1);
  for (int entry = 0; entry < count; ++entry) {
    int& at = place[border_sums_.nodes[entry]];
    if (at < 0) {
      at = static_cast<int>(entries_of_node.size());
      entries_of_node.emplace_back();
      total_sums_.nodes.push_back(border_sums_.nodes[entry]);
    }
    entries_of_node[at].push_back(entry);
    border_sums_.nodes[entry] = entry;
  }
  for (const std::vector<int>& entries : entries_of_node) {
    total_sums_.terms.insert(total_sums_.terms.end(), entries.begin(), entries.end());
    total_sums_.first.push_back(static_cast<int>(total_sums_.terms.size()));
  }
}

}  // namespace cfem_cutting
