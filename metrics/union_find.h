#pragma once

#include <cstddef>
#include <vector>

namespace smopt::metrics {

/// Disjoint sets over 0 … n − 1 with path halving; the smaller root wins, so the result does not depend on the order of the unions.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) {
    parent_.reserve(n);
    for (std::size_t i = 0; i < n; ++i) parent_.push_back(i);
  }

  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void unite(std::size_t i, std::size_t j) {
    i = root(i);
    j = root(j);
    if (i < j)
      parent_[j] = i;
    else
      parent_[i] = j;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace smopt::metrics
