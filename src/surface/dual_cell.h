#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cfem_cutting/surface/tissue_surface.h"
#include "cfem_cutting/volume/voxel_volume.h"

namespace cfem_cutting {

/// A link seen from one of its ends in a dual cell: 3·corner + axis. Corner a + 2(b + 2c) of a cell is the
/// voxel cell + (a, b, c). Only severed and surface links with tissue at the corner have sides.
using LocalSide = int;
constexpr int kLocalSides = 24;
using SideMask = std::uint32_t;  ///< bit n: local side n

/// The direction (see `step`) in which a link leaves a corner along an axis.
constexpr int direction_from(int corner, int axis) { return 2 * axis + 1 - (corner >> axis & 1); }

/// The same link's side at its other end.
constexpr LocalSide across(LocalSide side) { return 3 * (side / 3 ^ (1 << side % 3)) + side % 3; }

/// Where the vertices of a dual cell may lie: a little off its faces, so that all corners of the quad around
/// a link stand in their own quarters, and one of its diagonals makes two positive triangles.
Box room_in_cell(const Lattice& lattice, const Vec3i& index);

/// A piece of surface in a dual cell: a closed cycle of link sides. It gets one vertex.
struct Sheet {
  SideMask sides = 0;
  int voxel = -1;  ///< the lowest linked one at its sides
  int group = -1;  ///< in DualCell::groups
};

/// Sheets that face each other across severed links and hence share one position.
struct SheetGroup {
  SideMask sides = 0;
  bool skin = false;     ///< holds a surface link
  bool severed = false;  ///< holds a severed link
  int chain = -1;        ///< number in the chain along the front; neighbours have consecutive ones
  EdgeEnd edge_end = EdgeEnd::kNone;
  bool cut_end = false;            ///< both sides of a severed link are in one sheet: the cut ends here
  Vec3 minimum = Vec3::Zero();     ///< m, of the error function
  std::optional<Vec3> frozen;      ///< m, a virtual point that stays: of a former trace, or on the cut
  bool settled = false;            ///< it was put on what the blade has cut
  std::optional<Vec3> adapted;     ///< m, the virtual intersection point on the present trace
  std::optional<Vec3> drawn_back;  ///< m, where it is instead as long as a triangle would be turned
  int times_drawn_back = 0;
  const Vec3& X() const { return drawn_back ? *drawn_back : adapted ? *adapted : frozen ? *frozen : minimum; }
};

/// The cube between eight voxel centres and the surface's sheets in it.
struct DualCell {
  Vec3i index;
  std::array<int, 8> voxel{};  ///< linked voxels at the corners, −1 for none
  SideMask sides = 0;
  std::array<int, kLocalSides> sheet_of_side{};
  std::vector<Sheet> sheets;
  std::vector<SheetGroup> groups;

  bool has_side(LocalSide side) const { return sides >> side & 1; }
  bool intact(int corner, int axis) const { return voxel[corner] >= 0 && !has_side(3 * corner + axis); }

  /// The side at the other end of the arc that starts at `side` in the cell's face square to `normal_axis`:
  /// along the face's boundary over intact links as far as they go.
  LocalSide arc_end(LocalSide side, int normal_axis) const;
};

/// Whether all tissue that a group bounds is parted from a voxel. (What is too far to tell is not.)
bool is_other_tissue(const VoxelVolume& volume, const DualCell& cell, int group, int voxel);

/// A point moved onto the skin's planes of a group, if it has skin.
Vec3 onto_skin(const Vec3& X, const VoxelVolume& volume, const DualCell& cell, const SheetGroup& group);

/// Sheets, groups and the minima of their error functions.
DualCell contour_cell(const VoxelVolume& volume, const Vec3i& index);

}  // namespace cfem_cutting
