#pragma once

#include "linear_system.h"

namespace cfem_cutting {

/// Solves A dx = b by conjugate gradients in single precision, preconditioned by the multigrid
/// cycle, inside iterative refinement; held nodes keep their dx.
/// @param dx initial guess, and the solution
/// @param tolerance > 0, of ‖b − A dx‖ over free nodes, relative to the largest of three: that with the free
/// dx = 0, `least_load`, and the force of rounding (1e-15 × stiffness × length) over the tolerance
/// @param max_iterations in total
/// @param length m, of a block
/// @param least_load N
/// @param directions in which dx is improved first, see first_guess.h
SolveReport solve(const LinearSystem& system, const NodeField& b, NodeField& dx, double tolerance,
                  int max_iterations, double length, double least_load = 0.0,
                  std::vector<SingleField> directions = {});

}  // namespace cfem_cutting
