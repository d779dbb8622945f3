#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/cli/smopt_program.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The keys that other programs rely on (a key is never renamed).
const json kContract = json::parse(R"(
{"vertices": 0, "triangles": 0, "edges": 0, "components": 0, "euler_characteristic": 0, "genus": 0,
 "closed": true, "edge_manifold": true, "vertex_manifold": true, "oriented": true,
 "isolated_vertices": 0, "duplicate_vertices": 0, "degenerate_triangles": 0, "nonfinite_vertices": 0,
 "intersecting_pairs": 0, "area": 0.0, "volume": 0.0,
 "edge_ratio": {"min": 0.0, "mean": 0.0, "median": 0.0, "below_0.1": 0.0, "histogram": {"edges": [], "counts": []}},
 "angle_deg": {"min": 0.0, "max": 0.0, "mean_min": 0.0, "histogram": {"edges": [], "counts": []}},
 "min_angle_share": {"below_5": 0.0, "below_10": 0.0, "below_20": 0.0, "below_30": 0.0},
 "max_angle_share": {"above_120": 0.0, "above_150": 0.0},
 "valence": {"min": 0, "max": 0, "share_6": 0.0, "share_5_6_7": 0.0}})");

TEST(Measure, JsonHasTheKeysOfTheContract) {
  const TemporaryFolder folder;
  const ProgramResult r = run_smopt({"measure", "--json", put_mesh(folder, "sphere.off", icosphere(2))});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.err, IsEmpty());
  EXPECT_EQ(why_not_shaped_like(kContract, json::parse(r.out)), "");
}

TEST(Measure, TellsAKnownTorus) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = torus(3, 1, 40, 20);
  const json m = json::parse(run_smopt({"measure", put_mesh(folder, "torus.ply", mesh), "--json"}).out);
  EXPECT_EQ(m["vertices"], 800);
  EXPECT_EQ(m["triangles"], 1600);
  EXPECT_EQ(m["edges"], 2400);
  EXPECT_EQ(m["components"], 1);
  EXPECT_EQ(m["euler_characteristic"], 0);
  EXPECT_EQ(m["genus"], 1);
  EXPECT_EQ(m["closed"], true);
  EXPECT_EQ(m["intersecting_pairs"], 0);
  EXPECT_NEAR(m["area"].get<double>(), surface_area(mesh), 1e-9);
  EXPECT_NEAR(m["volume"].get<double>(), enclosed_volume(mesh), 1e-9);
  EXPECT_EQ(m["valence"]["share_6"], 1.0);
}

TEST(Measure, SeveralMeshesAreAnArrayInTheirOrder) {
  const TemporaryFolder folder;
  const std::string first = put_mesh(folder, "a.off", tetrahedron());
  const std::string second = put_mesh(folder, "b.off", cube());
  const json both = json::parse(run_smopt({"measure", first, second, "--json"}).out);
  ASSERT_TRUE(both.is_array());
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0]["triangles"], 4);
  EXPECT_EQ(both[1]["triangles"], 12);
}

TEST(Measure, TheTableHasTheMeshesAsColumns) {
  const TemporaryFolder folder;
  const ProgramResult r = run_smopt({"measure", put_mesh(folder, "a.off", tetrahedron()), put_mesh(folder, "b.off", cube())});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  const std::string header = r.out.substr(0, r.out.find('\n'));
  EXPECT_LT(header.find("a.off"), header.find("b.off"));
  EXPECT_THAT(header, HasSubstr("b.off"));
  EXPECT_THAT(r.out, ::testing::ContainsRegex("triangles +4 +12\n"));
  EXPECT_THAT(r.out, ::testing::ContainsRegex("closed +yes +yes\n"));
}

TEST(Measure, CountsIntersectingPairs) {
  const TemporaryFolder folder;
  const json m = json::parse(run_smopt({"measure", "--json", put_mesh(folder, "crossing.off", crossing_spheres())}).out);
  EXPECT_GT(m["intersecting_pairs"].get<int>(), 10);
  EXPECT_EQ(m["components"], 2);
}

TEST(Measure, AReferenceAddsTheDistanceToIt) {
  const TemporaryFolder folder;
  const std::string sphere = put_mesh(folder, "sphere.off", icosphere(3));
  const std::string moved = put_mesh(folder, "moved.off", translated(icosphere(3), {0.25, 0, 0}));
  const json m = json::parse(run_smopt({"measure", "--json", moved, "--reference", sphere}).out);
  ASSERT_TRUE(m.contains("distance")) << m;
  EXPECT_NEAR(m["distance"]["hausdorff"].get<double>(), 0.25, 0.01);
  EXPECT_NEAR(json::parse(run_smopt({"measure", "--json", sphere, "--reference", sphere}).out)["distance"]["hausdorff"].get<double>(), 0,
              1e-12);
}

TEST(Measure, ReadsAPipe) {
  const ProgramResult r = run_smopt({"measure", "-", "--json"}, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const json m = json::parse(r.out);
  EXPECT_EQ(m["area"], 0.5);
  EXPECT_EQ(m["closed"], false);
  EXPECT_TRUE(m["volume"].is_null());
  EXPECT_FALSE(m["notes"].empty());
}

TEST(Measure, AnEmptyMeshOfNoTrianglesIsMeasured) {
  const ProgramResult r = run_smopt({"measure", "-", "--json"}, "OFF\n0 0 0\n");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(json::parse(r.out)["triangles"], 0);
}

}  // namespace
}  // namespace smopt::testing
