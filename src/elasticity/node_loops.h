#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <type_traits>
#include <vector>

#include "thread_pool.h"

namespace cfem_cutting {

/// Calls work(node) for each node, on several threads.
template <typename Work>
void for_each_node(ThreadPool& pool, Eigen::Index count, const Work& work) {
  constexpr int kFewest = 2048;  // worth waking a thread for
  pool.for_range(static_cast<int>(count), kFewest, [&](int begin, int end) {
    for (int n = begin; n < end; ++n) work(n);
  });
}

/// Σ of the entries of term(node), a small vector, in parts of fixed size, so that the sum is the same for
/// any number of threads.
template <typename Term>
double sum_over_nodes(ThreadPool& pool, Eigen::Index count, const Term& term) {
  constexpr int kPart = 1024;
  using Sum = Eigen::Matrix<double, std::decay_t<decltype(term(0))>::RowsAtCompileTime, 1>;
  const int nodes = static_cast<int>(count);
  std::vector<double> sums(nodes / kPart + 1);
  pool.for_range(static_cast<int>(sums.size()), 2, [&](int begin, int end) {
    for (int part = begin; part < end; ++part) {
      const int last = std::min(nodes, (part + 1) * kPart);
      Sum sum = Sum::Zero();
      for (int n = part * kPart; n < last; ++n) sum += term(n).template cast<double>();
      sums[part] = sum.sum();
    }
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

/// Σ aᵢ bᵢ
template <typename Field>
double dot(ThreadPool& pool, const Field& a, const Field& b) {
  return sum_over_nodes(pool, a.cols(), [&](int n) { return a.col(n).cwiseProduct(b.col(n)); });
}

}  // namespace cfem_cutting
