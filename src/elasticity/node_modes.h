#pragma once

#include "cfem_cutting/elasticity/elastic_model.h"

namespace cfem_cutting {

/// H K H / 64 with Walsh's transform H over an element's nodes, H_sn = (−1)^|s & n| per axis: a matrix over
/// modes s. Then K = H (H K H / 64) H. Mode 0 is the translation; modes 1, 2 and 4 are linear along one axis.
ElementMatrix to_modes(const ElementMatrix& K);

}  // namespace cfem_cutting
