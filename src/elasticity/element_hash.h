#pragma once

#include <vector>

#include "cfem_cutting/elasticity/composite_mesh.h"

namespace cfem_cutting {

/// A grid over the bounds of deformed elements. (Each trilinear element lies in the bounds of its nodes.)
class ElementHash {
 public:
  /// @param elements those to be found
  ElementHash(const CompositeMesh& mesh, const NodeField& x, const std::vector<int>& elements);

  /// Calls visit(element) for the elements whose bounds contain x, in ascending order, until it returns true.
  template <typename Visit>
  bool visit_at(const Vec3& x, const Visit& visit) const {
    if (!bounds_.contains(x)) return false;
    const int cell = cell_index(cell_of(x));
    for (int i = first_[cell]; i < first_[cell + 1]; ++i)
      if (boxes_[elements_[i]].contains(x) && visit(elements_[i])) return true;
    return false;
  }

  /// Elements whose bounds are at most `reach` (m) from x, nearest first; distance and element.
  std::vector<std::pair<double, int>> near(const Vec3& x, double reach) const;

 private:
  Vec3i cell_of(const Vec3& x) const;
  int cell_index(const Vec3i& cell) const { return cell.x() + size_.x() * (cell.y() + size_.y() * cell.z()); }
  void choose_cells(std::size_t count, const Vec3& mean_size);
  template <typename Visit>
  void for_each_cell(const Box& box, const Visit& visit) const;

  Box bounds_;
  std::vector<Box> boxes_;  // per element; empty for those not to be found
  Vec3 cell_ = Vec3::Ones();
  Vec3i size_ = Vec3i::Ones();
  std::vector<int> first_;  // (|cells| + 1) into elements_
  std::vector<int> elements_;
};

}  // namespace cfem_cutting
