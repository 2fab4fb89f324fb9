#pragma once

#include <array>
#include <vector>

#include "rest_matrix.h"

namespace cfem_cutting {

using ElementNodes = std::array<int, 8>;

/// Hexahedra on a block lattice, along Morton's curve, each with its nodes and its stiffness: a level of the
/// multigrid hierarchy.
struct ElementSet {
  std::vector<Vec3i> block;
  std::vector<ElementNodes> nodes;       ///< see NodeNumbering
  std::vector<MatrixPointer> stiffness;  ///< N/m; equal ones are one object
  int node_count = 0;
  int size() const { return static_cast<int>(nodes.size()); }
  double trace() const;  ///< N/m, of all stiffnesses
};

/// For each node the elements that meet there, as 8 e + corner, ascending.
struct NodeCorners {
  explicit NodeCorners(const ElementSet& set);
  std::vector<int> first;  ///< (|nodes| + 1) into `corners`
  std::vector<int> corners;
};

}  // namespace cfem_cutting
