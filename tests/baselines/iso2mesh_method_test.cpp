#include "baselines/iso2mesh/iso2mesh_method.h"

#include <gmock/gmock.h>

#include "baselines/hc.h"
#include "baselines/iso2mesh/smoothsurf.h"
#include "baselines/laplacian.h"
#include "smopt/error.h"
#include "smopt/io/mesh_io.h"
#include "tests/baselines/method_run.h"
#include "tests/support/files.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TriangleMesh smoothed(TriangleMesh mesh, const SmoothsurfOptions& options) {
  smoothsurf(mesh, options);
  return mesh;
}

MethodResult run(TriangleMesh mesh, const std::map<std::string, std::string>& given) {
  return run_method(iso2mesh_method(), std::move(mesh), given);
}

TEST(Smoothsurf, RoundOfATetrahedronByHand) {
  // A step of weight w multiplies by 1 − 4w/3. laplacian: w = 0.3; lowpass: 0.3, then −0.306; laplacianhc from the original p:
  // m = −p/3, b = −4p/3, p' = m − (½ b + ½ (−b/3)) = p/9, whatever α.
  const std::pair<SmoothsurfMethod, double> cases[] = {
      {SmoothsurfMethod::laplacian, 0.6}, {SmoothsurfMethod::lowpass, 0.6 * 1.408}, {SmoothsurfMethod::laplacianhc, 1.0 / 9}};
  for (const auto& [method, factor] : cases) {
    const TriangleMesh after = smoothed(tetrahedron(), {method, 1, 0.3});
    for (std::size_t v = 0; v < 4; ++v) EXPECT_LT((after.points[v] - factor * tetrahedron().points[v]).norm(), 1e-15);
  }
}

TEST(Smoothsurf, PullsHcToTheOriginalByAlpha) {
  const TriangleMesh mesh = noisy(icosphere(1), 0.1, 3);
  TriangleMesh by_hc = mesh;
  smooth_hc(by_hc, {7, 0.3, 0.5});
  EXPECT_EQ(smoothed(mesh, {SmoothsurfMethod::laplacianhc, 7, 0.3}).points, by_hc.points);
}

TEST(Smoothsurf, SaysWhenItDiverges) {
  // Lowpass with α = 3: (1 − 4)(1 + 4.08) = −15.24 a round; ten diagonals of the box are 34.6, the corners at √3 · 15.24^k.
  TriangleMesh mesh = tetrahedron();
  EXPECT_EQ(smoothsurf(mesh, {SmoothsurfMethod::lowpass, 5, 3}), 2);
}

TEST(Iso2meshMethod, SmoothsAsThePaperDidByDefault) {
  const TriangleMesh mesh = noisy(icosphere(2), 0.03, 3);
  const MethodResult by_default = run(mesh, {});
  TriangleMesh by_hand = mesh;
  smooth_laplacian(by_hand, {100, 0.5, SweepOrder::jacobi});
  EXPECT_EQ(by_default.mesh.points, by_hand.points);
  EXPECT_EQ(by_default.mesh.triangles, mesh.triangles);
  EXPECT_THAT(by_default.report.notes, IsEmpty());
  EXPECT_EQ(by_default.report.rounds_run, 100U);
}

TEST(Iso2meshMethod, ResamplesToTheNumberOfVertices) {
  for (const char* placement : {"midpoint", "lindstrom-turk"}) {
    const MethodResult result = run(noisy(icosphere(4), 0.01, 3), {{"vertices", "2000"}, {"placement", placement}, {"rounds", "3"}});
    EXPECT_NEAR(static_cast<double>(result.mesh.vertex_count()), 2000, 2) << placement;
    EXPECT_THAT(result.mesh, IsClosedManifold());
    EXPECT_THAT(result.report.notes, ElementsAre(HasSubstr("resampled from 2562 to 200")));
    EXPECT_EQ(result.report.seconds.front().first, "resampling");
    EXPECT_EQ(result.report.seconds.back().first, "smoothing");
  }
}

TEST(Iso2meshMethod, MatchesTheVerticesOfAnotherMesh) {
  const TemporaryFolder folder;
  write_mesh(folder.path() / "other.off", icosphere(2));
  const MethodResult result = run(icosphere(3), {{"match", (folder.path() / "other.off").string()}, {"rounds", "1"}});
  EXPECT_EQ(result.mesh.vertex_count(), 162U);
}

TEST(Iso2meshMethod, DoesNotRefine) {
  const MethodResult result = run(icosphere(1), {{"vertices", "100"}, {"rounds", "0"}});
  EXPECT_EQ(result.mesh.points, icosphere(1).points);
  EXPECT_THAT(result.report.notes, ElementsAre(HasSubstr("not resampled: 100 vertices were asked for, and the mesh has 42")));
}

TEST(Iso2meshMethod, RoundsAResampledMeshAsItsTextFileDoes) {
  const auto is_rounded = [](const TriangleMesh& mesh) {
    for (const Vec3& p : mesh.points)
      for (const double x : p)
        if (std::abs(x) > 0.1 && std::abs(x * 1e6 - std::round(x * 1e6)) > 1e-9) return false;
    return true;
  };
  const TriangleMesh mesh = noisy(icosphere(3, 0.9), 0.01, 3);
  EXPECT_TRUE(is_rounded(run(mesh, {{"vertices", "500"}, {"rounds", "0"}}).mesh));
  EXPECT_FALSE(is_rounded(run(mesh, {{"vertices", "500"}, {"rounds", "0"}, {"resample-digits", "0"}}).mesh));
}

TEST(Iso2meshMethod, RefusesTwoTargets) {
  EXPECT_THROW(run(icosphere(1), {{"vertices", "20"}, {"match", "other.off"}}), InvalidOption);
}

}  // namespace
}  // namespace smopt::baselines
