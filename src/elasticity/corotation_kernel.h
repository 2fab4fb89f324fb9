#pragma once

#include "element_kernel.h"

namespace cfem_cutting {

/// What a batch of co-rotational elements answers at node positions x. Arrays are lane-major: entry i of lane
/// l at [16 i + l]. Let g be the mean gradients of the shape functions, F = Σ xₙ gₙᵀ, R its rotation and
/// u = Rᵀx − X.
struct CorotationBatch {
  const double* x;           ///< (3 × |nodes|), m
  const int* nodes;          ///< (8 × 16)
  const double* gradient;    ///< (24 × 16), 1/m; entry 3 n + axis
  const double* block_size;  ///< (3), m
  MatrixForm form;
  const double* stiffness;  ///< N/m
  double* forces;           ///< (8 × 16 × 4), N: −∂energy/∂x, quads as in ElementBatch::y
  double* rotations;        ///< (9 × 16), R row by row
  double* energy;           ///< (16), J: ½ uᵀ K u
  bool* regular;            ///< (16): false where the element is flat, inverted or nearly so: no answer
};

/// Answers for one instruction set.
struct CorotationKernel {
  const char* name;
  void (*respond)(const CorotationBatch&);
};

/// Those that this processor can run, the widest first.
const std::vector<CorotationKernel>& corotation_kernels();

/// Answers with the widest instructions that this processor has. Rotations come by Newton's iteration (Higham
/// 1986), forces are the true gradient of the energy.
void respond(const CorotationBatch& batch);

}  // namespace cfem_cutting
