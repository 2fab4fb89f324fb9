#pragma once

#include "linear_system.h"

namespace cfem_cutting {

/// Solves A dx = b by conjugate gradients in single precision, preconditioned by the V-cycle, inside
/// iterative refinement; held nodes keep their dx.
/// @param dx initial guess, and the solution
/// @param tolerance of ‖b − A dx‖ over free nodes, relative to that with the free dx = 0 or, if larger,
/// `least_load` (N)
/// @param max_iterations in total
/// @param length m, of a block: the size of dx below which there is only rounding. Where the load is no more
/// than that, residuals are relative to it
SolveReport solve(const LinearSystem& system, const NodeField& b, NodeField& dx, double tolerance,
                  int max_iterations, double length, double least_load = 0.0);

}  // namespace cfem_cutting
