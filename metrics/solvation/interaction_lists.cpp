#include "metrics/solvation/interaction_lists.h"

#include <algorithm>
#include <utility>

namespace smopt::metrics {
namespace {

using ClusterPairs = std::vector<std::pair<ClusterId, ClusterId>>;

class Traversal {
 public:
  Traversal(const ClusterTree& tree, double theta) : tree_(tree), theta_(theta) {}

  void visit_within(ClusterId cluster) {
    if (tree_[cluster].is_leaf()) {
      near.emplace_back(cluster, cluster);
      return;
    }
    visit_within(first_half(cluster));
    visit_within(tree_[cluster].second_half);
    visit_between(first_half(cluster), tree_[cluster].second_half);
  }

  ClusterPairs far;
  ClusterPairs near;

 private:
  [[nodiscard]] static ClusterId first_half(ClusterId cluster) { return cluster + 1; }

  void visit_between(ClusterId a, ClusterId b) {
    if (are_well_separated(tree_[a], tree_[b])) {
      far.emplace_back(a, b);
    } else if (tree_[a].is_leaf() && tree_[b].is_leaf()) {
      near.emplace_back(a, b);
    } else {
      if (is_halved_before(b, a)) std::swap(a, b);
      visit_between(first_half(a), b);
      visit_between(tree_[a].second_half, b);
    }
  }

  [[nodiscard]] bool are_well_separated(const Cluster& a, const Cluster& b) const {
    return a.radius + b.radius < theta_ * (a.center - b.center).norm();
  }
  [[nodiscard]] bool is_halved_before(ClusterId a, ClusterId b) const {
    if (tree_[a].is_leaf() != tree_[b].is_leaf()) return tree_[b].is_leaf();
    return tree_[a].radius > tree_[b].radius;
  }

  const ClusterTree& tree_;
  double theta_;
};

}  // namespace

ClusterLists::ClusterLists(std::size_t clusters, const ClusterPairs& pairs) : begins_(clusters + 1, 0) {
  for (const auto& [a, b] : pairs) {
    ++begins_[a + 1];
    if (a != b) ++begins_[b + 1];
  }
  for (std::size_t c = 0; c < clusters; ++c) begins_[c + 1] += begins_[c];
  entries_.resize(begins_.back());
  std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
  for (const auto& [a, b] : pairs) {
    entries_[next[a]++] = b;
    if (a != b) entries_[next[b]++] = a;
  }
  for (std::size_t c = 0; c < clusters; ++c)
    std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(begins_[c]), entries_.begin() + static_cast<std::ptrdiff_t>(begins_[c + 1]));
}

InteractionLists interaction_lists(const ClusterTree& tree, double theta) {
  Traversal traversal(tree, theta);
  if (!tree.is_empty()) traversal.visit_within(0);
  const std::size_t clusters = tree.clusters().size();
  return {ClusterLists(clusters, traversal.far), ClusterLists(clusters, traversal.near)};
}

}  // namespace smopt::metrics
