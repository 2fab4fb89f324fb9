#pragma once

#include "cfem_cutting/elasticity/integrator.h"
#include "multigrid.h"

namespace cfem_cutting {

/// What an integrator keeps from solve to solve.
struct Integrator::Workspace {
  explicit Workspace(int threads) : pool(threads), multigrid(pool) {}
  ThreadPool pool;
  Multigrid multigrid;
};

}  // namespace cfem_cutting
