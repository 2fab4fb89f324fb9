#pragma once

#include <vector>

#include "cfem_cutting/geometry/types.h"
#include "cfem_cutting/volume/lattice.h"

namespace cfem_cutting {

/// The part of a polyline in one dual cell.
struct FrontPiece {
  Vec3i cell;
  Polyline points;      ///< m, two or more, or the polyline's only one
  double length = 0.0;  ///< m
  bool first = false;   ///< the polyline begins here
  bool last = false;    ///< the polyline ends here
};

/// The dual cell that holds a point; on a boundary, the one of larger index.
Vec3i dual_cell_at(const Lattice& lattice, const Vec3& X);

/// The dual cells that a polyline of one or more points runs through, in order; consecutive ones differ. A
/// polyline on a boundary between cells is in the one of larger index.
std::vector<FrontPiece> walk_dual_cells(const Lattice& lattice, const Polyline& polyline);

/// The cell of a piece, and those beyond faces along which it runs, to a twentieth of a cell: a cut along a
/// plane through voxels' centres may be in the links on either side.
std::vector<Vec3i> cells_along(const Lattice& lattice, const FrontPiece& piece);

/// The point of a piece nearest to a query. It keeps a part of the piece's length off ends at which the
/// polyline goes on, so that vertices of neighbouring cells don't meet, and in the room that a cell's
/// vertices have: beside the piece only if it runs outside.
Vec3 project_within(const FrontPiece& piece, const Vec3& query, const Box& room);

}  // namespace cfem_cutting
