#include "smopt/improve/redundant_points.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "smopt/error.h"
#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace smopt::testing;

struct Outcome {
  TriangleMesh mesh;
  RedundantPointReport report;
};

Outcome without_redundant_points(TriangleMesh mesh, const RedundantPointOptions& options = {}) {
  RedundantPointReport report = remove_redundant_points(mesh, options);
  return {std::move(mesh), report};
}

/// A vertex of valence 3 over the centre of the first face of an icosahedron (edge about 1.05), `height` above it: the last vertex.
TriangleMesh with_raised_point_in_face(double height) {
  TriangleMesh mesh = icosphere(0);
  const auto [a, b, c] = mesh.triangles.front();
  const Vec3 normal = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).normalized();
  mesh.points.emplace_back((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3 + height * normal);
  mesh.triangles.front() = {a, b, 12};
  mesh.triangles.insert(mesh.triangles.end(), {{b, c, 12}, {c, a, 12}});
  return mesh;
}

/// A vertex of valence 4 over the middle of the first edge of an icosahedron, `height` farther out: the last vertex.
TriangleMesh with_raised_point_on_edge(double height) {
  const TriangleMesh mesh = icosphere(0);
  const VertexId a = mesh.triangles[0][0], b = mesh.triangles[0][1];
  const Vec3 middle = 0.5 * (mesh.points[a] + mesh.points[b]);
  TriangleMesh result{mesh.points, {}};
  result.points.emplace_back(middle + height * middle.normalized());
  for (const Triangle& t : mesh.triangles) {
    const auto at = std::find_if(t.begin(), t.end(), [&](VertexId v) { return v != a && v != b; });
    const bool has_both = std::count(t.begin(), t.end(), a) + std::count(t.begin(), t.end(), b) == 2;
    if (!has_both) {
      result.triangles.push_back(t);
      continue;
    }
    const auto i = static_cast<std::size_t>(at - t.begin());
    const VertexId c = t[i], p = t[(i + 1) % 3], q = t[(i + 2) % 3];
    result.triangles.insert(result.triangles.end(), {{c, p, 12}, {c, 12, q}});
  }
  return result;
}

TEST(RedundantPoints, RemovesAPointInAFaceAndKeepsTheGeometry) {
  const auto [mesh, report] = without_redundant_points(with_raised_point_in_face(0));
  EXPECT_EQ(report.valence3, 1U);
  EXPECT_EQ(report.valence4, 0U);
  EXPECT_EQ(mesh.vertex_count(), 12U);
  EXPECT_THAT(mesh, IsClosedManifold());
  EXPECT_NEAR(enclosed_volume(mesh), enclosed_volume(icosphere(0)), 1e-14);
  EXPECT_NEAR(surface_area(mesh), surface_area(icosphere(0)), 1e-13);
}

TEST(RedundantPoints, RemovesAPointOnAnEdgeAndKeepsTheGeometry) {
  const auto [mesh, report] = without_redundant_points(with_raised_point_on_edge(0));
  EXPECT_EQ(report.valence3, 0U);
  EXPECT_EQ(report.valence4, 1U);
  EXPECT_EQ(mesh.vertex_count(), 12U);
  EXPECT_THAT(mesh, IsClosedManifold());
  EXPECT_NEAR(enclosed_volume(mesh), enclosed_volume(icosphere(0)), 1e-14);
  EXPECT_NEAR(surface_area(mesh), surface_area(icosphere(0)), 1e-13);
}

TEST(RedundantPoints, MeasuresTheToleranceInTheUnitOfTheCoordinates) {
  for (const double scale : {1.0, 1000.0}) {
    for (const auto& shape : {with_raised_point_in_face, with_raised_point_on_edge}) {
      const RedundantPointOptions options{0.01 * scale, false};
      EXPECT_EQ(without_redundant_points(scaled(shape(0.0099), scale), options).mesh.vertex_count(), 12U);
      EXPECT_EQ(without_redundant_points(scaled(shape(0.0101), scale), options).mesh.vertex_count(), 13U);
      EXPECT_EQ(without_redundant_points(scaled(shape(-0.0099), scale), options).mesh.vertex_count(), 12U);
    }
  }
}

