#include "smopt/improve/prepare.h"

#include <cmath>
#include <limits>
#include <string>

#include "smopt/error.h"
#include "tests/improve/judge.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace smopt::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// What `prepare` says about a mesh that it cannot use; empty when it takes it.
std::string complaint_about(TriangleMesh mesh) {
  const TriangleMesh original = mesh;
  try {
    prepare(mesh, CavityPolicy::keep);
  } catch (const InvalidMesh& error) {
    EXPECT_EQ(mesh.triangles, original.triangles) << "changed all the same";
    return error.what();
  }
  return {};
}

TEST(Prepare, LeavesAValidMeshAsItIs) {
  TriangleMesh mesh = torus(2, 0.5, 20, 10);
  const PreparationReport report = prepare(mesh, CavityPolicy::delete_cavities);
  EXPECT_TRUE(is_same(mesh, torus(2, 0.5, 20, 10)));
  EXPECT_FALSE(report.was_inward);
  EXPECT_EQ(report.turned_triangles, 0U);
  EXPECT_EQ(report.isolated_vertices, 0U);
  EXPECT_EQ(report.cavities.components, 1U);
}

TEST(Prepare, TurnsAnInwardMeshAndLosesNothing) {
  // As TMSmesh writes it: all of it inside out, with a cavity and two outer components.
  const TriangleMesh outward = joined(joined(icosphere(2, 10), reversed(icosphere(1, 3))), icosphere(1, 2, {20, 0, 0}));
  for (const CavityPolicy policy : {CavityPolicy::keep, CavityPolicy::delete_cavities}) {
    TriangleMesh mesh = reversed(outward), expected = outward;
    const PreparationReport report = prepare(mesh, policy);
    remove_cavities(expected, policy);
    EXPECT_TRUE(report.was_inward);
    EXPECT_TRUE(is_same(mesh, expected));
    EXPECT_GT(enclosed_volume(mesh), 0);
    EXPECT_EQ(report.cavities.cavities, policy == CavityPolicy::keep ? 0U : 1U);
  }
}

TEST(Prepare, IsOrientedByTheLargestComponentNotTheFirst) {
  TriangleMesh mesh = joined(reversed(icosphere(1, 1, {20, 0, 0})), icosphere(1, 5));
  EXPECT_FALSE(prepare(mesh, CavityPolicy::keep).was_inward);
  mesh = joined(icosphere(1, 1, {20, 0, 0}), reversed(icosphere(1, 5)));
  EXPECT_TRUE(prepare(mesh, CavityPolicy::keep).was_inward);
}

TEST(Prepare, TurnsTrianglesThatDisagreeWithTheirNeighbours) {
  for (const std::vector<FaceId>& flipped : {std::vector<FaceId>{5}, {0}, {0, 1, 2, 3, 40, 79}}) {
    TriangleMesh mesh = icosphere(1);
    for (const FaceId f : flipped) std::swap(mesh.triangles[f][0], mesh.triangles[f][1]);
    const PreparationReport report = prepare(mesh, CavityPolicy::keep);
    EXPECT_THAT(mesh, IsClosedManifold());
    EXPECT_NEAR(enclosed_volume(mesh), enclosed_volume(icosphere(1)), 1e-12);
    EXPECT_GT(report.turned_triangles, 0U);
  }
}

TEST(Prepare, RemovesIsolatedVertices) {
  TriangleMesh mesh = icosphere(1);
  mesh.points.insert(mesh.points.begin(), {5, 5, 5});
  mesh.points.push_back({6, 6, 6});
  for (Triangle& t : mesh.triangles) t = {t[0] + 1, t[1] + 1, t[2] + 1};
  const PreparationReport report = prepare(mesh, CavityPolicy::keep);
  EXPECT_EQ(report.isolated_vertices, 2U);
  EXPECT_TRUE(is_same(mesh, icosphere(1)));
}

TEST(Prepare, NamesItsStages) {
  TriangleMesh mesh = icosphere(1);
  const StageTimes seconds = prepare(mesh, CavityPolicy::keep).seconds;
  ASSERT_EQ(seconds.size(), 2U);
  EXPECT_EQ(seconds[0].first, "validity");
  EXPECT_EQ(seconds[1].first, "cavities");
}

