#include "baselines/external/external_mmgs.h"

#include "smopt/error.h"
#include "tests/baselines/external/tool_fixture.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

/// Copies its input to its output and keeps its arguments.
class ExternalMmgs : public ToolTest {
 protected:
  ExternalMmgs() { use_fakes(); }
  void fake_mmgs(const std::string& name = "mmgs") { fake(name, "echo \"$@\" > " + (folder() / name).string() + "\ncp \"$2\" \"$4\""); }
  [[nodiscard]] std::string arguments(const std::string& name = "mmgs") const { return bytes_of(folder() / name); }

  const Method method_ = external_mmgs_method();
};

TEST_F(ExternalMmgs, HandsTheMeshOverToTheLastBit) {
  fake_mmgs();
  const TriangleMesh mesh = noisy(icosphere(2), 0.1, 1);
  const MethodResult result = run_method(method_, mesh);
  EXPECT_EQ(result.mesh.points, mesh.points);
  EXPECT_EQ(result.mesh.triangles, mesh.triangles);
}

TEST_F(ExternalMmgs, PassesOnlyWhatIsSet) {
  fake_mmgs();
  run_method(method_, icosphere(0));
  EXPECT_THAT(arguments(), EndsWith(" -hgrad 1.3 -ar 45\n"));
  EXPECT_THAT(arguments(), Not(HasSubstr("-hausd")));
  run_method(method_, icosphere(0), {{"hausd", "0.05"}, {"hsiz", "1"}, {"hgrad", "2"}, {"ridge-angle", "0"}});
  EXPECT_THAT(arguments(), EndsWith(" -hausd 0.05 -hsiz 1 -hgrad 2 -nr\n"));
  run_method(method_, icosphere(0), {{"hgrad", "0"}});
  EXPECT_THAT(arguments(), EndsWith(" -hgrad -1 -ar 45\n"));
}

TEST_F(ExternalMmgs, PrefersTheOptimisedProgram) {
  fake_mmgs();
  fake_mmgs("mmgs_O3");
  run_method(method_, icosphere(0));
  EXPECT_THAT(arguments("mmgs_O3"), HasSubstr("-in"));
  EXPECT_EQ(arguments("mmgs"), "");
}

TEST_F(ExternalMmgs, SaysThatItIsNotInstalled) {
  EXPECT_THROW(run_method(method_, icosphere(0)), NotInstalled);
  EXPECT_THAT(failure_of(method_), HasSubstr("external:mmgs: mmgs is not installed"));
}

TEST_F(ExternalMmgs, FailsWithWhatMmgsSays) {
  fake("mmgs", "echo '  ## Error: unable to scale mesh.'; exit 1");
  EXPECT_EQ(failure_of(method_), "external:mmgs: mmgs ended with exit status 1:   ## Error: unable to scale mesh.");
}

class RealMmgs : public ToolTest {};

TEST_F(RealMmgs, RemeshesASphere) {
  try {
    const MethodResult result = run_method(external_mmgs_method(), icosphere(3), {{"hsiz", "0.3"}});
    EXPECT_LT(result.mesh.vertex_count(), icosphere(3).vertex_count());
    for (const Vec3& p : result.mesh.points) EXPECT_NEAR(p.norm(), 1, 0.05);
  } catch (const NotInstalled& absent) {
    GTEST_SKIP() << absent.what();
  }
}

}  // namespace
}  // namespace smopt::baselines
