#include "metrics/solvation/interaction_lists.h"

#include <algorithm>
#include <utility>

namespace smopt::metrics {
namespace {

using ClusterPairs = std::vector<std::pair<ClusterId, ClusterId>>;

class Traversal {
 public:
  Traversal(const ClusterTree& tree, double theta, const std::vector<double>& reaches) : tree_(tree), theta_(theta), reaches_(reaches) {}

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
    if (are_well_separated(a, b)) {
      far.emplace_back(a, b);
    } else if (tree_[a].is_leaf() && tree_[b].is_leaf()) {
      near.emplace_back(a, b);
    } else {
      if (is_halved_before(b, a)) std::swap(a, b);
      visit_between(first_half(a), b);
      visit_between(tree_[a].second_half, b);
    }
  }

  [[nodiscard]] bool are_well_separated(ClusterId a, ClusterId b) const {
    const double distance = (tree_[a].center - tree_[b].center).norm();
    const double radii = tree_[a].radius + tree_[b].radius;
    return radii < theta_ * distance && std::max(reach(a), reach(b)) < distance - radii;
  }
  [[nodiscard]] double reach(ClusterId cluster) const { return reaches_.empty() ? 0 : reaches_[cluster]; }
  [[nodiscard]] bool is_halved_before(ClusterId a, ClusterId b) const {
    if (tree_[a].is_leaf() != tree_[b].is_leaf()) return tree_[b].is_leaf();
    return tree_[a].radius > tree_[b].radius;
  }

  const ClusterTree& tree_;
  double theta_;
  const std::vector<double>& reaches_;
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

InteractionLists interaction_lists(const ClusterTree& tree, double theta, const std::vector<double>& reaches) {
  Traversal traversal(tree, theta, reaches);
  if (!tree.is_empty()) traversal.visit_within(0);
  const std::size_t clusters = tree.clusters().size();
  return {ClusterLists(clusters, traversal.far), ClusterLists(clusters, traversal.near)};
}

std::vector<double> largest_reaches(const ClusterTree& tree, const std::vector<double>& reaches) {
  if (reaches.empty()) return {};
  std::vector<double> largest(tree.clusters().size());
  for (ClusterId c = 0; c < largest.size(); ++c)
    for (const std::uint32_t p : tree.points_of(c)) largest[c] = std::max(largest[c], reaches[p]);
  return largest;
}

}  // namespace smopt::metrics
