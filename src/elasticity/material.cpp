#include "cfem_cutting/elasticity/material.h"

namespace cfem_cutting {

int match_material(const std::vector<Material>& materials, int label) {
  for (std::size_t m = 0; m < materials.size(); ++m)
    if (materials[m].label == -1 || materials[m].label == label) return static_cast<int>(m);
  return -1;
}

}  // namespace cfem_cutting
