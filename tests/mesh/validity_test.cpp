#include "smopt/mesh/validity.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <map>
#include <regex>

#include "smopt/error.h"
#include "tests/mesh/meshes.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// The text has this number as a word of its own.
MATCHER_P(Names, number, fmt::format("names {}", number)) {
  return std::regex_search(arg, std::regex(fmt::format("(^|[^0-9]){}($|[^0-9])", number)));
}

/// The counts of a report by name, those that are not zero.
std::map<std::string, std::size_t> counts(const ValidityReport& report) {
  std::map<std::string, std::size_t> all = {
      {"nonfinite", report.nonfinite_vertices.count},    {"repeated", report.repeated_corners.count},
      {"boundary", report.boundary_edges.count},         {"nonmanifold edge", report.nonmanifold_edges.count},
      {"inconsistent", report.inconsistent_edges.count}, {"nonmanifold vertex", report.nonmanifold_vertices.count},
      {"duplicate", report.duplicate_faces.count},       {"isolated", report.isolated_vertices}};
  std::erase_if(all, [](const auto& entry) { return entry.second == 0; });
  return all;
}
using Counts = std::map<std::string, std::size_t>;

/// The report says so in every way: no closed manifold, the exception carries the description, and that names the place.
void expect_rejected(const ValidityReport& report) {
  EXPECT_FALSE(report.is_closed_manifold());
  EXPECT_THAT(report.describe(), Not(IsEmpty()));
  try {
    require_closed_manifold(report);
    FAIL() << "no exception";
  } catch (const InvalidMesh& error) {
    EXPECT_THAT(error.what(), HasSubstr(report.describe()));
  }
}

TEST(Validity, ClosedManifoldsHaveNoFault) {
  for (const TriangleMesh& mesh :
       {tetrahedron(), cube(), icosphere(3), torus(3, 1, 20, 9), joined(icosphere(2), reversed(icosphere(1, 0.5))), bipyramid(1000),
        reversed(cube()), relabelled(torus(3, 1, 20, 9), 5)}) {
    ASSERT_THAT(mesh, IsClosedManifold());
    const ValidityReport report = check_validity(mesh);
    EXPECT_TRUE(report.is_closed_manifold());
    EXPECT_TRUE(report.is_oriented());
    EXPECT_FALSE(report.is_empty);
    EXPECT_EQ(counts(report), Counts{});
    EXPECT_EQ(report.describe(), "");
    EXPECT_NO_THROW(require_closed_manifold(report));
  }
}

TEST(Validity, AnEmptyMeshIsNoSurface) {
  for (const TriangleMesh& mesh : {TriangleMesh{}, TriangleMesh{{{0, 0, 0}, {1, 1, 1}}, {}}}) {
    const ValidityReport report = check_validity(mesh);
    EXPECT_TRUE(report.is_empty);
    EXPECT_EQ(report.isolated_vertices, mesh.vertex_count());
    expect_rejected(report);
  }
}

TEST(Validity, CoordinatesThatAreNotFiniteAreNamed) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, -HUGE_VAL}) {
    for (int axis = 0; axis < 3; ++axis) {
      TriangleMesh mesh = icosphere(1);
      mesh.points[37][axis] = bad;
      const ValidityReport report = check_validity(mesh);
      EXPECT_EQ(counts(report), (Counts{{"nonfinite", 1}}));
      EXPECT_THAT(report.describe(), Names(37));
      expect_rejected(report);
    }
  }
}

TEST(Validity, AMissingTriangleOpensThreeEdges) {
  TriangleMesh mesh = icosphere(1);
  const Triangle missing = mesh.triangles[50];
  mesh.triangles.erase(mesh.triangles.begin() + 50);
  const ValidityReport report = check_validity(mesh);
  EXPECT_EQ(counts(report), (Counts{{"boundary", 3}}));
  EXPECT_THAT(report.describe(), AllOf(Names(missing[0]), Names(missing[1]), Names(missing[2])));
  expect_rejected(report);
}

