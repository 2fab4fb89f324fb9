#include "first_guess.h"

#include "node_loops.h"

namespace cfem_cutting {
namespace {

/// Of a direction's energy: less is left of it only by rounding.
constexpr double kRounding = 1e-6;

struct Direction {
  SingleField p, Ap;
  double curvature;  // p·Ap
};

double dot(ThreadPool& pool, const SingleField& a, const SingleField& b) {
  return sum_over_nodes(pool, a.cols(), [&](int n) { return a.col(n).dot(b.col(n)); });
}

void subtract(ThreadPool& pool, double factor, const SingleField& b, SingleField& a) {
  const auto f = static_cast<float>(factor);
  for_each_node(pool, a.cols(), [&](int n) { a.col(n) -= f * b.col(n); });
}

/// Conjugate to the others (Gram and Schmidt in the energy's product).
Direction conjugate_direction(const LinearSystem& system, SingleField p, const std::vector<Direction>& others) {
  ThreadPool& pool = system.multigrid().pool();
  system.clear_held(p);
  Direction d{std::move(p), {}, 0.0};
  system.multigrid().finest().apply(d.p, d.Ap);
  system.clear_held(d.Ap);
  const double whole = dot(pool, d.p, d.Ap);
  for (const Direction& other : others) {
    const double part = dot(pool, d.p, other.Ap) / other.curvature;
    subtract(pool, part, other.p, d.p);
    subtract(pool, part, other.Ap, d.Ap);
  }
  const double left = dot(pool, d.p, d.Ap);
  d.curvature = left > kRounding * whole ? left : 0.0;
  return d;
}

}  // namespace

std::vector<SingleField> recent_changes(const ElasticState& state, ThreadPool& pool) {
  std::vector<SingleField> changes;
  const NodeField* after = &state.v;
  for (const NodeField& before : state.past_v) {
    if (before.cols() != after->cols()) break;
    SingleField change(4, before.cols());
    for_each_node(pool, before.cols(), [&](int n) {
      change.col(n) << (after->col(n) - before.col(n)).cast<float>(), 0.0f;
    });
    changes.push_back(std::move(change));
    after = &before;
  }
  return changes;
}

void minimise_over(const LinearSystem& system, std::vector<SingleField> directions, SingleField& r,
                   SingleField& x) {
  ThreadPool& pool = system.multigrid().pool();
  std::vector<Direction> done;
  for (SingleField& p : directions) {
    Direction d = conjugate_direction(system, std::move(p), done);
    if (!(d.curvature > 0.0)) continue;
    const double length = dot(pool, d.p, r) / d.curvature;
    subtract(pool, -length, d.p, x);
    subtract(pool, length, d.Ap, r);
    done.push_back(std::move(d));
  }
}

}  // namespace cfem_cutting
