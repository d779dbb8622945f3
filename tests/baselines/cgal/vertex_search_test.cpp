#include "baselines/cgal/vertex_search.h"

#include <gtest/gtest.h>

#include <cmath>

namespace smopt::baselines {
namespace {

/// A remeshing that gives so many vertices, in meshes that are nothing else.
struct FakeRemeshing {
  std::function<double(double)> vertices;
  std::vector<double> lengths = {};

  VertexSearchResult search(std::size_t target, double first_length) {
    return search_vertex_count(target, first_length, [&](double length) {
      lengths.push_back(length);
      TriangleMesh mesh;
      mesh.points.resize(static_cast<std::size_t>(std::max(4.0, vertices(length))));
      return mesh;
    });
  }
};

TEST(VertexSearch, TakesTheFirstLengthWhereItFits) {
  FakeRemeshing remeshing{[](double length) { return 1000 / (length * length); }};
  const VertexSearchResult result = remeshing.search(1000, 1.0);
  EXPECT_EQ(result.runs, 1);
  EXPECT_EQ(result.edge_length, 1.0);
  EXPECT_TRUE(result.is_near);
}

TEST(VertexSearch, FindsTheLengthOfAnInverseSquareInTwoRuns) {
  FakeRemeshing remeshing{[](double length) { return 1000 / (length * length); }};
  const VertexSearchResult result = remeshing.search(4000, 1.0);
  EXPECT_EQ(result.runs, 2);
  EXPECT_NEAR(result.edge_length, 0.5, 1e-12);
  EXPECT_EQ(result.mesh.vertex_count(), 4000U);
  EXPECT_TRUE(result.is_near);
}

TEST(VertexSearch, LearnsAnotherExponentFromItsSamples) {
  FakeRemeshing remeshing{[](double length) { return 1000 * std::pow(length, -2.6) + 30; }};
  for (const std::size_t target : {300U, 2000U, 30'000U}) {
    const VertexSearchResult result = remeshing.search(target, 1.0);
    EXPECT_TRUE(result.is_near) << target;
    EXPECT_LE(result.runs, 4) << target;
    EXPECT_NEAR(static_cast<double>(result.mesh.vertex_count()), static_cast<double>(target),
                kVertexTolerance * static_cast<double>(target));
  }
}

TEST(VertexSearch, GivesUpAfterSixRunsWithTheNearest) {
  FakeRemeshing remeshing{[](double length) { return length < 0.9 ? 500.0 : 90.0; }};  // nothing near 100
  const VertexSearchResult result = remeshing.search(100, 0.5);
  EXPECT_EQ(result.runs, kMostRuns);
  EXPECT_EQ(remeshing.lengths.size(), static_cast<std::size_t>(kMostRuns));
  EXPECT_FALSE(result.is_near);
  EXPECT_EQ(result.mesh.vertex_count(), 90U);
}

TEST(VertexSearch, GivesTheMeshThatBelongsToTheLength) {
  int calls = 0;
  const VertexSearchResult result = search_vertex_count(100, 1.0, [&](double) {
    TriangleMesh mesh;
    mesh.points.resize(++calls == 2 ? 102 : 200);  // the second is the nearest, and too far
    return mesh;
  });
  EXPECT_EQ(result.mesh.vertex_count(), 102U);
  EXPECT_NEAR(result.edge_length, std::sqrt(2.0), 1e-12);
}

}  // namespace
}  // namespace smopt::baselines
