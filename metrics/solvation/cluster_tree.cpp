#include "metrics/solvation/cluster_tree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace smopt::metrics {
namespace {

Cluster enclosing(const std::vector<Vec3>& points, std::span<const std::uint32_t> members) {
  Eigen::AlignedBox3d box;
  for (const std::uint32_t p : members) box.extend(points[p]);
  Cluster cluster;
  cluster.center = box.center();
  cluster.half = 0.5 * box.sizes();
  cluster.radius = cluster.half.norm();
  return cluster;
}

/// Least part of a cluster's points in either of its halves.
constexpr std::size_t kLeastPart = 16;

/// How many of the points belong in the first half.
std::size_t size_of_first_half(const std::vector<Vec3>& points, std::span<const std::uint32_t> members, const Cluster& cluster,
                               Eigen::Index axis) {
  if (cluster.half[axis] == 0) return members.size() / 2;
  const auto below = std::count_if(members.begin(), members.end(), [&](std::uint32_t p) { return points[p][axis] < cluster.center[axis]; });
  const std::size_t least = std::max<std::size_t>(members.size() / kLeastPart, 1);
  return std::clamp(static_cast<std::size_t>(below), least, members.size() - least);
}

/// Puts the `count` points with the smallest coordinates along `axis` first.
void put_first(const std::vector<Vec3>& points, std::span<std::uint32_t> members, std::size_t count, Eigen::Index axis) {
  const auto along = [&](std::uint32_t p) { return std::pair(points[p][axis], p); };
  std::nth_element(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(count), members.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return along(a) < along(b); });
}

}  // namespace

ClusterTree::ClusterTree(const std::vector<Vec3>& points, std::size_t leaf_size) : order_(points.size()) {
  assert(leaf_size > 0);
  std::iota(order_.begin(), order_.end(), 0U);
  if (!points.empty()) build(points, 0, static_cast<std::uint32_t>(points.size()), leaf_size);
}

ClusterId ClusterTree::build(const std::vector<Vec3>& points, std::uint32_t begin, std::uint32_t end, std::size_t leaf_size) {
  const auto id = static_cast<ClusterId>(clusters_.size());
  const std::span<std::uint32_t> members = std::span(order_).subspan(begin, end - begin);
  Cluster cluster = enclosing(points, members);
  cluster.begin = begin;
  cluster.end = end;
  clusters_.push_back(cluster);
  if (members.size() > leaf_size) {
    Eigen::Index longest = 0;
    cluster.half.maxCoeff(&longest);
    const std::size_t first_half = size_of_first_half(points, members, cluster, longest);
    put_first(points, members, first_half, longest);
    const std::uint32_t middle = begin + static_cast<std::uint32_t>(first_half);
    build(points, begin, middle, leaf_size);
    clusters_[id].second_half = build(points, middle, end, leaf_size);
  }
  clusters_[id].past = static_cast<ClusterId>(clusters_.size());
  return id;
}

std::vector<ClusterId> ClusterTree::leaves() const {
  std::vector<ClusterId> leaves;
  for (ClusterId c = 0; c < clusters_.size(); ++c)
    if (clusters_[c].is_leaf()) leaves.push_back(c);
  return leaves;
}

}  // namespace smopt::metrics
