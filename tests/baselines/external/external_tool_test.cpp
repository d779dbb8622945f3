#include "baselines/external/external_tool.h"

#include <filesystem>

#include "smopt/error.h"
#include "tests/baselines/external/tool_fixture.h"

namespace smopt::baselines {
namespace {

using smopt::testing::icosphere;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

namespace fs = std::filesystem;

/// A tool of one shell script, which leaves its mesh in `result`.
class ExternalTool : public ToolTest {
 protected:
  [[nodiscard]] fs::path result() const { return folder() / "out.off"; }
  /// The command that copies `mesh` there.
  [[nodiscard]] std::string giving(const TriangleMesh& mesh) const {
    const fs::path ready = folder() / "ready.off";
    write_mesh(ready, mesh);
    return "cp " + ready.string() + " " + result().string() + "; ";
  }
  MethodReport run(const std::string& script, TriangleMesh& mesh, double seconds = 60, const ProgressCallback& progress = {}) {
    return run_tool({"external:x", {"/bin/sh", "-c", script}, {seconds, 0, 2}, {}, result()}, mesh, progress);
  }
  std::string failure(const std::string& script, double seconds = 60) {
    TriangleMesh mesh = icosphere(0);
    try {
      run(script, mesh, seconds);
    } catch (const MethodFailed& failed) {
      EXPECT_EQ(mesh.points, icosphere(0).points) << "a failure leaves the mesh alone";
      return failed.what();
    }
    ADD_FAILURE() << script << " did not fail";
    return {};
  }
};

TEST_F(ExternalTool, PutsTheResultInTheMeshesPlaceWhateverItsSize) {
  TriangleMesh mesh = icosphere(0);
  const MethodReport report = run(giving(icosphere(1)), mesh);
  EXPECT_EQ(mesh.points, icosphere(1).points);
  EXPECT_EQ(mesh.triangles, icosphere(1).triangles);
  EXPECT_EQ(report.stopped_because, "done");
}

TEST_F(ExternalTool, ReportsTheTimeOfTheProcess) {
  TriangleMesh mesh = icosphere(0);
  const std::string work = "i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done; ";
  const MethodReport report = run(work + "sleep 0.3; " + giving(mesh), mesh);
  ASSERT_EQ(report.seconds.size(), 1U);
  EXPECT_EQ(report.seconds.front().first, "smoothing");
  const Seconds seconds = report.seconds.front().second;
  EXPECT_GT(seconds.cpu, 0.02);
  EXPECT_GT(seconds.wall, seconds.cpu + 0.2);
  EXPECT_THAT(report.notes, ElementsAre(HasSubstr("includes its start")));
}

TEST_F(ExternalTool, SaysThatAResultHasDiverged) {
  TriangleMesh far = icosphere(0), mesh = far;
  far.points[3] = Vec3(1e6, 0, 0);
  const MethodReport report = run(giving(far), mesh);
  EXPECT_EQ(report.stopped_because, "diverged");
  EXPECT_EQ(report.diverged_at_step, std::nullopt);
}

TEST_F(ExternalTool, FailsWithTheExitStatusAndTheLastLine) {
  EXPECT_EQ(failure("echo first; echo 'filter No Such not found'; echo; exit 3"),
            "external:x: sh ended with exit status 3: filter No Such not found");
  EXPECT_EQ(failure("exit 3"), "external:x: sh ended with exit status 3");
}

TEST_F(ExternalTool, FailsWithTheSignalOfACrash) {
  EXPECT_EQ(failure("echo here; kill -SEGV $$"), "external:x: sh was ended by signal SIGSEGV: here");
  EXPECT_EQ(failure("sh -c 'kill -SEGV $$' 2> /dev/null; exit $?"), "external:x: sh ended with exit status 139 (signal SIGSEGV)");
}

TEST_F(ExternalTool, SaysHowMuchMemoryWasAllowedWhereACrashMayComeFromThat) {
  TriangleMesh mesh = icosphere(0);
  EXPECT_THAT(
      [&] {
        run_tool({"external:x", {"/bin/sh", "-c", "kill -ABRT $$"}, {60, 900, 0}, {}, result()}, mesh, {});
      },
      ThrowsMessage<MethodFailed>("external:x: sh was ended by signal SIGABRT with 900 MB allowed"));
}

TEST_F(ExternalTool, FailsWhenItRunsOutOfTimeAndLeavesNothingRunning) {
  const std::string mark = "31.4159";  // seconds
  EXPECT_EQ(failure("sleep " + mark + " & sleep " + mark, 0.5), "external:x: sh ran out of its 0.5 s");
  EXPECT_EQ(processes_with(mark), 0);
}

TEST_F(ExternalTool, IsGoneWhenTheUserStopsIt) {
  const std::string mark = "31.4158";
  TriangleMesh mesh = icosphere(0);
  int calls = 0;
  EXPECT_THROW(run("sleep " + mark + " & sleep " + mark, mesh, 60, [&](std::string_view, double) { return ++calls < 4; }), Cancelled);
  EXPECT_EQ(processes_with(mark), 0);
}

TEST_F(ExternalTool, FailsWhenItGivesNoMeshOrWhatIsNone) {
  EXPECT_EQ(failure("echo nothing to do"), "external:x: gave no mesh: nothing to do");
  EXPECT_THAT(failure("echo rubbish > " + result().string()), StartsWith("external:x: gave what is no mesh: "));
  EXPECT_THAT(failure("echo 'OFF 3 1 0\n0 0 0\n1 0 0' > " + result().string()), HasSubstr("out.off:"));
}

TEST_F(ExternalTool, FindsTheFirstProgramInPath) {
  use_fakes();
  EXPECT_EQ(find_program("mytool"), std::nullopt);
  fake("mytool", "true");
  EXPECT_EQ(find_program("mytool"), folder() / "bin/mytool");
  fs::create_directory(folder() / "early");
  fs::create_directory(folder() / "early/mytool");  // a folder is no program, and neither is what may not be executed
  set_variable("PATH", ("/nowhere::" + (folder() / "early").string() + ":" + (folder() / "bin").string()).c_str());
  EXPECT_EQ(find_program("mytool"), folder() / "bin/mytool");
  fs::permissions(folder() / "bin/mytool", fs::perms::owner_read);
  EXPECT_EQ(find_program("mytool"), std::nullopt);
  set_variable("PATH", nullptr);
  EXPECT_EQ(find_program("sh"), std::nullopt);
}

TEST_F(ExternalTool, SaysHowToGetAProgramThatIsAbsent) {
  use_fakes();
  EXPECT_THAT([] { require_program("external:x", "mytool", "Debian: apt install x"); },
              ThrowsMessage<NotInstalled>("external:x: mytool is not installed (Debian: apt install x)"));
}

TEST_F(ExternalTool, TakesItsLimitsFromOptions) {
  const std::vector<MethodOption> options = with_limit_options({});
  const auto limits = [&](const std::map<std::string, std::string>& given) { return limits_of(OptionValues(options, given)); };
  EXPECT_EQ(limits({}).seconds, 600);
  EXPECT_EQ(limits({}).memory_mb, 8192U);
  EXPECT_EQ(limits({{"time-limit", "0.5"}}).seconds, 0.5);
  EXPECT_EQ(limits({{"memory-limit", "100"}}).memory_mb, 100U);
  EXPECT_THROW(limits({{"time-limit", "0"}}), InvalidOption);
  EXPECT_THROW(limits({{"memory-limit", "-1"}}), InvalidOption);
}

}  // namespace
}  // namespace smopt::baselines
