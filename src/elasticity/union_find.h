#pragma once

#include <numeric>
#include <vector>

namespace cfem_cutting {

/// Disjoint sets of 0 … count − 1. The root of a set is its smallest member, whatever the order of unions.
class UnionFind {
 public:
  explicit UnionFind(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void unite(int a, int b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

}  // namespace cfem_cutting
