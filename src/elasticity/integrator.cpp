#include "cfem_cutting/elasticity/integrator.h"

#include "equilibrium.h"
#include "node_loops.h"
#include "subnormals.h"
#include "workspace.h"

namespace cfem_cutting {

Integrator::Integrator(const SolverOptions& options)
    : options_(options), workspace_(std::make_unique<Workspace>(options.threads)) {}

Integrator::~Integrator() = default;

SolveReport Integrator::step(const ElasticModel& model, ElasticState& state, double dt, const Vec3& gravity,
                             const HeldNodes& held, const std::vector<PointConstraint>& constraints) {
  const FlushSubnormals flush;  // also where no thread pool is at work
  ThreadPool& pool = workspace_->pool;
  ElasticResponse& elastic = workspace_->elastic;
  model.respond(state.x, pool, elastic);
  const double inertia = 1.0 / (dt * dt) + options_.rayleigh_mass / dt;
  const LinearSystem system(workspace_->multigrid, model, std::move(elastic.rotations),
                            {inertia * model.mass(), 1.0 + options_.rayleigh_stiffness / dt, &constraints},
                            held.nodes, precision_for(options_.tolerance));

  NodeField& b = elastic.forces;
  NodeField& dx = workspace_->dx;
  dx.resize(3, b.cols());
  for_each_node(pool, b.cols(), [&](int n) {
    b.col(n) += model.mass()[n] * (state.v.col(n) / dt + gravity);
    dx.col(n) = dt * state.v.col(n);
  });
  add_constraint_forces(constraints, state.x, b);
  for (std::size_t i = 0; i < held.nodes.size(); ++i)
    dx.col(held.nodes[i]) = held.positions[i] - state.x.col(held.nodes[i]);

  workspace_->changes.take(state, pool);
  SolveReport report =
      workspace_->solver.solve(system, b, dx,
                               {options_.tolerance, options_.max_iterations, model.mesh().block_size().mean(),
                                gravity.norm() * model.mass().norm()},
                               &workspace_->changes);
  report.inverted_elements = elastic.inverted;
  state.past_v[1].swap(state.past_v[0]);
  state.past_v[0].swap(state.v);
  state.v.resize(3, dx.cols());
  for_each_node(pool, dx.cols(), [&](int n) {
    state.x.col(n) += dx.col(n);
    state.v.col(n) = dx.col(n) / dt;
  });
  return report;
}

SolveReport Integrator::equilibrate(const ElasticModel& model, NodeField& x, const Vec3& gravity,
                                    const HeldNodes& held, const std::vector<PointConstraint>& constraints,
                                    int max_newton) {
  const FlushSubnormals flush;
  Equilibrium equilibrium(model, x, gravity, held, constraints);
  return equilibrium.solve_newton(workspace_->multigrid, workspace_->solver, options_, x, max_newton);
}

std::vector<Vec3> reactions(const ElasticModel& model, const NodeField& x, const Vec3& gravity,
                            const HeldNodes& held, const std::vector<PointConstraint>& constraints) {
  NodeField forces = model.forces(x) + gravity * model.mass().transpose();
  add_constraint_forces(constraints, x, forces);
  std::vector<Vec3> reactions;
  for (int node : held.nodes) reactions.push_back(-forces.col(node));
  return reactions;
}

}  // namespace cfem_cutting
