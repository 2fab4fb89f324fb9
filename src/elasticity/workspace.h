#pragma once

#include "cfem_cutting/elasticity/integrator.h"
#include "conjugate_gradients.h"

namespace cfem_cutting {

/// What an integrator keeps from solve to solve.
struct Integrator::Workspace {
  explicit Workspace(int threads) : pool(threads), multigrid(pool) {}
  ThreadPool pool;
  Multigrid multigrid;
  ConjugateGradients solver;
  RecentChanges changes;
  ElasticResponse elastic;
  NodeField dx;
};

}  // namespace cfem_cutting
