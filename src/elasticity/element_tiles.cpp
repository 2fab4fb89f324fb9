#include "element_tiles.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace cfem_cutting {
namespace {

constexpr int kFewestShared = kLanes / 2;  // elements that make a batch with one matrix worthwhile

/// Elements by matrix, in the order of first occurrence.
std::vector<std::vector<int>> group_by_matrix(const ElementSet& elements, const std::vector<int>& among) {
  std::vector<std::vector<int>> groups;
  std::unordered_map<const ElementMatrix*, std::size_t> group_of_matrix;
  for (int e : among) {
    const auto [it, added] = group_of_matrix.try_emplace(elements.stiffness[e].get(), groups.size());
    if (added) groups.emplace_back();
    groups[it->second].push_back(e);
  }
  return groups;
}

/// Place on Morton's curve (Morton 1966) through blocks, which keeps neighbours together.
std::uint64_t morton_place(const Vec3i& block) {
  std::uint64_t place = 0;
  for (int bit = 0; bit < 20; ++bit)
    for (int axis = 0; axis < 3; ++axis)
      place |= static_cast<std::uint64_t>(block[axis] >> bit & 1) << (3 * bit + axis);
  return place;
}

std::vector<int> sort_along_curve(const ElementSet& elements) {
  Vec3i lowest = Vec3i::Zero();
  for (const Vec3i& block : elements.block) lowest = lowest.cwiseMin(block);
  std::vector<std::uint64_t> place;
  for (const Vec3i& block : elements.block) place.push_back(morton_place(block - lowest));
  std::vector<int> order(elements.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return place[a] < place[b]; });
  return order;
}

}  // namespace

ElementTiles::ElementTiles(const ElementSet& elements) {
  const std::vector<int> order = sort_along_curve(elements);
  std::vector<int> tile_of_element(elements.size());
  for (std::size_t begin = 0; begin < order.size(); begin += kTile) {
    const std::size_t end = std::min(order.size(), begin + kTile);
    for (std::size_t i = begin; i < end; ++i) tile_of_element[order[i]] = static_cast<int>(begin / kTile);
    add_tile(elements, {order.begin() + begin, order.begin() + end});
  }
  const NodeCorners at(elements);
  for (int node = 0; node < elements.node_count; ++node)
    first_element.push_back(at.corners[at.first[node]] / 8);
  add_nodes(elements, at, tile_of_element);
  add_borders(elements.node_count);
}

void ElementTiles::add_batches(const std::vector<int>& elements, bool shared) {
  for (std::size_t first = 0; first < elements.size(); first += kLanes) {
    const auto count = std::min<std::size_t>(kLanes, elements.size() - first);
    batches.push_back({static_cast<int>(element_of_lane.size()), static_cast<int>(count), shared});
    element_of_lane.insert(element_of_lane.end(), elements.begin() + first, elements.begin() + first + count);
  }
}

void ElementTiles::add_tile(const ElementSet& elements, const std::vector<int>& of_tile) {
  const int first = size();
  std::vector<int> others;
  for (const std::vector<int>& group : group_by_matrix(elements, of_tile)) {
    if (static_cast<int>(group.size()) >= kFewestShared) {
      add_batches(group, true);
    } else {
      others.insert(others.end(), group.begin(), group.end());
    }
  }
  add_batches(others, false);
  tiles_.push_back({first, size(), 0, 0, 0});
  nodes.resize(batches.size() * 8 * kLanes, 0);
  for (int b = first; b < size(); ++b)
    for (int lane = 0; lane < batches[b].count; ++lane)
      for (int n = 0; n < 8; ++n)
        nodes[(b * 8 + n) * kLanes + lane] = elements.nodes[element_of_lane[batches[b].first + lane]][n];
}

/// Per tile its nodes, those of other tiles too last, with the quads that they add up.
void ElementTiles::add_nodes(const ElementSet& elements, const NodeCorners& at,
                             const std::vector<int>& tile_of_element) {
  std::vector<int> slot_of_corner(8 * static_cast<std::size_t>(elements.size()));
  std::vector<std::vector<int>> inner(tiles_.size()), shared(tiles_.size());
  for (std::size_t t = 0; t < tiles_.size(); ++t)
    for (int b = tiles_[t].first_batch; b < tiles_[t].end_batch; ++b)
      for (int lane = 0; lane < batches[b].count; ++lane)
        for (int n = 0; n < 8; ++n)
          slot_of_corner[8 * element_of_lane[batches[b].first + lane] + n] =
              ((b - tiles_[t].first_batch) * 8 + n) * kLanes + place_of_lane(lane);
  const auto tile_of = [&](int corner) { return tile_of_element[corner / 8]; };
  for (int node = 0; node < elements.node_count; ++node) {
    std::vector<int> tiles;
    for (int i = at.first[node]; i < at.first[node + 1]; ++i) tiles.push_back(tile_of(at.corners[i]));
    std::sort(tiles.begin(), tiles.end());
    tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
    for (int t : tiles) (tiles.size() == 1 ? inner : shared)[t].push_back(node);
  }
  first_slot_.assign(1, 0);
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    tiles_[t].first_node = static_cast<int>(node_.size());
    tiles_[t].first_border = tiles_[t].first_node + static_cast<int>(inner[t].size());
    node_.insert(node_.end(), inner[t].begin(), inner[t].end());
    node_.insert(node_.end(), shared[t].begin(), shared[t].end());
    tiles_[t].end_node = static_cast<int>(node_.size());
    for (int k = tiles_[t].first_node; k < tiles_[t].end_node; ++k) {
      for (int i = at.first[node_[k]]; i < at.first[node_[k] + 1]; ++i)
        if (tile_of(at.corners[i]) == static_cast<int>(t))
          slots_.push_back(static_cast<std::uint16_t>(slot_of_corner[at.corners[i]]));
      first_slot_.push_back(static_cast<int>(slots_.size()));
    }
  }
}

/// Numbers the entries of the border, and gathers them by node.
void ElementTiles::add_borders(int node_count) {
  std::vector<std::vector<int>> entries(node_count);
  for (const Tile& tile : tiles_) {
    for (int i = tile.first_border; i < tile.end_node; ++i) {
      entries[node_[i]].push_back(border_count_);
      node_[i] = border_count_++;
    }
  }
  first_entry_.assign(1, 0);
  for (int node = 0; node < node_count; ++node) {
    if (entries[node].empty()) continue;
    border_node_.push_back(node);
    border_entry_.insert(border_entry_.end(), entries[node].begin(), entries[node].end());
    first_entry_.push_back(static_cast<int>(border_entry_.size()));
  }
}

}  // namespace cfem_cutting
