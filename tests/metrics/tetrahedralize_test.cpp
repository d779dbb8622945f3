#include "metrics/tetgen/tetrahedralize.h"

#include <gmock/gmock.h>
#include <stdlib.h>

#include <chrono>
#include <filesystem>
#include <limits>
#include <string>

#include "metrics/tetgen/verification.h"
#include "smopt/error.h"
#include "tests/support/files.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt::metrics {
namespace {

using namespace smopt::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Sets an environment variable for a scope.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* old = getenv(name)) old_ = old;
    setenv(name, value.c_str(), 1);
  }
  ~Environment() {
    if (old_)
      setenv(name_, old_->c_str(), 1);
    else
      unsetenv(name_);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

/// A shell script in the worker's place.
class FakeWorker {
 public:
  explicit FakeWorker(const std::string& script)
      : path_(folder_.file("worker", "#!/bin/sh\n" + script + "\n")), variable_("SMOPT_TETGEN_WORKER", path_) {
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all);
  }

 private:
  TemporaryFolder folder_;
  std::filesystem::path path_;
  Environment variable_;
};

Tetrahedralization run(const TriangleMesh& mesh, const std::string& switches = "p") {
  return tetrahedralize(mesh, {.switches = switches});
}

double volume_sum(const TetMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c, d] : mesh.tetrahedra) {
    const Vec3& o = mesh.points[a];
    sum += std::abs((mesh.points[b] - o).dot((mesh.points[c] - o).cross(mesh.points[d] - o))) / 6;
  }
  return sum;
}

/// The unit cube whose bottom has two more points, `gap` apart, in its middle.
TriangleMesh cube_with_near_points(double gap) {
  TriangleMesh mesh = cube();
  mesh.points.emplace_back(0.5, 0.5, 0);
  mesh.points.emplace_back(0.5 + gap, 0.5, 0);
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 2);
  for (const Triangle& t : {Triangle{0, 2, 8}, {2, 3, 9}, {2, 9, 8}, {3, 1, 9}, {1, 0, 8}, {1, 8, 9}}) mesh.triangles.push_back(t);
  return mesh;
}

TEST(Tetrahedralize, FillsASphere) {
  const TriangleMesh sphere = icosphere(3, 10);
  for (const std::string switches : {"p", "pY"}) {
    SCOPED_TRACE(switches);
    const Tetrahedralization r = run(sphere, switches);
    EXPECT_TRUE(r.success) << r.reason;
    EXPECT_EQ(r.code, 0);
    EXPECT_EQ(r.switches, switches);
    EXPECT_GT(r.tetrahedra, sphere.vertex_count());
    EXPECT_EQ(r.mesh.tetrahedra.size(), r.tetrahedra);
    EXPECT_NEAR(volume_sum(r.mesh), enclosed_volume(sphere), 1e-9 * enclosed_volume(sphere));
    EXPECT_GT(r.peak_memory_mb, 1);
    EXPECT_GT(r.seconds, 0);
    EXPECT_THAT(r.tetgen_version, StartsWith("1.5"));
  }
}

TEST(Tetrahedralize, QualitySwitchesSplitTrianglesThatStayTiled) {
  const Tetrahedralization r = run(icosphere(2, 10), "pq1.2a20");
  EXPECT_TRUE(r.success) << r.reason;
  EXPECT_GT(r.mesh.boundary_faces.size(), 320U) << "the case is only of use when triangles were split";
}

TEST(Tetrahedralize, FillsCavitiesToo) {
  const TriangleMesh hollow = joined(icosphere(2, 10), reversed(icosphere(2, 4)));
  const Tetrahedralization r = run(joined(hollow, icosphere(1, 2)), "pY");
  EXPECT_TRUE(r.success) << r.reason;
  EXPECT_NEAR(volume_sum(r.mesh), enclosed_volume(icosphere(2, 10)), 1e-6);
}

TEST(Tetrahedralize, FillsComponentsSideBySideAndIgnoresOrientation) {
  TriangleMesh mesh = joined(icosphere(2, 3), reversed(translated(cube(), {8, 0, 0})));
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  const Tetrahedralization r = run(mesh);
  EXPECT_TRUE(r.success) << r.reason;
  EXPECT_NEAR(volume_sum(r.mesh), enclosed_volume(icosphere(2, 3)) + 1, 1e-8);
}