// ---- Meshes that cannot be used: the message names the place ----

TEST(Prepare, RejectsCoordinatesThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = icosphere(1);
    mesh.points[17][1] = bad;
    EXPECT_THAT(complaint_about(mesh), AllOf(HasSubstr("vertex 17"), HasSubstr("not finite")));
  }
}

TEST(Prepare, RejectsAnOpenMesh) {
  TriangleMesh mesh = icosphere(1);
  const auto [a, b, c] = mesh.triangles.back();
  mesh.triangles.pop_back();
  EXPECT_THAT(complaint_about(mesh),
              AllOf(HasSubstr("3 boundary edges"), HasSubstr(std::to_string(std::min(a, b)) + "-" + std::to_string(std::max(a, b)))));
}

TEST(Prepare, RejectsAnEdgeWithFourTriangles) {
  // Two tetrahedra on the common edge 0–1.
  TriangleMesh mesh = joined(tetrahedron(), translated(tetrahedron(), {5, 0, 0}));
  for (Triangle& t : mesh.triangles)
    for (VertexId& v : t) v = v == 4 ? 0 : (v == 5 ? 1 : v);
  EXPECT_THAT(complaint_about(mesh), AllOf(HasSubstr("non-manifold edge"), HasSubstr("0-1"), HasSubstr("4 faces")));
}

TEST(Prepare, RejectsAVertexWithTwoFans) {
  TriangleMesh mesh = joined(tetrahedron(), translated(tetrahedron(), {5, 0, 0}));
  for (Triangle& t : mesh.triangles)
    for (VertexId& v : t) v = v == 6 ? 2 : v;
  EXPECT_THAT(complaint_about(mesh), AllOf(HasSubstr("non-manifold vertices"), HasSubstr("vertex 2 with 2 fans")));
}

TEST(Prepare, RejectsDuplicateFaces) {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.push_back(mesh.triangles[7]);
  EXPECT_THAT(complaint_about(mesh), AllOf(HasSubstr("duplicate faces"), HasSubstr("faces 7 and 80")));
  std::swap(mesh.triangles.back()[0], mesh.triangles.back()[1]);
  EXPECT_THAT(complaint_about(mesh), HasSubstr("faces 7 and 80"));
}

TEST(Prepare, RejectsTwoFacesBackToBack) {
  EXPECT_THAT(complaint_about({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}), HasSubstr("faces 0 and 1"));
}

TEST(Prepare, RejectsATriangleWithARepeatedCorner) {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.push_back({3, 9, 3});
  EXPECT_THAT(complaint_about(mesh), AllOf(HasSubstr("repeated corner"), HasSubstr("face 80")));
  mesh = icosphere(1);
  mesh.triangles[4][1] = mesh.triangles[4][0];
  EXPECT_THAT(complaint_about(mesh), AllOf(HasSubstr("repeated corner"), HasSubstr("face 4 ")));
}

TEST(Prepare, RejectsAnEmptyMesh) {
  EXPECT_THAT(complaint_about({}), HasSubstr("no triangles"));
  EXPECT_THAT(complaint_about({{{0, 0, 0}, {1, 0, 0}}, {}}), HasSubstr("no triangles"));
}

TEST(Prepare, RejectsAOneSidedSurface) {
  // A Klein bottle: a torus whose second direction comes back reversed.
  constexpr VertexId kN = 6, kM = 6;
  TriangleMesh mesh;
  for (VertexId i = 0; i < kN * kM; ++i) mesh.points.emplace_back(i % kM, i / kM, std::sin(i));
  const auto id = [](VertexId i, VertexId j) { return i < kN ? i * kM + j % kM : (kM - j % kM) % kM; };
  for (VertexId i = 0; i < kN; ++i) {
    for (VertexId j = 0; j < kM; ++j) {
      mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  EXPECT_THAT(complaint_about(mesh), AllOf(HasSubstr("one-sided"), HasSubstr("edge")));
}

}  // namespace
}  // namespace smopt
