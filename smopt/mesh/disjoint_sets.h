#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace smopt {

/// Union–find with path halving; the smaller index becomes the root. Cost: O(log n) a call, amortised.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// Joins the sets of i and j; false when they were one already.
  bool unite(std::uint32_t i, std::uint32_t j) {
    i = root(i);
    j = root(j);
    parent_[std::max(i, j)] = std::min(i, j);
    return i != j;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace smopt
