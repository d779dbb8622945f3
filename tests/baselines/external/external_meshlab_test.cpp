#include "baselines/external/external_meshlab.h"

#include <fmt/format.h>

#include <cstdlib>

#include "baselines/meshlab.h"
#include "smopt/error.h"
#include "smopt/io/mesh_io.h"
#include "tests/baselines/external/tool_fixture.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace fs = std::filesystem;

/// xvfb-run -a meshlabserver -i IN -o OUT -s SCRIPT: the fake screen runs its command, the fake server copies IN to OUT.
class ExternalMeshlab : public ToolTest {
 protected:
  ExternalMeshlab() {
    use_fakes();
    fake("xauth", "true");
    fake("xvfb-run", "shift; exec \"$@\"");
  }
  void fake_server(const std::string& script = "") {
    const std::string kept = folder().string();
    fake("meshlabserver", script + "\ncp \"$6\" " + kept + "/filter; env > " + kept + "/variables; cp \"$2\" \"$4\"");
    fs::create_symlink("/usr/bin/env", folder() / "bin/env");
  }

  const Method method_ = external_meshlab_method();
};

TEST_F(ExternalMeshlab, HandsTheMeshOverToTheLastBit) {
  fake_server();
  const TriangleMesh mesh = noisy(icosphere(2), 0.1, 1);
  const MethodResult result = run_method(method_, mesh);
  EXPECT_EQ(result.mesh.points, mesh.points);
  EXPECT_EQ(result.mesh.triangles, mesh.triangles);
  EXPECT_EQ(result.report.rounds_run, 3U) << "MeshLab's default";
}

TEST_F(ExternalMeshlab, WritesItsOptionsIntoTheFilter) {
  fake_server();
  const auto filter = [&](const std::map<std::string, std::string>& options) {
    run_method(method_, icosphere(0), options);
    return bytes_of(folder() / "filter");
  };
  EXPECT_THAT(filter({}), AllOf(HasSubstr("<filter name=\"Laplacian Smooth\">"), HasSubstr("name=\"stepSmoothNum\" value=\"3\""),
                                HasSubstr("name=\"cotangentWeight\" value=\"true\"")));
  EXPECT_THAT(filter({{"rounds", "7"}, {"weights", "uniform"}}),
              AllOf(HasSubstr("name=\"stepSmoothNum\" value=\"7\""), HasSubstr("name=\"cotangentWeight\" value=\"false\"")));
}

TEST_F(ExternalMeshlab, NeedsNeitherScreenNorTheUsersSettings) {
  fake_server();
  set_variable("QT_QPA_PLATFORM", "offscreen");
  run_method(method_, icosphere(0));
  const std::string variables = bytes_of(folder() / "variables");
  for (const char* line : {"LIBGL_ALWAYS_SOFTWARE=1\n", "QT_QPA_PLATFORM=xcb\n", "LC_ALL=C\n", "TMPDIR=/"})
    EXPECT_THAT(variables, HasSubstr(line));
}

TEST_F(ExternalMeshlab, SaysWhichProgramIsNotInstalled) {
  EXPECT_EQ(failure_of(method_), "external:meshlab: meshlabserver is not installed (Debian: apt install meshlab xvfb xauth)");
  fake_server();
  fs::remove(folder() / "bin/xvfb-run");
  EXPECT_THROW(run_method(method_, icosphere(0)), NotInstalled);
  EXPECT_THAT(failure_of(method_), StartsWith("external:meshlab: xvfb-run is not installed"));
}

TEST_F(ExternalMeshlab, FailsWithWhatTheServerSays) {
  fake_server("echo 'filter not found'; exit 255");
  EXPECT_EQ(failure_of(method_), "external:meshlab: xvfb-run ended with exit status 255: filter not found");
}

TEST_F(ExternalMeshlab, IsKilledWhenItHangs) {
  fake_server("sleep 31.4157");
  EXPECT_EQ(failure_of(method_, {{"time-limit", "0.5"}}), "external:meshlab: xvfb-run ran out of its 0.5 s");
  EXPECT_EQ(processes_with("31.4157"), 0);
}

/// MeshLab itself, where it is installed.
class RealMeshlab : public ToolTest {
 protected:
  void SetUp() override {
    for (const char* name : {"/usr/bin/meshlabserver", "/usr/bin/xvfb-run", "/usr/bin/xauth"})
      if (!fs::exists(name)) GTEST_SKIP() << name << " is not installed";
  }
};

/// The locks of X servers that do not run any more.
int stale_locks() {
  int count = 0;
  for (const auto& entry : fs::directory_iterator("/tmp")) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(".X") || !name.ends_with("-lock")) continue;
    const std::string holder = std::to_string(std::atoi(bytes_of(entry.path()).c_str()));
    count += fs::exists(fs::path("/proc") / holder) ? 0 : 1;
  }
  return count;
}

TEST_F(RealMeshlab, KeepsTheOrderAndWhatBelongsToNoTriangle) {
  TriangleMesh mesh = icosphere(1);
  mesh.points.emplace_back(3, 4, 5);
  mesh.points.push_back(mesh.points[0]);  // in the same place, and yet another vertex
  const MethodResult result = run_method(external_meshlab_method(), mesh, {{"rounds", "0"}});
  EXPECT_EQ(result.mesh.triangles, mesh.triangles);
  ASSERT_EQ(result.mesh.vertex_count(), mesh.vertex_count());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) EXPECT_EQ(result.mesh.points[v], mesh.points[v].cast<float>().cast<double>());
}

TEST_F(RealMeshlab, LeavesNoScreenBehind) {
  set_variable("TMPDIR", folder().c_str());  // stands in the command lines of all that is started
  const int locks = stale_locks();
  const auto expect_nothing_left = [&](const char* after) {
    EXPECT_EQ(processes_with(folder().string()), 0) << after;
    EXPECT_EQ(stale_locks(), locks) << after;
    EXPECT_TRUE(fs::is_empty(folder())) << after;
  };
  run_method(external_meshlab_method(), icosphere(1));
  expect_nothing_left("after its end");
  EXPECT_THAT(failure_of(external_meshlab_method(), {{"time-limit", "1"}, {"rounds", "1000000000"}}), HasSubstr("ran out of its 1 s"));
  expect_nothing_left("after it ran out of time");
  bool is_seen = false;  // the screen, before it is stopped
  EXPECT_THROW(run_method(external_meshlab_method(), icosphere(1), {{"rounds", "1000000000"}},
                          [&](std::string_view, double) { return !(is_seen = is_seen || processes_with(folder().string()) > 1); }),
               Cancelled);
  EXPECT_TRUE(is_seen);
  expect_nothing_left("after Ctrl-C");
}

}  // namespace
}  // namespace smopt::baselines
