#pragma once

#include "cfem_cutting/surface/tissue_surface.h"
#include "mesh_parts.h"

namespace cfem_cutting {

/// Shape of a triangle, positive if it is counter-clockwise about an axis: twice its area over its longest
/// edge squared; else its projected area, m².
double shape_about_axis(const Vec3& a, const Vec3& b, const Vec3& c, int axis);

/// The diagonals of quads. Both triangles must be positive about the link. Among such, the diagonal of a
/// chain of vertices on the front that leaves out a corner; else, at a cut's rim, the one whose triangles,
/// with those on the cut's other side, go through less of the skin; else the better shaped triangles.
class Diagonals {
 public:
  /// @param chain per vertex: SheetGroup::chain
  Diagonals(const TissueSurface& surface, const MeshParts& parts, const std::vector<int>& chain)
      : surface_(surface), parts_(parts), chain_(chain) {}

  /// Whether it is that from corner 1 rather than from corner 0. That of a cut depends on the skin's
  /// triangles beside it and its twin.
  bool prefers_second(const LinkQuad& quad) const;

  /// Whether the chain would take the one from corner i, but the triangles would not be positive.
  bool chain_misses(const LinkQuad& quad, int i) const;

 private:
  double worse_shape(const LinkQuad& quad, int i) const;
  bool is_on_chain(const LinkQuad& quad, int i) const;
  int meetings_with_skin(const LinkQuad& quad, int i) const;
  int meetings_with_skin(const std::array<int, 3>& triangle) const;
  bool meet(const std::array<int, 3>& t, const std::array<int, 3>& u) const;
  bool goes_through(int from, int to, const std::array<int, 3>& triangle) const;
  const Vec3& X(int vertex) const { return surface_.vertices[vertex].X; }

  const TissueSurface& surface_;
  const MeshParts& parts_;
  const std::vector<int>& chain_;
};

}  // namespace cfem_cutting
