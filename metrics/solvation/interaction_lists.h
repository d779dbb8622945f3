#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "metrics/solvation/cluster_tree.h"

namespace smopt::metrics {

/// For each cluster a list of clusters, ascending.
class ClusterLists {
 public:
  ClusterLists() = default;
  /// \param pairs  unordered: each adds either of the two to the other's list, once if they are the same.
  ClusterLists(std::size_t clusters, const std::vector<std::pair<ClusterId, ClusterId>>& pairs);

  [[nodiscard]] std::span<const ClusterId> of(ClusterId cluster) const {
    return std::span(entries_).subspan(begins_[cluster], begins_[cluster + 1] - begins_[cluster]);
  }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

 private:
  std::vector<std::size_t> begins_ = {0};
  std::vector<ClusterId> entries_;
};

/// Lists such that each ordered pair of points, a point with itself too, is in exactly one pair of clusters (target and source) of one of the two.
/// Both are symmetric.
struct InteractionLists {
  ClusterLists far;  ///< well-separated clusters: (radius + radius) < theta · distance of the centres, and no point reaches into the other
  ClusterLists near;  ///< leaves that are not, each with itself too
};

/// Dual-tree traversal (Wilson, Vaughn & Krasny 2021, Comput. Phys. Commun. 265:108017, algorithm 2): of two clusters that are not well separated
/// the larger is halved.
/// \param theta    in (0, 1).
/// \param reaches  the largest reach of a cluster's points, ångström; one for each cluster, or none: all 0.
/// Cost: O(n) for points on a surface, one thread.
InteractionLists interaction_lists(const ClusterTree& tree, double theta, const std::vector<double>& reaches = {});

/// The largest reach of each cluster's points. \param reaches  one for each point, or none, which gives none. Cost: O(n·log n).
std::vector<double> largest_reaches(const ClusterTree& tree, const std::vector<double>& reaches);

}  // namespace smopt::metrics
