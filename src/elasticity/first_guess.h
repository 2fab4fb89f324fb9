#pragma once

#include <vector>

#include "linear_system.h"

namespace cfem_cutting {

/// What changed the velocities in the last steps, in single precision: directions along which the next step's
/// solution is likely to differ from the last one's.
std::vector<SingleField> recent_changes(const ElasticState& state, ThreadPool& pool);

/// Moves x by the combination of directions that minimises the energy ½ x·A x − b·x (Fischer 1998,
/// "Projection techniques for iterative solution of Ax = b with successive right-hand sides").
/// @param r b − A x before and after
void minimise_over(const LinearSystem& system, std::vector<SingleField> directions, SingleField& r,
                   SingleField& x);

}  // namespace cfem_cutting