TEST(Validity, AFinOnAnEdgeIsANonManifoldEdge) {
  TriangleMesh mesh = icosphere(1);
  const auto tip = static_cast<VertexId>(mesh.vertex_count());
  mesh.points.emplace_back(3, 3, 3);
  const auto [a, b, c] = mesh.triangles[50];
  mesh.triangles.push_back({a, b, tip});
  const ValidityReport report = check_validity(mesh);
  EXPECT_EQ(report.nonmanifold_edges.count, 1U);
  EXPECT_EQ(report.boundary_edges.count, 2U);
  ASSERT_EQ(report.nonmanifold_edges.examples.size(), 1U);
  EXPECT_THAT(report.nonmanifold_edges.examples[0], AllOf(Names(a), Names(b)));
  expect_rejected(report);
}

TEST(Validity, TwoClosedSurfacesAlongOneEdgeAreANonManifoldEdge) {
  // Two tetrahedra on the common edge 0–1: four triangles there, and closed all the same.
  TriangleMesh mesh = joined(tetrahedron(), tetrahedron());
  for (Triangle& t : mesh.triangles)
    for (VertexId& v : t) v = v == 4 ? 0 : (v == 5 ? 1 : v);
  const ValidityReport report = check_validity(mesh);
  EXPECT_EQ(report.nonmanifold_edges.count, 1U);
  EXPECT_EQ(report.boundary_edges.count, 0U);
  EXPECT_THAT(report.describe(), AllOf(Names(0), Names(1)));
  expect_rejected(report);
}

TEST(Validity, AFourfoldEdgeIsFoundWhateverTheOrder) {
  TriangleMesh mesh = joined(tetrahedron(), tetrahedron());
  for (Triangle& t : mesh.triangles)
    for (VertexId& v : t) v = v == 4 ? 0 : (v == 5 ? 1 : v);
  for (std::uint32_t seed = 0; seed < 200; ++seed)
    EXPECT_EQ(check_validity(relabelled(mesh, seed)).nonmanifold_edges.count, 1U) << "seed " << seed;
}

TEST(Validity, ABowTieIsANonManifoldVertex) {
  TriangleMesh mesh = joined(icosphere(1), translated(icosphere(1), {3, 0, 0}));
  for (Triangle& t : mesh.triangles) std::replace(t.begin(), t.end(), 42U, 17U);  // the second sphere's first vertex
  const ValidityReport report = check_validity(mesh);
  EXPECT_EQ(counts(report), (Counts{{"nonmanifold vertex", 1}, {"isolated", 1}}));
  EXPECT_THAT(report.describe(), Names(17));
  expect_rejected(report);
}

TEST(Validity, ADuplicateFaceIsNamedWhicheverWayItFaces) {
  for (const Triangle& order : {Triangle{0, 1, 2}, Triangle{1, 2, 0}, Triangle{2, 1, 0}}) {
    TriangleMesh mesh = icosphere(1);
    const Triangle t = mesh.triangles[50];
    mesh.triangles.push_back({t[order[0]], t[order[1]], t[order[2]]});
    const ValidityReport report = check_validity(mesh);
    EXPECT_EQ(report.duplicate_faces.count, 1U);
    ASSERT_EQ(report.duplicate_faces.examples.size(), 1U);
    EXPECT_THAT(report.duplicate_faces.examples[0], Names(80)) << "the later of the two";
    expect_rejected(report);
  }
}

TEST(Validity, TwoTrianglesBackToBackAreDuplicates) {
  const ValidityReport report = check_validity({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}});
  EXPECT_EQ(report.duplicate_faces.count, 1U) << "closed, but flat";
  expect_rejected(report);
}

TEST(Validity, AFlippedTriangleIsInconsistentOnly) {
  TriangleMesh mesh = icosphere(1);
  std::swap(mesh.triangles[50][0], mesh.triangles[50][1]);
  const ValidityReport report = check_validity(mesh);
  EXPECT_EQ(counts(report), (Counts{{"inconsistent", 3}}));
  EXPECT_FALSE(report.is_oriented());
  EXPECT_TRUE(report.is_closed_manifold()) << "it can be mended";
  const auto [a, b, c] = mesh.triangles[50];
  EXPECT_THAT(report.describe(), AllOf(Names(a), Names(b), Names(c)));
  EXPECT_NO_THROW(require_closed_manifold(report));
}

