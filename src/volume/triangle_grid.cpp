#include "triangle_grid.h"

#include <algorithm>
#include <cmath>

namespace cfem_cutting {
namespace {

constexpr int kMaxCellsPerAxis = 256;

Box bounds_of(const TriangleMesh& mesh, const std::array<int, 3>& triangle) {
  Box bounds;
  for (const int vertex : triangle) bounds.extend(mesh.vertices[vertex]);
  return bounds;
}

/// About as many cells as the surface needs for a few triangles in each.
Lattice make_cells(const TriangleMesh& mesh, int axes) {
  Box bounds;
  for (const Vec3& vertex : mesh.vertices) bounds.extend(vertex);
  const Vec3 extent = bounds.sizes().cwiseMax(1e-12 + 1e-6 * bounds.sizes().maxCoeff());
  const double few = 4.0;
  const double cell =
      extent.maxCoeff() / std::max(1.0, std::sqrt(static_cast<double>(mesh.triangles.size()) / few));
  Lattice cells;
  cells.origin = bounds.min();
  for (int axis = 0; axis < 3; ++axis) {
    const double count =
        axis < axes ? std::clamp(std::ceil(extent[axis] / cell), 1.0, double{kMaxCellsPerAxis}) : 1.0;
    cells.size[axis] = static_cast<int>(count);
    cells.spacing[axis] = extent[axis] / count;
  }
  return cells;
}

}  // namespace

TriangleGrid::TriangleGrid(const TriangleMesh& mesh, int axes) : cells_(make_cells(mesh, axes)) {
  std::vector<std::pair<std::int64_t, int>> entries;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const Box bounds = bounds_of(mesh, mesh.triangles[t]);
    const Vec3i first = cell_at(bounds.min()), last = cell_at(bounds.max());
    for (int k = first.z(); k <= last.z(); ++k)
      for (int j = first.y(); j <= last.y(); ++j)
        for (int i = first.x(); i <= last.x(); ++i) entries.emplace_back(cells_.index({i, j, k}), t);
  }
  first_of_cell_.assign(cells_.count() + 1, 0);
  for (const auto& entry : entries) ++first_of_cell_[entry.first + 1];
  for (std::int64_t cell = 0; cell < cells_.count(); ++cell) first_of_cell_[cell + 1] += first_of_cell_[cell];
  triangles_.resize(entries.size());
  std::vector<int> next(first_of_cell_.begin(), first_of_cell_.end() - 1);
  for (const auto& [cell, triangle] : entries) triangles_[next[cell]++] = triangle;
}

Vec3i TriangleGrid::cell_at(const Vec3& p) const {
  const Vec3 position = (p - cells_.origin).cwiseQuotient(cells_.spacing);
  const Vec3 last = cells_.size.cast<double>().array() - 1.0;
  return position.array().floor().max(0.0).min(last.array()).cast<int>();
}

}  // namespace cfem_cutting
