#include "baselines/external/external_iso2mesh.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "baselines/hc.h"
#include "baselines/laplacian.h"
#include "baselines/taubin.h"
#include "smopt/error.h"
#include "tests/baselines/external/tool_fixture.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;
using ::testing::EndsWith;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

/// octave-cli --… PROGRAM FOLDER SMOOTHER ROUNDS ALPHA RATIO in a folder with in.txt: the fake keeps both and gives a mesh.
class ExternalIso2mesh : public ToolTest {
 protected:
  ExternalIso2mesh() {
    use_fakes();
    set_variable("ISO2MESH", nullptr);
    folder_file("iso2mesh/smoothsurf.m", "");
  }
  void fake_octave() {
    const std::string kept = folder().string();
    fake("octave-cli", "echo \"$@\" > " + kept + "/arguments; cp in.txt " + kept +
                           "\nprintf 'OFF\\n3 1 0\\n0 0 0\\n1 0 0\\n0 1 0\\n3 0 1 2\\n' > out.off");
  }
  void folder_file(const std::string& name, const std::string& content) const {
    fs::create_directories((folder() / name).parent_path());
    std::ofstream(folder() / name) << content;
  }
  [[nodiscard]] std::map<std::string, std::string> with_folder(std::map<std::string, std::string> options = {}) const {
    options["iso2mesh"] = iso2mesh();
    return options;
  }
  [[nodiscard]] std::string iso2mesh() const { return (folder() / "iso2mesh").string(); }

  const Method method_ = external_iso2mesh_method();
};

TEST_F(ExternalIso2mesh, HandsTheMeshAndTheSettingsOver) {
  fake_octave();
  TriangleMesh mesh;
  mesh.points = {{0.1, 1.0 / 3, -2e-20}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{2, 0, 1}};
  const MethodResult result =
      run_method(method_, mesh, with_folder({{"smoother", "lowpass"}, {"rounds", "7"}, {"alpha", "0.25"}, {"keep-ratio", "0.5"}}));
  EXPECT_EQ(bytes_of(folder() / "in.txt"), "3 1\n0.1 0.3333333333333333 -2e-20\n1 0 0\n0 1 0\n3 1 2\n");
  EXPECT_THAT(bytes_of(folder() / "arguments"), EndsWith(" " + iso2mesh() + " lowpass 7 0.25 0.5\n"));
  EXPECT_EQ(result.mesh.points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST_F(ExternalIso2mesh, TakesTheFolderFromTheEnvironmentWhereNoneIsGiven) {
  fake_octave();
  set_variable("ISO2MESH", iso2mesh().c_str());
  run_method(method_, icosphere(0));
  EXPECT_THAT(bytes_of(folder() / "arguments"), HasSubstr(" " + iso2mesh() + " laplacian 100 0.5 1\n"));
}

TEST_F(ExternalIso2mesh, SaysWhatIsNotInstalledAndWhatToDo) {
  EXPECT_EQ(failure_of(method_, with_folder()), "external:iso2mesh: octave-cli is not installed (Debian: apt install octave)");
  fake_octave();
  EXPECT_THROW(run_method(method_, icosphere(0)), NotInstalled);
  EXPECT_THAT(failure_of(method_), HasSubstr("by --iso2mesh DIR or the environment variable ISO2MESH"));
  EXPECT_THAT(failure_of(method_, {{"iso2mesh", folder().string()}}), HasSubstr("there is no smoothsurf.m in " + folder().string()));
}

TEST_F(ExternalIso2mesh, FailsWithWhatOctaveSays) {
  fake("octave-cli", "echo \"error: 'meshconn' undefined\" >&2; exit 1");
  EXPECT_EQ(failure_of(method_, with_folder()), "external:iso2mesh: octave-cli ended with exit status 1: error: 'meshconn' undefined");
}

TEST_F(ExternalIso2mesh, RejectsARatioOutOfRange) {
  fake_octave();
  for (const char* ratio : {"0", "1.5"})
    EXPECT_THROW(run_method(method_, icosphere(0), with_folder({{"keep-ratio", ratio}})), InvalidOption);
}

/// Octave itself, where it is installed.
class RealOctave : public ToolTest {
 protected:
  void SetUp() override {
    if (!fs::exists("/usr/bin/octave-cli")) GTEST_SKIP() << "octave-cli is not installed";
  }
};

TEST_F(RealOctave, GetsAndGivesEveryBit) {
  // A stand-in for ISO2mesh that moves nothing.
  std::ofstream(folder() / "smoothsurf.m") << "function p = smoothsurf(node, varargin)\np = node;\nend\n";
  std::ofstream(folder() / "meshconn.m") << "function c = meshconn(elem, n)\nc = {};\nend\n";
  const TriangleMesh mesh = noisy(icosphere(2), 0.1, 5);
  const MethodResult result = run_method(external_iso2mesh_method(), mesh, {{"iso2mesh", folder().string()}});
  EXPECT_EQ(result.mesh.points, mesh.points);
  EXPECT_EQ(result.mesh.triangles, mesh.triangles);
}

/// ISO2mesh itself as the judge of our own smoothers, where ISO2MESH names its folder.
class Iso2meshOracle : public RealOctave {
 protected:
  void SetUp() override {
    RealOctave::SetUp();
    if (!IsSkipped() && std::getenv("ISO2MESH") == nullptr) GTEST_SKIP() << "ISO2MESH names no folder";
  }
};

void expect_same(const TriangleMesh& ours, const TriangleMesh& theirs, double tolerance) {
  EXPECT_EQ(ours.triangles, theirs.triangles);
  ASSERT_EQ(ours.vertex_count(), theirs.vertex_count());
  double largest = 0;
  for (std::size_t v = 0; v < ours.vertex_count(); ++v)
    largest = std::max(largest, (ours.points[v] - theirs.points[v]).lpNorm<Eigen::Infinity>());
  EXPECT_LE(largest, tolerance);
}

TEST_F(Iso2meshOracle, SmoothersAgreeToRounding) {
  constexpr double kTolerance = 1e-13;  // a hundred roundings of coordinates up to 1.1
  const TriangleMesh mesh = noisy(icosphere(3), 0.05, 2);
  const auto theirs = [&](const char* smoother) {
    return run_method(external_iso2mesh_method(), mesh, {{"smoother", smoother}, {"rounds", "20"}, {"alpha", "0.4"}}).mesh;
  };
  TriangleMesh laplacian = mesh;
  smooth_laplacian(laplacian, {20, 0.4, SweepOrder::jacobi});
  expect_same(laplacian, theirs("laplacian"), kTolerance);
  TriangleMesh lowpass = mesh;
  smooth_taubin(lowpass, {20, 0.4, -1.02 * 0.4});
  expect_same(lowpass, theirs("lowpass"), kTolerance);
  TriangleMesh hc = mesh;
  smooth_hc(hc, {20, 0.4, 0.5});
  expect_same(hc, theirs("laplacianhc"), kTolerance);
}

}  // namespace
}  // namespace smopt::baselines