TEST(Validity, AKleinBottleIsClosedAndInconsistent) {
  const ValidityReport report = check_validity(closed_lattice(6, 5, true));
  EXPECT_TRUE(report.is_closed_manifold());
  EXPECT_FALSE(report.is_oriented());
  EXPECT_TRUE(check_validity(closed_lattice(6, 5, false)).is_oriented()) << "the untwisted one is a torus";
}

TEST(Validity, ARepeatedCornerIsNamed) {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.push_back({9, 9, 11});
  const ValidityReport report = check_validity(mesh);
  EXPECT_EQ(report.repeated_corners.count, 1U);
  EXPECT_THAT(report.repeated_corners.examples.at(0), Names(80));
  expect_rejected(report);
}

TEST(Validity, IsolatedVerticesAreCountedAndHarmless) {
  TriangleMesh mesh = cube();
  mesh.points.insert(mesh.points.end(), 5, Vec3(9, 9, 9));
  const ValidityReport report = check_validity(mesh);
  EXPECT_EQ(counts(report), (Counts{{"isolated", 5}}));
  EXPECT_TRUE(report.is_closed_manifold());
  EXPECT_NO_THROW(require_closed_manifold(report));
}

TEST(Validity, ShowsTheFirstPlacesOnlyAndCountsAll) {
  TriangleMesh mesh = icosphere(2);
  for (const VertexId v : {5, 15, 25, 35, 45}) mesh.points[v].y() = HUGE_VAL;
  const ValidityReport report = check_validity(mesh);
  EXPECT_EQ(report.nonfinite_vertices.count, 5U);
  EXPECT_EQ(report.nonfinite_vertices.examples.size(), kMaxFaultExamples);
  EXPECT_THAT(report.describe(), AllOf(Names(5), Names(15), Names(25), Not(Names(45))));
}

TEST(Validity, SeveralFaultsAreAllDescribed) {
  TriangleMesh mesh = joined(icosphere(1), translated(icosphere(1), {3, 0, 0}));
  mesh.points[3].x() = HUGE_VAL;
  mesh.triangles.pop_back();
  mesh.triangles.push_back(mesh.triangles[20]);
  const ValidityReport report = check_validity(mesh);
  EXPECT_EQ(report.nonfinite_vertices.count, 1U);
  EXPECT_EQ(report.boundary_edges.count, 3U);
  EXPECT_EQ(report.duplicate_faces.count, 1U);
  EXPECT_THAT(report.describe(), HasSubstr("; "));
}

TEST(Validity, CountsDoNotDependOnTheOrder) {
  TriangleMesh mesh = joined(icosphere(1), translated(icosphere(1), {3, 0, 0}));
  for (Triangle& t : mesh.triangles) std::replace(t.begin(), t.end(), 42U, 17U);
  mesh.points[3].x() = HUGE_VAL;
  mesh.triangles.pop_back();
  mesh.triangles.push_back(mesh.triangles[20]);
  std::swap(mesh.triangles[60][0], mesh.triangles[60][1]);
  const Counts expected = counts(check_validity(mesh));
  EXPECT_GE(expected.size(), 5U);
  for (std::uint32_t seed = 1; seed <= 10; ++seed) EXPECT_EQ(counts(check_validity(relabelled(mesh, seed))), expected) << "seed " << seed;
}

TEST(Validity, AVertexOfAHundredThousandTrianglesTakesNoTime) {
  TriangleMesh mesh = relabelled(bipyramid(100000), 2);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(check_validity(mesh).is_closed_manifold());
  mesh.triangles.pop_back();
  EXPECT_EQ(check_validity(mesh).boundary_edges.count, 3U);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20)) << "quadratic in the valence";
}

}  // namespace
}  // namespace smopt
