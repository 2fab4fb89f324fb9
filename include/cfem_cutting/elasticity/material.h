#pragma once

#include <vector>

namespace cfem_cutting {

/// Isotropic linear elastic tissue.
struct Material {
  int label = -1;                ///< of the volume; −1: any
  double young_modulus = 1.0e4;  ///< Pa
  double poisson_ratio = 0.45;   ///< [0, 0.5)
  double density = 1060.0;       ///< kg/m³
};

/// The first material that matches a label.
/// @return its index, −1 if none matches
int match_material(const std::vector<Material>& materials, int label);

}  // namespace cfem_cutting
