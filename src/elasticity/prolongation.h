#pragma once

#include "coarsening.h"

namespace cfem_cutting {

/// An interpolation whose rows' weights are equal, as they are at corners of blocks of half the size: one
/// over 1, 2, 4 or 8 terms. In each part of some rows those with as many terms come together, so that loops
/// have fixed lengths.
class Prolongation {
 public:
  Prolongation() = default;
  explicit Prolongation(const Interpolation& interpolation);

  /// y_i += Σ w x
  void add(ThreadPool& pool, const Eigen::Matrix4Xf& x, Eigen::Matrix4Xf& y) const;

 private:
  struct Part {
    std::array<int, 5> row;  // the first with 1, 2, 4 and 8 terms, and the end
    int term;                // the first
  };
  std::vector<Part> parts_;
  std::vector<int> rows_;
  std::vector<int> terms_;
};

}  // namespace cfem_cutting
