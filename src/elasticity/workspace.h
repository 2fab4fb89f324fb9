#pragma once

#include "cfem_cutting/elasticity/integrator.h"
#include "element_product.h"

namespace cfem_cutting {

/// What an integrator keeps from solve to solve.
struct Integrator::Workspace {
  explicit Workspace(int threads) : pool(threads), product(pool) {}
  ThreadPool pool;
  ElementProduct product;
};

/// Single precision carries a relative residual of about 1e-6.
inline Precision precision_for(double tolerance) {
  return tolerance < 1e-5 ? Precision::kDouble : Precision::kSingle;
}

}  // namespace cfem_cutting
