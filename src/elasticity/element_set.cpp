#include "element_set.h"

namespace cfem_cutting {

double ElementSet::trace() const {
  double sum = 0.0;
  for (const MatrixPointer& K : stiffness) sum += K->trace;
  return sum;
}

NodeCorners::NodeCorners(const ElementSet& set)
    : first(set.node_count + 1, 0), corners(8 * set.nodes.size()) {
  for (const ElementNodes& nodes : set.nodes)
    for (int node : nodes) ++first[node + 1];
  for (int node = 0; node < set.node_count; ++node) first[node + 1] += first[node];
  std::vector<int> next(first.begin(), first.end() - 1);
  for (int e = 0; e < set.size(); ++e)
    for (int n = 0; n < 8; ++n) corners[next[set.nodes[e][n]]++] = 8 * e + n;
}

}  // namespace cfem_cutting
