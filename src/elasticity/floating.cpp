#include "cfem_cutting/elasticity/floating.h"

#include "union_find.h"

namespace cfem_cutting {

std::vector<char> floating_nodes(const CompositeMesh& mesh, const std::vector<int>& holding) {
  UnionFind bodies(mesh.node_count());
  for (const CompositeElement& element : mesh.elements())
    for (int node : element.nodes) bodies.unite(element.nodes[0], node);
  std::vector<char> held(mesh.node_count(), 0), floating(mesh.node_count());
  for (int node : holding) held[bodies.find(node)] = 1;
  for (int node = 0; node < mesh.node_count(); ++node) floating[node] = !held[bodies.find(node)];
  return floating;
}

}  // namespace cfem_cutting
