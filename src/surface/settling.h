#pragma once

#include "mesher.h"

namespace cfem_cutting {

using NearestOnCut = SurfaceExtractor::NearestOnCut;

/// Puts vertices at cuts, but ends on the trace inside the tissue, on the cut, and there on the skin as far
/// as they can be. Cells with other cuts are left alone, as vertices might pass each other.
void settle_on_cut(Contour& contour, const NearestOnCut& nearest);

/// Puts the midpoints of arcs from severed links on the cut, and there on the skin, as far as their faces
/// allow. Cells with other cuts are left alone.
void settle_midpoints(const Contour& contour, Mesher& mesher, const NearestOnCut& nearest);

/// Draws a virtual intersection point back, for the present trace only: one on the trace into its cell;
/// others half of the way there the first time, into the cell the second time, both on the cut as far as that
/// goes, and to the error function's minimum the third time.
/// @return false: it is back already
bool draw_back(Contour& contour, int cell, int group, const NearestOnCut& nearest);

}  // namespace cfem_cutting
