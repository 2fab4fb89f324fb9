#pragma once

#include <vector>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// Draws the neighbourhood of a cut's end along with it. Where the deformation takes the end off the edge
/// that holds it (in the steps after a fracture, while the tissue still springs back), its vertices alone
/// would be put on the edge, and the cut's faces beside them would fold over it. The field is the vertices'
/// own way at their places, smooth in material space, and zero from a distance on.
class EdgePull {
 public:
  /// @param reach m, where the field ends
  explicit EdgePull(double reach) : reach_(reach) {}

  /// @param X m, material place of a vertex
  /// @param way m, from where the deformation takes it to the edge
  void add(const Vec3& X, const Vec3& way);

  /// m, how far a material point is drawn along.
  Vec3 at(const Vec3& X) const;

 private:
  struct Held {
    Vec3 X, way;
  };

  double reach_;
  std::vector<Held> held_;
  Box box_;  // around all that the field reaches
};

}  // namespace cfem_cutting
