#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include "cfem_cutting/volume/voxel_volume.h"

namespace cfem_cutting {

/// A quad around a link: two triangles whose diagonal depends on the corners' places.
struct LinkQuad {
  std::array<int, 4> corners;  ///< counter-clockwise about the link's axis
  int side;                    ///< the link's, see LinkSide
  int first_triangle;          ///< the other is the next
  int twin = -1;               ///< the quad on the other side of a severed link, −1: none
  int direction() const { return side % kDirections; }
};

/// What a surface's triangles belong to: quads, and beyond them single triangles of fans.
class MeshParts {
 public:
  struct Triangles {
    int first, end;
  };

  void clear();
  void reserve(std::size_t quads) { quads_.reserve(quads); }
  int add(const LinkQuad& quad);
  void add_fan_triangle(int triangle) { fan_triangles_.push_back(triangle); }

  /// Finds the quads on the two sides of links; when all have been added.
  /// @param across gives the side at a severed link's other end, −1 for other links
  template <typename Across>
  void pair_up(const Across& across) {
    std::unordered_map<int, int> quad_of_side;
    for (int q = 0; q < quad_count(); ++q) {
      const int other = across(quads_[q].side);
      if (other < 0) continue;
      quad_of_side[quads_[q].side] = q;
      const auto twin = quad_of_side.find(other);
      if (twin == quad_of_side.end()) continue;
      quads_[q].twin = twin->second;
      quads_[twin->second].twin = q;
    }
  }

  /// Finds the parts of each vertex; when all have been added.
  void sort_by_vertex(int vertices, const std::vector<std::array<int, 3>>& triangles);

  int size() const { return static_cast<int>(quads_.size() + fan_triangles_.size()); }
  int quad_count() const { return static_cast<int>(quads_.size()); }
  bool is_quad(int part) const { return part < quad_count(); }
  const LinkQuad& quad(int part) const { return quads_[part]; }
  Triangles triangles(int part) const;

  struct Range {
    const int *first, *last;
    const int* begin() const { return first; }
    const int* end() const { return last; }
  };
  Range at(int vertex) const {
    return {parts_.data() + first_part_[vertex], parts_.data() + first_part_[vertex + 1]};
  }

 private:
  std::vector<LinkQuad> quads_;
  std::vector<int> fan_triangles_;
  std::vector<int> first_part_;  // (|vertices| + 1) into parts_
  std::vector<int> parts_;       // ascending for each vertex
};

}  // namespace cfem_cutting
