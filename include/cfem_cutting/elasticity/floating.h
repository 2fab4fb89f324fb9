#pragma once

#include <vector>

#include "cfem_cutting/elasticity/composite_mesh.h"

namespace cfem_cutting {

/// Per node whether it belongs to a body that none of the given nodes holds.
std::vector<char> floating_nodes(const CompositeMesh& mesh, const std::vector<int>& holding);

}  // namespace cfem_cutting
