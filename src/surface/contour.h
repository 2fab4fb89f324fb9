#pragma once

#include <unordered_map>

#include "dual_cell.h"

namespace cfem_cutting {

/// A link side in the volume: kDirections·voxel + direction.
using LinkSide = int;

/// All dual cells that hold surface, kept up to date with the severed links.
class Contour {
 public:
  explicit Contour(const VoxelVolume& volume) : volume_(volume) {}

  /// Contours the cells around links severed since the last call; first, all.
  /// @return whether anything changed
  bool update();

  const VoxelVolume& volume() const { return volume_; }
  const std::vector<LinkSide>& sides() const { return sides_; }  ///< ascending
  std::vector<DualCell>& cells() { return cells_; }
  const std::vector<DualCell>& cells() const { return cells_; }

  /// @return a position in cells(), −1 for a cell without surface
  int find(const Vec3i& index) const;

  /// The four cells around a link, counter-clockwise about its axis' positive direction.
  std::array<Vec3i, 4> cells_around(int voxel, int direction) const;

 private:
  void contour_all();
  void contour_around(const std::vector<LinkId>& links);
  void contour(const Vec3i& index);
  std::int64_t key(const Vec3i& index) const;

  const VoxelVolume& volume_;
  bool contoured_ = false;
  std::vector<LinkId> severed_;
  std::vector<LinkSide> sides_;
  std::vector<DualCell> cells_;
  std::unordered_map<std::int64_t, int> cell_at_;
};

}  // namespace cfem_cutting
