#pragma once
/// The one table of all keys: default, unit, rule, documentation, and where the value goes.

#include "field.h"

namespace cfem_cutting {

Fields<TissueConfig> tissue_fields();
Fields<BladeConfig> blade_fields();
Fields<FractureOptions> fracture_fields();
Fields<SurfaceConfig> surface_fields();
Fields<DynamicsConfig> solver_fields();
Fields<NodeConfig> node_fields();

/// All of them by section.
const Fields<Config>& config_fields();

}  // namespace cfem_cutting
