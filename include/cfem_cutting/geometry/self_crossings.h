#pragma once

#include "cfem_cutting/geometry/triangle_mesh.h"

namespace cfem_cutting {

/// Triangles that meet others in more than a common corner or edge, by exact predicates. Corners at one place
/// are one, and two triangles with the same corners, such as the faces of a closed cut, count as one.
int count_self_crossings(const TriangleMesh& mesh);

}  // namespace cfem_cutting
