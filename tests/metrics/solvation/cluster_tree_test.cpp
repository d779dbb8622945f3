#include "metrics/solvation/cluster_tree.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "metrics/solvation/interaction_lists.h"

namespace smopt::metrics {
namespace {

std::vector<Vec3> random_points(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-20, 20);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = {coordinate(random), coordinate(random), 0.3 * coordinate(random)};
  return points;
}

std::vector<Vec3> two_clouds(std::size_t count) {
  std::vector<Vec3> points = random_points(count, 5);
  for (std::size_t i = 0; i < count / 2; ++i) points[i].x() += 1e5;
  return points;
}

/// Awkward and plain sets of points, and how many a leaf holds.
struct Case {
  const char* name;
  std::vector<Vec3> points;
  std::size_t leaf_size;
};

std::vector<Case> cases() {
  return {{"none", {}, 4},
          {"one", {{1, 2, 3}}, 4},
          {"two, leaves of one", {{1, 2, 3}, {1, 2, 4}}, 1},
          {"random", random_points(1237, 1), 10},
          {"random, leaves of one", random_points(300, 2), 1},
          {"all in one leaf", random_points(50, 3), 50},
          {"all equal", std::vector<Vec3>(100, Vec3(1e6, 0, 0)), 8},
          {"two clouds", two_clouds(400), 16}};
}

TEST(ClusterTree, HoldsEachPointInOneLeafOfTheAskedSize) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const ClusterTree tree(c.points, c.leaf_size);
    std::vector<int> seen(c.points.size(), 0);
    std::uint32_t next = 0;
    for (const ClusterId leaf : tree.leaves()) {
      EXPECT_EQ(tree[leaf].begin, next);
      EXPECT_THAT(tree[leaf].size(), ::testing::AllOf(::testing::Ge(1U), ::testing::Le(c.leaf_size)));
      next = tree[leaf].end;
      for (const std::uint32_t p : tree.points_of(leaf)) ++seen[p];
    }
    EXPECT_THAT(seen, ::testing::Each(1));
  }
}

TEST(ClusterTree, HalvesEachClusterIntoItsNextAndItsSecondHalf) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const ClusterTree tree(c.points, c.leaf_size);
    for (ClusterId id = 0; id < tree.clusters().size(); ++id) {
      const Cluster& cluster = tree[id];
      if (cluster.is_leaf()) {
        EXPECT_EQ(cluster.past, id + 1);
        continue;
      }
      const Cluster& first = tree[id + 1];
      const Cluster& second = tree[cluster.second_half];
      EXPECT_EQ(first.begin, cluster.begin);
      EXPECT_EQ(first.end, second.begin);
      EXPECT_EQ(second.end, cluster.end);
      EXPECT_EQ(first.past, cluster.second_half);
      EXPECT_EQ(second.past, cluster.past);
    }
  }
}

TEST(ClusterTree, DepthIsLogarithmicEvenOfAGeometricSequence) {
  std::vector<Vec3> points;
  for (int k = 0; k < 1000; ++k) points.emplace_back(std::pow(0.5, k), 0, 0);  // cut in the middle, all but one would be on one side
  const ClusterTree tree(points, 1);
  std::vector<int> depth(tree.clusters().size(), 0);
  for (ClusterId id = 0; id < tree.clusters().size(); ++id)
    if (!tree[id].is_leaf()) depth[id + 1] = depth[tree[id].second_half] = depth[id] + 1;
  EXPECT_LT(*std::max_element(depth.begin(), depth.end()),
            100);  // while a cluster has 16 points or more, 15/16 of them are in a half: 64 levels, and 15
}

TEST(ClusterTree, NoClusterOfTwoCloudsButTheRootHasPointsOfBoth) {
  std::vector<Vec3> points = random_points(1500, 6);
  for (std::size_t i = 0; i < 400; ++i) points[i].y() += 1e4;
  const ClusterTree tree(points, 16);
  for (ClusterId id = 1; id < tree.clusters().size(); ++id) EXPECT_LT(tree[id].radius, 1e3);
}

TEST(ClusterTree, BoxesAreTight) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const ClusterTree tree(c.points, c.leaf_size);
    for (ClusterId id = 0; id < tree.clusters().size(); ++id) {
      Vec3 farthest = Vec3::Zero();
      for (const std::uint32_t p : tree.points_of(id)) farthest = farthest.cwiseMax((c.points[p] - tree[id].center).cwiseAbs());
      EXPECT_LE((farthest - tree[id].half).norm(), 1e-9) << id;
      EXPECT_NEAR(tree[id].radius, tree[id].half.norm(), 1e-12) << id;
    }
  }
}

TEST(InteractionLists, CoverEachPairOfPointsOnce) {
  for (const Case& c : cases()) {
    for (const double theta : {0.2, 0.7, 0.95}) {
      SCOPED_TRACE(::testing::Message() << c.name << ", theta " << theta);
      const ClusterTree tree(c.points, c.leaf_size);
      const InteractionLists lists = interaction_lists(tree, theta);
      const std::size_t n = c.points.size();
      std::vector<int> seen(n * n, 0);
      for (ClusterId target = 0; target < tree.clusters().size(); ++target)
        for (const ClusterLists* list : {&lists.far, &lists.near})
          for (const ClusterId source : list->of(target))
            for (const std::uint32_t p : tree.points_of(target))
              for (const std::uint32_t q : tree.points_of(source)) ++seen[p * n + q];
      EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
    }
  }
}

TEST(InteractionLists, AreSymmetricAscendingAndKeepTheirDistance) {
  const double theta = 0.6;
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const ClusterTree tree(c.points, c.leaf_size);
    const InteractionLists lists = interaction_lists(tree, theta);
    for (ClusterId a = 0; a < tree.clusters().size(); ++a) {
      for (const ClusterLists* list : {&lists.far, &lists.near}) {
        EXPECT_TRUE(std::is_sorted(list->of(a).begin(), list->of(a).end()));
        for (const ClusterId b : list->of(a)) EXPECT_THAT(list->of(b), ::testing::Contains(a));
      }
      for (const ClusterId b : lists.far.of(a))
        EXPECT_LT(tree[a].radius + tree[b].radius, theta * (tree[a].center - tree[b].center).norm());
      for (const ClusterId b : lists.near.of(a)) EXPECT_TRUE(tree[a].is_leaf() && tree[b].is_leaf());
      EXPECT_EQ(std::count(lists.near.of(a).begin(), lists.near.of(a).end(), a), tree[a].is_leaf() ? 1 : 0);
    }
  }
}

}  // namespace
}  // namespace smopt::metrics
