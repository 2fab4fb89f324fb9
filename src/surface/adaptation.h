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
/// far as the cell allows.
/// @param wholly one that is not on the trace goes back to the error function's minimum
void retract(Contour& contour, int cell, int group, const SurfaceExtractor::NearestOnCut& nearest,
             bool wholly);

/// Puts vertices at cuts, but ends on the trace, on the cut, and there on the skin as far as they can be.
/// Cells with other cuts are left alone, as vertices might pass each other.
void settle_on_cut(Contour& contour, const SurfaceExtractor::NearestOnCut& nearest);

/// Keeps the virtual intersection points at cuts.
void freeze_cut_ends(Contour& contour);

}  // namespace cfem_cutting
