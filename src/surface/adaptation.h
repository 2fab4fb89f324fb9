#pragma once

#include "cfem_cutting/surface/tissue_surface.h"
#include "contour.h"
#include "front_chain.h"

namespace cfem_cutting {

/// Influence domain adaptation: virtual intersection points on the trace, in place of the former ones.
/// @param moves false: only marks the groups on the front
/// @param avoided see find_chain
/// @param cells positions in Contour::cells() of the former ones; the new ones are added
void adapt(Contour& contour, const FrontTrace& trace, bool moves, const std::set<Diagonal>& avoided,
           std::vector<int>& cells);

/// Whether the present trace has to do with a cell: its vertices are on it, or drawn back for it.
bool follows_trace(const DualCell& cell);

/// Keeps the virtual intersection points of sheets in which a cut ends.
/// @param at_skin false: only inside the tissue (at the skin `settle_on_cut` finds better ones)
void freeze_cut_ends(Contour& contour, bool at_skin);

}  // namespace cfem_cutting
