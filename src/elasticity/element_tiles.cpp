#include "element_tiles.h"

#include <algorithm>
#include <cassert>
#include <unordered_map>

namespace cfem_cutting {
namespace {

constexpr int kFewestShared = kLanes / 2;  // elements that make a batch with one matrix worthwhile

/// Elements by matrix, in the order of first occurrence.
std::vector<std::vector<int>> group_by_matrix(const ElementSet& elements, int begin, int end) {
  std::vector<std::vector<int>> groups;
  std::unordered_map<const RestMatrix*, std::size_t> group_of_matrix;
  for (int e = begin; e < end; ++e) {
    const auto [it, added] = group_of_matrix.try_emplace(elements.stiffness[e].get(), groups.size());
    if (added) groups.emplace_back();
    groups[it->second].push_back(e);
  }
  return groups;
}

}  // namespace

ElementTiles::ElementTiles(const ElementSet& elements, const NodeCorners& at)
    : tile_size_(tile_size(elements.size())) {
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
  std::vector<int> others, with_rigid_forces;  // batches have matrices of one form
  for (const std::vector<int>& group : group_by_matrix(elements, begin, end)) {
    if (static_cast<int>(group.size()) >= kFewestShared) {
      add_batches(group, true);
    } else {
      std::vector<int>& own = elements.stiffness[group.front()]->deformations ? others : with_rigid_forces;
      own.insert(own.end(), group.begin(), group.end());
    }
  }
  add_batches(others, false);
  add_batches(with_rigid_forces, false);
  tiles_.push_back({first, size()});
  nodes.resize(batches.size() * 8 * kLanes, 0);
  for (int b = first; b < size(); ++b)
    for (int lane = 0; lane < batches[b].count; ++lane)
      for (int n = 0; n < 8; ++n)
        nodes[(b * 8 + n) * kLanes + lane] = elements.nodes[element_of_lane[batches[b].first + lane]][n];
}

/// Slots of corners among the quads of their tile, as 8 e + corner.
std::vector<std::uint16_t> ElementTiles::slots_of_corners(const ElementSet& elements) const {
  std::vector<std::uint16_t> slots(8 * static_cast<std::size_t>(elements.size()));
  for (const Tile& tile : tiles_)
    for (int b = tile.first_batch; b < tile.end_batch; ++b)
      for (int lane = 0; lane < batches[b].count; ++lane)
        for (int n = 0; n < 8; ++n)
          slots[8 * element_of_lane[batches[b].first + lane] + n] =
              static_cast<std::uint16_t>(((b - tile.first_batch) * 8 + n) * kLanes + place_of_lane(lane));
  return slots;
}

/// Per tile its nodes with the quads that they add up. Those inside tiles come tile by tile of themselves.
void ElementTiles::add_nodes(const ElementSet& elements, const NodeCorners& at) {
  const std::vector<std::uint16_t> slots = slots_of_corners(elements);
  std::vector<std::vector<std::pair<int, std::uint16_t>>> on_border(tiles_.size());  // node, slot
  const auto tile_of = [&](int i) { return at.corners[i] / 8 / tile_size_; };
  std::vector<int> ends(tiles_.size(), 0);
  int last_tile = 0;
  for (int node = 0; node < elements.node_count; ++node) {
    const int first = at.first[node], end = at.first[node + 1];
    assert(first < end && tile_of(first) >= last_tile);  // see NodeNumbering
    last_tile = tile_of(first);
    if (tile_of(first) == tile_of(end - 1)) {
      for (int i = first; i < end; ++i) inner_sums_.add(node, i == first, slots[at.corners[i]]);
      ends[last_tile] = static_cast<int>(inner_sums_.nodes.size());
    } else {
      for (int i = first; i < end; ++i) on_border[tile_of(i)].emplace_back(node, slots[at.corners[i]]);
    }
  }
  int inner = 0;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    Tile& tile = tiles_[t];
    tile.inner = inner;
    inner = tile.end_inner = std::max(inner, ends[t]);
    tile.border = static_cast<int>(border_sums_.nodes.size());
    int last = -1;
    for (const auto& [node, slot] : on_border[t]) {
      border_sums_.add(node, node != last, slot);
      last = node;
    }
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
