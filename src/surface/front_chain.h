#pragma once

#include <algorithm>
#include <set>

#include "contour.h"

namespace cfem_cutting {

/// A group of sheets that the front holds.
struct ChainLink {
  int cell;          ///< in Contour::cells()
  int group;         ///< in DualCell::groups
  Vec3 X;            ///< m, its place on the trace
  EdgeEnd edge_end;  ///< it lies on this end of the edge
  bool continues;    ///< an edge or a diagonal of the surface joins it to the link before
};

/// A diagonal of a quad, between two groups (cell, group) of which the smaller one is first.
using Diagonal = std::pair<std::pair<int, int>, std::pair<int, int>>;
inline Diagonal diagonal_between(std::pair<int, int> a, std::pair<int, int> b) { return std::minmax(a, b); }

/// The chain of vertices that runs along a trace: through the cells that the trace passes, in order, each
/// vertex moved the shortest way, the first and the last to the trace's ends. Where the surface does not join
/// two cells' vertices, the chain takes the way over a neighbouring cell; cells that the trace only touches
/// are left out where the diagonal of a quad leads on (they would give needles). Found as the shortest path
/// in the graph of vertices near the trace, ascending along it.
/// @param avoided diagonals that chains don't take, as triangles beside them would be turned
std::vector<ChainLink> find_chain(const Contour& contour, const Trace& trace,
                                  const std::set<Diagonal>& avoided = {});

}  // namespace cfem_cutting
