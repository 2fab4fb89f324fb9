#pragma once

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

/// The chain of vertices that runs along a trace: through the cells that the trace passes, in order, each
/// vertex moved the shortest way, the first and the last to the trace's ends. Where the surface does not join
/// two cells' vertices, the chain takes the way over a neighbouring cell; cells that the trace only touches
/// are left out where the diagonal of a quad leads on (they would give needles). Found as the shortest path
/// in the graph of vertices near the trace, ascending along it.
std::vector<ChainLink> find_chain(const Contour& contour, const Trace& trace);

}  // namespace cfem_cutting
