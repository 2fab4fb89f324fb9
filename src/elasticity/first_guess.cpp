#include "first_guess.h"

#include "node_loops.h"

namespace cfem_cutting {
namespace {

/// Of a direction's energy: less is left of it only by rounding.
constexpr double kRounding = 1e-6;

void subtract(ThreadPool& pool, double factor, const SingleField& b, SingleField& a) {
  const auto f = static_cast<float>(factor);
  for_each_node(pool, a.cols(), [&](int n) { a.col(n) -= f * b.col(n); });
}

}  // namespace

void RecentChanges::take(const ElasticState& state, ThreadPool& pool) {
  count_ = 0;
  const NodeField* after = &state.v;
  for (const NodeField& before : state.past_v) {
    if (before.cols() != after->cols()) break;
    SingleField& p = directions_[count_++].p;
    p.resize(4, before.cols());
    for_each_node(pool, before.cols(),
                  [&](int n) { p.col(n) << (after->col(n) - before.col(n)).cast<float>(), 0.0f; });
    after = &before;
  }
}

/// To the directions before it (Gram and Schmidt in the energy's product).
void RecentChanges::make_conjugate(const LinearSystem& system, int i) {
  ThreadPool& pool = system.multigrid().pool();
  Direction& d = directions_[i];
  system.clear_held(d.p);
  system.multigrid().finest().apply(d.p, d.Ap);
  system.clear_held(d.Ap);
  const double whole = dot(pool, d.p, d.Ap);
  for (int j = 0; j < i; ++j) {
    const Direction& other = directions_[j];
    if (!(other.curvature > 0.0)) continue;
    const double part = dot(pool, d.p, other.Ap) / other.curvature;
    subtract(pool, part, other.p, d.p);
    subtract(pool, part, other.Ap, d.Ap);
  }
  const double left = dot(pool, d.p, d.Ap);
  d.curvature = left > kRounding * whole ? left : 0.0;
}

void RecentChanges::minimise(const LinearSystem& system, SingleField& r, SingleField& x) {
  ThreadPool& pool = system.multigrid().pool();
  for (int i = 0; i < count_; ++i) {
    make_conjugate(system, i);
    const Direction& d = directions_[i];
    if (!(d.curvature > 0.0)) continue;
    const double length = dot(pool, d.p, r) / d.curvature;
    subtract(pool, -length, d.p, x);
    subtract(pool, length, d.Ap, r);
  }
}

}  // namespace cfem_cutting
