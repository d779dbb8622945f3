#include "smopt/improve/cavities.h"

#include <gtest/gtest.h>

#include "tests/improve/judge.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace smopt::testing;

constexpr std::size_t kPoints0 = 12, kPoints1 = 42, kPoints2 = 162;  // of an icosphere divided 0, 1 and 2 times

/// Two outer spheres of radius 10 (the larger, 162 vertices) and 6; in the larger one a cavity (42) with an island in it (12) that has a
/// cavity of its own (12), and another cavity (12).
TriangleMesh everything() {
  TriangleMesh mesh = icosphere(2, 10);
  mesh = joined(mesh, reversed(icosphere(1, 5, {2, 0, 0})));
  mesh = joined(mesh, icosphere(0, 2, {2, 0, 0}));
  mesh = joined(mesh, reversed(icosphere(0, 1, {2, 0, 0})));
  mesh = joined(mesh, reversed(icosphere(0, 1, {-6, 0, 0})));
  return joined(mesh, icosphere(2, 6, {30, 0, 0}));
}

struct Outcome {
  TriangleMesh mesh;
  CavityReport report;
};

Outcome after(TriangleMesh mesh, CavityPolicy policy) {
  const CavityReport report = remove_cavities(mesh, policy);
  return {std::move(mesh), report};
}

TEST(Cavities, DeletingKeepsEveryOuterComponentAndNothingInside) {
  const auto [mesh, report] = after(everything(), CavityPolicy::delete_cavities);
  EXPECT_TRUE(is_same(mesh, joined(icosphere(2, 10), icosphere(2, 6, {30, 0, 0}))));
  EXPECT_EQ(report.components, 6U);
  EXPECT_EQ(report.cavities, 3U);
  EXPECT_EQ(report.islands, 1U);
  EXPECT_EQ(report.outer_components, 0U);
  EXPECT_EQ(report.cavity_vertices, kPoints1 + 3 * kPoints0);
  EXPECT_EQ(report.outer_component_vertices, 0U);
}

TEST(Cavities, KeepingKeepsAllAsItIs) {
  const auto [mesh, report] = after(everything(), CavityPolicy::keep);
  EXPECT_TRUE(is_same(mesh, everything()));
  EXPECT_EQ(report.components, 6U);
  EXPECT_EQ(report.cavities + report.islands + report.outer_components, 0U);
  EXPECT_EQ(report.cavity_vertices + report.outer_component_vertices, 0U);
}

TEST(Cavities, MainKeepsTheLargestOuterComponentAndCountsTheOthersApart) {
  const auto [mesh, report] = after(everything(), CavityPolicy::main);
  EXPECT_TRUE(is_same(mesh, icosphere(2, 10)));
  EXPECT_EQ(report.cavities, 3U);
  EXPECT_EQ(report.islands, 1U);
  EXPECT_EQ(report.outer_components, 1U);
  EXPECT_EQ(report.cavity_vertices, kPoints1 + 3 * kPoints0);
  EXPECT_EQ(report.outer_component_vertices, kPoints2);
}

TEST(Cavities, AreToldByContainmentWhateverTheirOrientation) {
  TriangleMesh same_way = icosphere(2, 10);
  same_way = joined(same_way, icosphere(1, 5, {2, 0, 0}));            // a cavity that points outwards
  same_way = joined(same_way, reversed(icosphere(0, 2, {2, 0, 0})));  // an island that points inwards
  same_way = joined(same_way, reversed(icosphere(1, 2, {20, 0, 0})));
  const auto [mesh, report] = after(same_way, CavityPolicy::delete_cavities);
  EXPECT_TRUE(is_same(mesh, joined(icosphere(2, 10), reversed(icosphere(1, 2, {20, 0, 0})))));
  EXPECT_EQ(report.cavities, 1U);
  EXPECT_EQ(report.islands, 1U);
}

TEST(Cavities, AComponentInTheHoleOfATorusOrInAnotherOnesBoxIsOuter) {
  const TriangleMesh mesh = joined(torus(5, 1, 40, 16), joined(icosphere(1, 1), icosphere(1, 0.3, {3.7, 3.7, 0.9})));
  const auto [same, report] = after(mesh, CavityPolicy::delete_cavities);
  EXPECT_TRUE(is_same(same, mesh));
  EXPECT_EQ(report.cavities, 0U);
}

TEST(Cavities, AreFoundWhereARayMeetsVerticesAndEdgesExactly) {
  // All centres on one axis: the ray from the cavity's extreme vertex runs through vertices of the others.
  const TriangleMesh mesh = joined(scaled(translated(cube(), {-0.5, -0.5, -0.5}), 8), reversed(translated(cube(), {-0.5, -0.5, -0.5})));
  EXPECT_EQ(after(mesh, CavityPolicy::delete_cavities).report.cavities, 1U);
  const TriangleMesh aligned = joined(cube(), translated(cube(), {-2, 0, 0}));
  EXPECT_EQ(after(aligned, CavityPolicy::delete_cavities).report.cavities, 0U);
}

TEST(Cavities, DoNotDependOnTheOrderOfVerticesAndTriangles) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const auto [mesh, report] = after(relabelled(everything(), seed), CavityPolicy::delete_cavities);
    EXPECT_EQ(report.cavities, 3U) << "seed " << seed;
    EXPECT_EQ(report.islands, 1U);
    EXPECT_EQ(report.cavity_vertices, kPoints1 + 3 * kPoints0);
    EXPECT_EQ(mesh.vertex_count(), 2 * kPoints2);
    EXPECT_THAT(mesh, IsClosedManifold());
    EXPECT_NEAR(enclosed_volume(mesh), enclosed_volume(icosphere(2, 10)) + enclosed_volume(icosphere(2, 6)), 1e-9);
  }
}

TEST(Cavities, MainOfOneComponentIsThatComponent) {
  for (const CavityPolicy policy : {CavityPolicy::main, CavityPolicy::delete_cavities, CavityPolicy::keep})
    EXPECT_TRUE(is_same(after(tetrahedron(), policy).mesh, tetrahedron()));
}

}  // namespace
}  // namespace smopt
