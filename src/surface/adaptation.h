#pragma once

#include "cfem_cutting/surface/tissue_surface.h"
#include "contour.h"
#include "front_chain.h"

namespace cfem_cutting {

/// Influence domain adaptation: virtual intersection points on the trace, in place of the former ones.
/// @param moves false: only marks the groups on the front
/// @param avoided see find_chain
void adapt(Contour& contour, const FrontTrace& trace, bool moves, const std::set<Diagonal>& avoided);

/// Draws a virtual intersection point back into its cell: one that is not on the trace stays on the cut as
/// far as the cell allows, and goes to the error function's minimum the second time. For the present trace
/// only.
/// @return whether it moved
bool draw_back(Contour& contour, int cell, int group, const SurfaceExtractor::NearestOnCut& nearest);

/// Puts vertices at cuts, but ends on the trace inside the tissue, on the cut, and there on the skin as far
/// as they can be. Cells with other cuts are left alone, as vertices might pass each other.
void settle_on_cut(Contour& contour, const SurfaceExtractor::NearestOnCut& nearest);

/// Keeps the virtual intersection points of sheets in which a cut ends.
/// @param at_skin false: only inside the tissue (at the skin `settle_on_cut` finds better ones)
void freeze_cut_ends(Contour& contour, bool at_skin);

}  // namespace cfem_cutting