TEST(RedundantPoints, MeasuresARelativeToleranceInTheLongestEdgeAtTheVertex) {
  // Spokes: three of length edge / √3 in the face; on the edge two of half the edge and two of edge · √3 / 2.
  const double edge = (icosphere(0).points[icosphere(0).triangles[0][0]] - icosphere(0).points[icosphere(0).triangles[0][1]]).norm();
  const RedundantPointOptions options{0.01, true};
  for (const double scale : {1e-4, 1.0, 1e4}) {
    const double in_face = 0.01 * edge / std::sqrt(3.0), on_edge = 0.01 * edge * std::sqrt(3.0) / 2;
    EXPECT_EQ(without_redundant_points(scaled(with_raised_point_in_face(0.99 * in_face), scale), options).mesh.vertex_count(), 12U);
    EXPECT_EQ(without_redundant_points(scaled(with_raised_point_in_face(1.01 * in_face), scale), options).mesh.vertex_count(), 13U);
    EXPECT_EQ(without_redundant_points(scaled(with_raised_point_on_edge(0.98 * on_edge), scale), options).mesh.vertex_count(), 12U);
    EXPECT_EQ(without_redundant_points(scaled(with_raised_point_on_edge(1.03 * on_edge), scale), options).mesh.vertex_count(), 13U);
  }
}

TEST(RedundantPoints, LeavesATetrahedronAlone) {
  const auto [mesh, report] = without_redundant_points(tetrahedron(), {100, false});
  EXPECT_TRUE(is_same(mesh, tetrahedron()));
  EXPECT_EQ(report.valence3 + report.valence4, 0U);
  EXPECT_EQ(report.refused_link, 4U);
}

TEST(RedundantPoints, LeavesAMeshWithoutThemAsItIs) {
  for (const TriangleMesh& mesh : {icosphere(2), noisy(torus(1, 0.4, 20, 10), 0.1, 1), cube()}) {
    const auto [after, report] = without_redundant_points(mesh);
    EXPECT_TRUE(is_same(after, mesh));
    EXPECT_EQ(report.valence3 + report.valence4, 0U);
  }
}

TEST(RedundantPoints, NeverLeavesAVertexBelowValenceThree) {
  // With a tolerance as large as the mesh, everything of small valence is a candidate.
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    for (const TriangleMesh& start : {icosphere(1), torus(1, 0.4, 8, 5), octahedron(), cube()}) {
      const TriangleMesh mesh = noisy(relabelled(with_points_in_faces(start, seed), seed), 0.02, seed);
      const auto [after, report] = without_redundant_points(mesh, {1, false});
      SCOPED_TRACE(fmt::format("seed {}, {} vertices", seed, start.vertex_count()));
      EXPECT_GT(report.valence3, 0U);
      EXPECT_THAT(after, IsClosedManifold());
      EXPECT_EQ(euler_characteristic(after), euler_characteristic(mesh));
      const std::vector<std::size_t> valence = valences(after);
      EXPECT_GE(*std::min_element(valence.begin(), valence.end()), 3U);
      EXPECT_EQ(mesh.vertex_count() - after.vertex_count(), report.valence3 + report.valence4);
      EXPECT_TRUE(!intersecting_pairs(mesh).empty() || intersecting_pairs(after).empty());
    }
  }
}

/// Vertex 4 a hundredth above the middle of 0–1, the diagonal of its ring 0-2-1-3; below, what `rest` says.
TriangleMesh roof(std::vector<Triangle> rest) {
  TriangleMesh mesh{{{-1, 0, 0}, {1, 0, 0}, {0, 1, -0.2}, {0, -1, -0.2}, {0, 0, 0.01}, {0, 0.3, -1}, {0, -0.3, -1}},
                    {{4, 1, 2}, {4, 2, 0}, {4, 0, 3}, {4, 3, 1}}};
  mesh.triangles.insert(mesh.triangles.end(), rest.begin(), rest.end());
  return mesh;
}

TEST(RedundantPoints, RefusesADiagonalThatExistsAlready) {
  const RedundantPointOptions options{0.05, false};
  // Closed by two more points that are joined to each other: the ridge 0–1 is free.
  const TriangleMesh free = roof({{0, 2, 5}, {2, 1, 5}, {1, 3, 6}, {3, 0, 6}, {5, 1, 6}, {0, 5, 6}});
  ASSERT_THAT(free, IsClosedManifold());
  EXPECT_EQ(without_redundant_points(free, options).report.valence4, 1U);
  // Closed by two pyramids on either side of an edge 0–1 of their own.
  const TriangleMesh taken = roof({{0, 2, 5}, {2, 1, 5}, {1, 0, 5}, {1, 3, 6}, {3, 0, 6}, {0, 1, 6}});
  ASSERT_THAT(taken, IsClosedManifold());
  const auto [after, report] = without_redundant_points(taken, options);
  EXPECT_EQ(report.valence4, 0U);
  EXPECT_EQ(report.refused_link, 1U);
  EXPECT_EQ(after.triangles, taken.triangles);
}