TEST(Tetrahedralize, LeavesOutIsolatedPoints) {
  TriangleMesh mesh = cube();
  mesh.points.insert(mesh.points.begin(), Vec3(0.3, 0.4, 0.5));
  for (Triangle& t : mesh.triangles)
    for (VertexId& v : t) ++v;
  const Tetrahedralization r = run(mesh);
  EXPECT_TRUE(r.success) << r.reason;
  EXPECT_EQ(r.mesh.points.size(), 8U);
}

TEST(Tetrahedralize, AnOpenSurfaceFails) {
  TriangleMesh mesh = icosphere(2);
  mesh.triangles.pop_back();
  const Tetrahedralization r = run(mesh);
  EXPECT_FALSE(r.success);
  EXPECT_THAT(r.reason, AllOf(HasSubstr("no tetrahedra"), HasSubstr("not closed")));
  EXPECT_EQ(r.tetrahedra, 0U);
}

TEST(Tetrahedralize, AClosedSurfaceWithAnOpenSheetFails) {
  const Tetrahedralization r = run(joined(icosphere(2, 10), {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
  EXPECT_FALSE(r.success);
  EXPECT_THAT(r.reason, HasSubstr("not closed"));
}

TEST(Tetrahedralize, CrossingSurfacesFailWithTheReason) {
  const TriangleMesh crossing = joined(icosphere(2), translated(icosphere(2), {1, 0.1, 0.2}));
  for (const std::string switches : {"p", "pY"}) {
    const Tetrahedralization r = run(crossing, switches);
    EXPECT_FALSE(r.success) << switches;
    EXPECT_THAT(r.reason, HasSubstr("intersect")) << switches;
    EXPECT_TRUE(r.mesh.tetrahedra.empty());
  }
}

TEST(Tetrahedralize, AVertexPushedThroughTheOtherSideFailsWithTheReason) {
  for (const VertexId v : {0U, 17U, 60U}) {
    TriangleMesh mesh = icosphere(2);
    mesh.points[v] *= -1.3;
    const Tetrahedralization r = run(mesh);
    EXPECT_FALSE(r.success) << v;
    EXPECT_THAT(r.reason, HasSubstr("intersect")) << v;
  }
}

TEST(Tetrahedralize, NoisyIntersectingMeshesNeverPassAndTheProgramLives) {
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    const Tetrahedralization r = run(noisy(icosphere(3), 0.12, seed), seed % 2 == 0 ? "p" : "pY");
    EXPECT_FALSE(r.success) << "seed " << seed;
    EXPECT_THAT(r.reason, HasSubstr("intersect")) << "seed " << seed;
  }
}

TEST(Tetrahedralize, DuplicateFacesFailWithTheReason) {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back(mesh.triangles[0]);
  const Tetrahedralization r = run(mesh);
  EXPECT_EQ(r.code, 3);
  EXPECT_THAT(r.reason, AllOf(HasSubstr("self-intersection (code 3)"), HasSubstr("triangles 0 and 12 intersect")));
}

TEST(Tetrahedralize, NearDuplicatePointsFailWithTheReason) {
  for (const double gap : {1e-9, 1e-12, 0.0}) {
    for (const std::string switches : {"p", "pY"}) {
      const Tetrahedralization r = run(cube_with_near_points(gap), switches);
      EXPECT_FALSE(r.success) << gap << switches;
      EXPECT_THAT(r.reason, HasSubstr("near-duplicate points 8 and 9")) << gap << switches;
    }
  }
  EXPECT_TRUE(run(cube_with_near_points(1e-3)).success);
}

TEST(Tetrahedralize, ReportsPointsUnderTheCallersNumbers) {
  TriangleMesh mesh = cube_with_near_points(1e-10);
  mesh.points.insert(mesh.points.begin(), Vec3(7, 7, 7));
  for (Triangle& t : mesh.triangles)
    for (VertexId& v : t) ++v;
  EXPECT_THAT(run(mesh).reason, HasSubstr("near-duplicate points 9 and 10"));
}

TEST(Tetrahedralize, WhatIsNotFiniteOrEmptyIsRefusedBeforeStarting) {
  const Environment no_worker("SMOPT_TETGEN_WORKER", "/nonexistent/worker");
  TriangleMesh mesh = cube();
  mesh.points[5].z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(run(mesh).reason, AllOf(HasSubstr("vertex 5"), HasSubstr("not finite")));
  EXPECT_THAT(run({}).reason, HasSubstr("no triangles"));
  mesh = cube();
  mesh.triangles[2][1] = 99;
  EXPECT_THAT(run(mesh).reason, AllOf(HasSubstr("triangle 2"), HasSubstr("99")));
}

TEST(Tetrahedralize, SwitchesThatChangeTheTaskAreRefused) {
  for (const char* switches : {"", "q", "pd", "pr", "po2", "pw", "pz", "p;", "pI"})
    EXPECT_THROW((void)run(cube(), switches), InvalidOption) << switches;
  EXPECT_THROW((void)run(cube(), "p" + std::string(500, 'Y')), InvalidOption);
  EXPECT_THROW((void)tetrahedralize(cube(), {.time_limit_seconds = 0}), InvalidOption);
}

TEST(Tetrahedralize, ASmallerToleranceTellsNearPointsApart) {
  EXPECT_FALSE(run(cube_with_near_points(1e-9), "p").success);
  const Tetrahedralization r = run(cube_with_near_points(1e-9), "pT1e-12");
  EXPECT_TRUE(r.success) << r.reason;
}

TEST(Tetrahedralize, QuietAndVerboseSwitchesDoNotHideReasons) {
  EXPECT_THAT(run(cube_with_near_points(1e-9), "pQ").reason, HasSubstr("near-duplicate"));
  EXPECT_THAT(run(cube_with_near_points(1e-9), "pVV").reason, HasSubstr("near-duplicate"));
}

TEST(Tetrahedralize, KeepsToTheTimeLimitAndKillsWhatTheWorkerStarted) {
  const FakeWorker worker("sleep 300 & sleep 300");
  const auto start = std::chrono::steady_clock::now();
  const Tetrahedralization r = tetrahedralize(cube(), {.time_limit_seconds = 0.3});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  EXPECT_FALSE(r.success);
  EXPECT_THAT(r.reason, StartsWith("time limit of 0.3 s exceeded"));
}

TEST(Tetrahedralize, KeepsToTheMemoryLimit) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer reserves more address space than any limit";
#endif
  const Tetrahedralization r = tetrahedralize(icosphere(6), {.memory_limit_mb = 40});
  EXPECT_FALSE(r.success);
  EXPECT_THAT(r.reason, HasSubstr("memory limit of 40 MB exceeded"));
}

TEST(Tetrahedralize, AWorkerThatCrashesIsAFailureWithItsSignal) {
  const FakeWorker worker("kill -SEGV $$");
  const Tetrahedralization r = run(cube());
  EXPECT_FALSE(r.success);
  EXPECT_FALSE(r.code.has_value());
  EXPECT_EQ(r.reason, "TetGen crashed with signal SIGSEGV");
}

TEST(Tetrahedralize, ACrashNearTheMemoryLimitSaysSo) {
  const FakeWorker worker("exec python3 -c \"import os, time; full = b'x' * (400 << 20); time.sleep(0.3); os.kill(os.getpid(), 11)\"");
  EXPECT_EQ(tetrahedralize(cube(), {.memory_limit_mb = 450}).reason,
            "TetGen crashed with signal SIGSEGV, its memory near the limit of 450 MB");
}

TEST(Tetrahedralize, AWorkerThatIsAskedToEndIsNoVerdictOnTheMesh) {
  const FakeWorker worker("kill -TERM $$");
  EXPECT_THROW(run(cube()), Cancelled);
}

TEST(Tetrahedralize, AWorkerWithoutAnAnswerIsAFailure) {
  EXPECT_THAT((FakeWorker("exit 0"), run(cube()).reason), "the TetGen worker ended without an answer");
  EXPECT_THAT((FakeWorker("echo noise; echo gone wrong >&2; exit 7"), run(cube()).reason),
              "the TetGen worker ended with status 7: gone wrong");
  EXPECT_THAT((FakeWorker("echo garbage > $2"), run(cube()).reason), "the TetGen worker ended without an answer");
}

TEST(Tetrahedralize, AFloodOfOutputDoesNotStopIt) {
  const FakeWorker worker("head -c 50000000 /dev/zero; exit 0");
  EXPECT_FALSE(run(cube()).success);
}

TEST(Tetrahedralize, AMissingWorkerIsAnErrorThatSaysWhereItShouldBe) {
  const Environment variable("SMOPT_TETGEN_WORKER", "/nonexistent/worker");
  EXPECT_THROW(
      {
        try {
          (void)run(cube());
        } catch (const InvalidInput& error) {
          EXPECT_THAT(error.what(), AllOf(HasSubstr("/nonexistent/worker"), HasSubstr("SMOPT_TETGEN_WORKER")));
          throw;
        }
      },
      InvalidInput);
}

TEST(Tetrahedralize, CanBeCancelled) {
  const FakeWorker worker("sleep 300");
  TetrahedralizeOptions options;
  options.progress = [](std::string_view, double) { return false; };
  EXPECT_THROW((void)tetrahedralize(cube(), options), Cancelled);
}

TEST(Tetrahedralize, LeavesNoTemporaryFilesBehind) {
  const TemporaryFolder folder;
  const Environment tmp("TMPDIR", folder.path());
  EXPECT_TRUE(run(cube()).success);
  EXPECT_FALSE(run(cube_with_near_points(0)).success);
  {
    const FakeWorker worker("kill -KILL $$");
    EXPECT_FALSE(run(cube()).success);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Tetrahedralize, JsonHasTheKeysOfTheContract) {
  const nlohmann::ordered_json good = to_json(run(cube()));
  std::vector<std::string> keys;
  for (const auto& item : good.items()) keys.push_back(item.key());
  EXPECT_THAT(keys,
              ::testing::ElementsAre("status", "reason", "code", "switches", "tetrahedra", "seconds", "peak_memory_mb", "tetgen_version"));
  EXPECT_EQ(good["status"], "success");
  EXPECT_TRUE(good["reason"].is_null());
  EXPECT_EQ(good["tetrahedra"], 6);
  const nlohmann::ordered_json bad = to_json(run(cube_with_near_points(0)));
  EXPECT_EQ(bad["status"], "failed");
  EXPECT_THAT(bad["reason"].get<std::string>(), HasSubstr("near-duplicate"));
}

/// The cube cut into six tetrahedra by TetGen, to be spoilt.
class Verification : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(why_not_a_mesh_of(surface, result, true), ""); }
  [[nodiscard]] std::string verdict(bool boundary_kept) const { return why_not_a_mesh_of(surface, result, boundary_kept); }

  TriangleMesh surface = cube();
  TetMesh result = run(cube(), "pY").mesh;
};

