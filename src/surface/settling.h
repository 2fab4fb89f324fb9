#pragma once

#include "mesher.h"

namespace cfem_cutting {

using NearestOnCut = SurfaceExtractor::NearestOnCut;

/// Puts vertices at cuts, but ends on the trace inside the tissue, on the cut, and there on the skin as far
/// as they can be. Cells with other cuts are left alone, as vertices might pass each other.
void settle_on_cut(Contour& contour, const NearestOnCut& nearest);

/// Puts the vertices halfway between severed links in cells' faces on the cut, and there on the skin, as far
/// as their faces allow.
void settle_midpoints(const Contour& contour, Mesher& mesher, const NearestOnCut& nearest);

/// Draws a virtual intersection point back into its cell: one that is not on the trace stays on the cut as
/// far as the cell allows, and goes to the error function's minimum the second time. For the present trace
/// only.
/// @return whether it moved
bool draw_back(Contour& contour, int cell, int group, const NearestOnCut& nearest);

}  // namespace cfem_cutting
