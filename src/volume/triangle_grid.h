#pragma once

#include "cfem_cutting/geometry/triangle_mesh.h"
#include "cfem_cutting/volume/lattice.h"

namespace cfem_cutting {

/// Triangles by the cells of a regular grid that their bounds touch.
class TriangleGrid {
 public:
  /// @param axes 2: cells are columns parallel to z; 3: cells are cubes
  TriangleGrid(const TriangleMesh& mesh, int axes);

  /// Calls use(triangle) for the triangles of all cells that the box touches; for some more than once.
  template <typename Use>
  void visit(const Box& box, Use use) const {
    const Vec3i first = cell_at(box.min()), last = cell_at(box.max());
    for (int k = first.z(); k <= last.z(); ++k)
      for (int j = first.y(); j <= last.y(); ++j)
        for (int i = first.x(); i <= last.x(); ++i)
          for (int n = first_of_cell_[cells_.index({i, j, k})];
               n < first_of_cell_[cells_.index({i, j, k}) + 1]; ++n)
            use(triangles_[n]);
  }

 private:
  /// Points beyond the grid belong to its outermost cells.
  Vec3i cell_at(const Vec3& p) const;

  Lattice cells_;
  std::vector<int> first_of_cell_;  // cell → triangles_, one more than cells
  std::vector<int> triangles_;
};

}  // namespace cfem_cutting