TEST_F(Verification, SeesAMissingTetrahedron) {
  result.tetrahedra.pop_back();
  EXPECT_NE(verdict(true), "");
  EXPECT_NE(verdict(false), "");
}

TEST_F(Verification, SeesATetrahedronTooMany) {
  result.tetrahedra.push_back(result.tetrahedra.front());
  EXPECT_NE(verdict(true), "");
}

TEST_F(Verification, SeesAMovedPoint) {
  result.points[3].x() += 1e-12;
  EXPECT_THAT(verdict(true), HasSubstr("point 3 was moved"));
}

TEST_F(Verification, SeesABoundaryFaceThatIsMissing) {
  result.boundary_faces.pop_back();
  result.surface_triangle.pop_back();
  EXPECT_THAT(verdict(false), HasSubstr("no boundary face"));
}

TEST_F(Verification, SeesABoundaryFaceInTheWrongTriangle) {
  std::swap(result.surface_triangle[0], result.surface_triangle[1]);
  EXPECT_THAT(verdict(false), HasSubstr("does not lie in it"));
}

TEST_F(Verification, SeesADiagonalTurned) {
  surface.triangles[0] = {0, 2, 1};
  surface.triangles[1] = {1, 2, 3};
  EXPECT_NE(verdict(true), "");
  EXPECT_NE(verdict(false), "");
}

}  // namespace
}  // namespace smopt::metrics