TEST(RedundantPoints, RefusesANewTriangleThatWouldTouchACorner) {
  // The cube's triangle (0, 0, 1), (1, 1, 1), (0, 1, 1) with a raised point; a component inside the cube reaches up to the triangle.
  TriangleMesh raised = cube();
  const auto face = std::find(raised.triangles.begin(), raised.triangles.end(), Triangle{4, 7, 6});
  ASSERT_NE(face, raised.triangles.end());
  raised.points.emplace_back(0.3, 0.7, 1.01);
  *face = {4, 7, 8};
  raised.triangles.insert(raised.triangles.end(), {{7, 6, 8}, {6, 4, 8}});
  const TriangleMesh diamond = translated(scaled(octahedron(), 0.125), {0.25, 0.75, 0.875});
  const RedundantPointOptions options{0.05, false};
  EXPECT_EQ(without_redundant_points(joined(raised, diamond), options).report.valence3, 0U);
  EXPECT_EQ(without_redundant_points(joined(raised, translated(diamond, {0, 0, -std::ldexp(1, -40)})), options).report.valence3, 1U);
}

TEST(RedundantPoints, RefusesANewTriangleThatWouldHitAnotherSheet) {
  // A component's corner reaches into the hollow between the raised point and its face.
  const TriangleMesh raised = with_raised_point_in_face(0.3);
  const auto [a, b, c] = icosphere(0).triangles.front();
  const Vec3 face = (raised.points[a] + raised.points[b] + raised.points[c]) / 3;
  const RedundantPointOptions options{0.5, false};
  EXPECT_EQ(without_redundant_points(raised, options).report.valence3, 1U);
  const TriangleMesh inside_across = joined(raised, icosphere(0, 0.05, face));  // one half above the face, one below it
  ASSERT_THAT(inside_across, HasNoIntersections());
  const auto [after, report] = without_redundant_points(inside_across, options);
  EXPECT_EQ(report.valence3, 0U);
  EXPECT_EQ(report.refused_meet, 1U);
  EXPECT_TRUE(is_same(after, inside_across));
}

TEST(RedundantPoints, RefusesToSweepOverAComponentThatNothingTouchesAfterwards) {
  for (const double height : {0.3, -0.3}) {  // the speck would be let out, or swallowed
    const TriangleMesh raised = with_raised_point_in_face(height);
    const auto [a, b, c] = icosphere(0).triangles.front();
    const Vec3 face = (raised.points[a] + raised.points[b] + raised.points[c]) / 3;
    const TriangleMesh mesh = joined(raised, icosphere(0, 0.01, 0.6 * raised.points[12] + 0.4 * face));
    ASSERT_THAT(mesh, HasNoIntersections());
    const Vec3 speck = mesh.points.back();
    const double winding = winding_number(raised, speck);
    ASSERT_NEAR(winding, height > 0 ? 1 : 0, 1e-6);
    ASSERT_NEAR(winding_number(without_redundant_points(raised, {0.5, false}).mesh, speck), height > 0 ? 0 : 1, 1e-6);
    const auto [after, report] = without_redundant_points(mesh, {0.5, false});
    EXPECT_EQ(report.valence3, 0U);
    EXPECT_EQ(report.refused_meet, 1U);
  }
}

TEST(RedundantPoints, RefusesToSweepOverAComponentOnAnEdge) {
  const TriangleMesh raised = with_raised_point_on_edge(0.2);
  const Vec3 top = raised.points[12];
  EXPECT_EQ(without_redundant_points(raised, {0.3, false}).report.valence4, 1U);
  const TriangleMesh mesh = joined(raised, icosphere(0, 0.01, 0.9 * top));
  ASSERT_THAT(mesh, HasNoIntersections());
  EXPECT_EQ(without_redundant_points(mesh, {0.3, false}).report.valence4, 0U);
}

class ManyPoints : public ::testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(RedundantPoints, ManyPoints, ::testing::Range(1U, 3U));

TEST_P(ManyPoints, InFacesAndOnEdgesAreAllRemovedInAnyOrderOfTheVertices) {
  for (const TriangleMesh& original : {icosphere(3), noisy(torus(1, 0.4, 40, 20), 0.01, GetParam())}) {
    const std::size_t faces = original.triangle_count(), edges = faces * 3 / 2;
    const TriangleMesh in_faces = with_points_in_faces(original, GetParam()), on_edges = with_points_on_edges(original, GetParam());
    ASSERT_EQ(on_edges.vertex_count(), original.vertex_count() + edges);
    for (const bool has_other_order : {false, true}) {
      SCOPED_TRACE(fmt::format("seed {}, {} faces, other order {}", GetParam(), faces, has_other_order));
      const auto order = [&](const TriangleMesh& mesh) { return has_other_order ? relabelled(mesh, GetParam()) : mesh; };
      const Outcome a = without_redundant_points(order(in_faces)), b = without_redundant_points(order(on_edges));
      EXPECT_EQ(a.report.valence3, faces);
      EXPECT_EQ(a.report.valence4, 0U);
      EXPECT_EQ(b.report.valence3, 0U);
      EXPECT_EQ(b.report.valence4, edges);
      for (const TriangleMesh& mesh : {a.mesh, b.mesh}) {
        EXPECT_EQ(mesh.vertex_count(), original.vertex_count());
        EXPECT_THAT(mesh, IsClosedManifold());
        EXPECT_THAT(mesh, HasNoIntersections());
        EXPECT_NEAR(enclosed_volume(mesh), enclosed_volume(original), 1e-12);
        EXPECT_NEAR(surface_area(mesh), surface_area(original), 1e-11);
      }
    }
  }
}

