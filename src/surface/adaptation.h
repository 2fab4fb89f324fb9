#pragma once

#include "cfem_cutting/surface/tissue_surface.h"
#include "contour.h"

namespace cfem_cutting {

/// Influence domain adaptation: virtual intersection points on the trace, in place of the former ones.
void adapt(Contour& contour, const FrontTrace& trace);

/// Whether a cell holds something that the trace can place: skin or a cut's end.
bool holds_crease(const DualCell& cell);

/// Keeps the virtual intersection points at cuts.
void freeze_cut_ends(Contour& contour);

}  // namespace cfem_cutting
