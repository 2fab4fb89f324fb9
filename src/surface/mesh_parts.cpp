#include "mesh_parts.h"

#include <numeric>

namespace cfem_cutting {

void MeshParts::clear() {
  quads_.clear();
  fan_triangles_.clear();
}

int MeshParts::add(const LinkQuad& quad) {
  quads_.push_back(quad);
  return quad_count() - 1;
}

MeshParts::Triangles MeshParts::triangles(int part) const {
  if (is_quad(part)) return {quads_[part].first_triangle, quads_[part].first_triangle + 2};
  const int triangle = fan_triangles_[part - quad_count()];
  return {triangle, triangle + 1};
}

void MeshParts::sort_by_vertex(int vertices, const std::vector<std::array<int, 3>>& triangles) {
  const auto for_corners = [&](const auto& work) {
    int part = 0;
    for (const LinkQuad& quad : quads_) {
      for (const int v : quad.corners) work(v, part);
      ++part;
    }
    for (const int t : fan_triangles_) {
      for (const int v : triangles[t]) work(v, part);
      ++part;
    }
  };
  first_part_.assign(vertices + 1, 0);
  for_corners([&](int v, int) { ++first_part_[v + 1]; });
  std::partial_sum(first_part_.begin(), first_part_.end(), first_part_.begin());
  parts_.resize(first_part_.back());
  std::vector<int> next(first_part_.begin(), first_part_.end() - 1);
  for_corners([&](int v, int part) { parts_[next[v]++] = part; });
}

}  // namespace cfem_cutting