TEST_P(ManyPoints, OnEdgesOfFacesWithPointsAreRemovedToo) {
  const TriangleMesh original = icosphere(2);
  const TriangleMesh mesh = relabelled(with_points_on_edges(with_points_in_faces(original, GetParam()), GetParam()), GetParam());
  const auto [after, report] = without_redundant_points(mesh);
  EXPECT_EQ(after.vertex_count(), original.vertex_count()) << "seed " << GetParam();
  EXPECT_NEAR(enclosed_volume(after), enclosed_volume(original), 1e-12);
}

TEST_P(ManyPoints, LeaveNothingForASecondRun) {
  for (const double tolerance : {1e-4, 0.01, 0.1}) {
    const TriangleMesh mesh = noisy(with_points_on_edges(with_points_in_faces(icosphere(2), GetParam()), GetParam()), 0.01, GetParam());
    const Outcome first = without_redundant_points(mesh, {tolerance, false});
    const Outcome second = without_redundant_points(first.mesh, {tolerance, false});
    EXPECT_EQ(second.report.valence3 + second.report.valence4, 0U) << "seed " << GetParam() << ", tolerance " << tolerance;
    EXPECT_TRUE(is_same(first.mesh, second.mesh));
    EXPECT_EQ(first.report.refused_link, second.report.refused_link);
    EXPECT_EQ(first.report.refused_meet, second.report.refused_meet);
  }
}

TEST_P(ManyPoints, NeverCreateAnIntersectingPairHoweverLargeTheTolerance) {
  for (const double tolerance : {0.1, 10.0}) {
    for (const TriangleMesh& start : {icosphere(2), plates_on_a_noisy_sheet(1e-9, GetParam())}) {
      const TriangleMesh mesh = with_points_on_edges(with_points_in_faces(start, GetParam()), GetParam());
      for (const double amplitude : {0.0, 0.02}) {
        const TriangleMesh rough = noisy(mesh, amplitude, GetParam());
        if (!intersecting_pairs(rough).empty()) continue;
        const auto [after, report] = without_redundant_points(relabelled(rough, GetParam()), {tolerance, false});
        SCOPED_TRACE(fmt::format("seed {}, tolerance {}, noise {}, {} vertices", GetParam(), tolerance, amplitude, start.vertex_count()));
        EXPECT_THAT(after, HasNoIntersections());
        EXPECT_THAT(after, IsClosedManifold());
        EXPECT_EQ(euler_characteristic(after), euler_characteristic(start));
        EXPECT_GT(report.valence3 + report.valence4, 0U);
      }
    }
  }
}

/// The report and the mesh of `remove_redundant_points` for a number of threads.
Outcome with_threads(std::size_t threads, const TriangleMesh& mesh, const RedundantPointOptions& options) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  return without_redundant_points(mesh, options);
}

TEST(RedundantPoints, AreTheSameForAnyNumberOfThreads) {
  const TriangleMesh base = noisy(torus(10, 3, 120, 60), 0.02, 4);
  const TriangleMesh mesh = noisy(relabelled(with_points_on_edges(with_points_in_faces(base, 4), 4), 4), 0.002, 4);
  const RedundantPointOptions options{0.004, false};
  const Outcome one = with_threads(1, mesh, options);
  EXPECT_GT(one.report.valence3, 100U);
  EXPECT_GT(one.report.valence4, 100U);
  for (const std::size_t threads : {2, 3, 8}) {
    const Outcome other = with_threads(threads, mesh, options);
    EXPECT_TRUE(is_same(other.mesh, one.mesh)) << threads << " threads";
    EXPECT_EQ(other.report.valence3, one.report.valence3);
    EXPECT_EQ(other.report.valence4, one.report.valence4);
    EXPECT_EQ(other.report.refused_link, one.report.refused_link);
    EXPECT_EQ(other.report.refused_meet, one.report.refused_meet);
    EXPECT_EQ(other.report.passes, one.report.passes);
  }
}

TEST(RedundantPoints, StopsWithCancelledWhenTheCallbackSaysSo) {
  TriangleMesh mesh = with_points_in_faces(icosphere(1), 1);
  EXPECT_THROW(remove_redundant_points(mesh, {}, [](std::string_view, double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace smopt
