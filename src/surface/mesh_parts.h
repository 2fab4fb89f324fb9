#pragma once

#include <array>
#include <vector>

namespace cfem_cutting {

/// A quad around a link: two triangles whose diagonal depends on the corners' places.
struct Quad {
  std::array<int, 4> corners;  ///< counter-clockwise about the link's axis
  int direction;               ///< of the link
  int first_triangle;          ///< the other is the next
  int twin = -1;               ///< the quad on the other side of a severed link, −1: none
};

/// What a surface's triangles belong to: quads, and beyond them single triangles of fans.
class MeshParts {
 public:
  struct Triangles {
    int first, end;
  };

  void clear();
  void reserve(std::size_t quads) { quads_.reserve(quads); }
  int add(const Quad& quad);
  void add_fan_triangle(int triangle) { fan_triangles_.push_back(triangle); }
  void pair_up(int a, int b);

  /// Finds the parts of each vertex; when all have been added.
  void sort_by_vertex(int vertices, const std::vector<std::array<int, 3>>& triangles);

  int size() const { return static_cast<int>(quads_.size() + fan_triangles_.size()); }
  int quad_count() const { return static_cast<int>(quads_.size()); }
  bool is_quad(int part) const { return part < quad_count(); }
  const Quad& quad(int part) const { return quads_[part]; }
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
  std::vector<Quad> quads_;
  std::vector<int> fan_triangles_;
  std::vector<int> first_part_;  // (|vertices| + 1) into parts_
  std::vector<int> parts_;       // ascending for each vertex
};

}  // namespace cfem_cutting
