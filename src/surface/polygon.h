#pragma once

#include "contour.h"

namespace cfem_cutting {

/// What the surface has around a link, seen from one of its ends: a polygon through the vertices of four
/// cells, in the order of Contour::cells_around.
struct Polygon {
  int voxel, direction;
  std::array<int, 4> cell;  ///< in Contour::cells()
  std::array<LocalSide, 4> side;
  std::array<int, 4> sheet;
  std::array<bool, 4> midpoint;  ///< corner i and the next are joined over a vertex of their own
  bool lone;                     ///< no severed neighbour: its sheets hold only its two sides, it isn't drawn
  bool severed;                  ///< the link
  bool fan;                      ///< around a vertex of its own on the link; else two triangles

  int group(const Contour& contour, int i) const { return contour.cells()[cell[i]].sheets[sheet[i]].group; }
};

Polygon polygon_of(const Contour& contour, LinkSide side);

/// The axis square to the face between the i-th and the next of the cells around a link.
inline int face_axis(int direction, int i) { return (direction / 2 + 1 + i % 2) % 3; }

}  // namespace cfem_cutting
