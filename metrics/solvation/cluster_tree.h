#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "smopt/geometry/vec3.h"

namespace smopt::metrics {

/// Number of a cluster in its tree.
using ClusterId = std::uint32_t;

/// Points that are close together, at consecutive places of the tree's order.
struct Cluster {
  std::uint32_t begin = 0;     ///< first place
  std::uint32_t end = 0;       ///< past the last place
  ClusterId second_half = 0;   ///< the first half follows the cluster itself; 0 in a leaf, which has no halves
  ClusterId past = 0;          ///< past the last descendant: the clusters within are those from this one to there
  Vec3 center = Vec3::Zero();  ///< of the tight box around the points
  Vec3 half = Vec3::Zero();    ///< its half extents, ångström; 0 where all points have the same coordinate
  double radius = 0;           ///< half its diagonal, ångström

  [[nodiscard]] std::size_t size() const { return end - begin; }
  [[nodiscard]] bool is_leaf() const { return second_half == 0; }
};

/// A binary tree over points: a cluster's tight box is cut in the middle of its longest edge, so that clusters follow the gaps between points,
/// until a leaf holds them. Each half has a sixteenth of the points at least, whatever that does to the cut, so that the depth is O(log n) for
/// any points, equal ones too. The same for the same points (ties go by number).
class ClusterTree {
 public:
  /// \param points     finite coordinates, ångström.
  /// \param leaf_size  most points in a leaf; at least 1.
  /// Cost: O(n·log n), one thread.
  ClusterTree(const std::vector<Vec3>& points, std::size_t leaf_size);

  /// In depth-first order, the root first; none if there are no points.
  [[nodiscard]] const std::vector<Cluster>& clusters() const { return clusters_; }
  [[nodiscard]] const Cluster& operator[](ClusterId cluster) const { return clusters_[cluster]; }
  [[nodiscard]] bool is_empty() const { return clusters_.empty(); }
  /// The point at each place.
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }
  /// The points of a cluster.
  [[nodiscard]] std::span<const std::uint32_t> points_of(ClusterId cluster) const {
    return std::span(order_).subspan(clusters_[cluster].begin, clusters_[cluster].size());
  }
  /// In depth-first order: the leaves' points are all points, in the tree's order.
  [[nodiscard]] std::vector<ClusterId> leaves() const;

 private:
  ClusterId build(const std::vector<Vec3>& points, std::uint32_t begin, std::uint32_t end, std::size_t leaf_size);

  std::vector<std::uint32_t> order_;
  std::vector<Cluster> clusters_;
};

}  // namespace smopt::metrics
