#include <gmock/gmock.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <sstream>

#include "metrics/measure.h"
#include "smopt/io/mesh_io.h"
#include "smopt/io/sha256.h"
#include "tests/cli/smopt_program.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// The keys of `improve --report` that other programs rely on.
const json kContract = json::parse(R"(
{"method": "", "options": {}, "input": {"vertices": 0, "triangles": 0, "euler_characteristic": 0, "sha256": ""},
 "output": {"vertices": 0, "triangles": 0, "euler_characteristic": 0, "sha256": ""},
 "removed": {"cavities": 0, "cavity_vertices": 0, "redundant_valence3": 0, "redundant_valence4": 0},
 "rounds": 0, "moves": {"accepted": 0, "shortened": 0, "refused": 0}, "stopped_because": "",
 "seconds": {"read": 0, "validity": 0, "cavities": 0, "redundant": 0, "smoothing": 0, "write": 0, "total": 0},
 "cpu_seconds": {"read": 0, "validity": 0, "cavities": 0, "redundant": 0, "smoothing": 0, "write": 0, "total": 0},
 "peak_memory_mb": 0, "threads": 0, "version": ""})");

/// The methods that need nothing that may not be here: no program of others, no library that was absent when this was built.
std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const auto& method : json::parse(run_smopt({"methods", "--json"}).out)) {
    const bool is_built = method["note"].get<std::string>().find("not built") == std::string::npos;
    if (is_built && !method["name"].get<std::string>().starts_with("external:")) names.push_back(method["name"]);
  }
  return names;
}

double smallest_angle(const TriangleMesh& mesh) {
  return metrics::measure(mesh, {}).shape.angle.min.value();
}

/// A rough sphere on disk, and where its improvement goes.
class Improve : public ::testing::Test {
 protected:
  /// Runs `improve IN -o OUT` with more arguments.
  ProgramResult improve(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"improve", input, "-o", output});
    return run_smopt(more);
  }
  [[nodiscard]] json report_of(std::vector<std::string> more = {}) const {
    more.emplace_back("--json");
    const ProgramResult r = improve(more);
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return json::parse(r.out);
  }

  TemporaryFolder folder;
  TriangleMesh mesh = rough_sphere(3);
  std::string input = put_mesh(folder, "in.off", mesh);
  std::string output = path_in(folder, "out.off");
};

TEST_F(Improve, WithNothingButInAndOutMakesAMeshFitForUse) {
  const ProgramResult r = improve();
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.out, IsEmpty());
  EXPECT_THAT(r.err, HasSubstr("out.off"));
  EXPECT_THAT(r.err, Not(HasSubstr("\r"))) << "a progress bar on a pipe";
  const TriangleMesh improved = read_mesh(output);
  EXPECT_THAT(improved, IsClosedManifold());
  EXPECT_EQ(metrics::measure(mesh, {}).intersecting_pairs, 0U) << "the case is only of use without pairs at the start";
  EXPECT_EQ(metrics::measure(improved, {}).intersecting_pairs, 0U);
  EXPECT_GT(smallest_angle(improved), smallest_angle(mesh));
  EXPECT_THAT(files_in(folder), ::testing::ElementsAre("in.off", "out.off"));
}

TEST_F(Improve, EveryMethodFillsTheReport) {
  for (const std::string& method : method_names()) {
    const json report = report_of({"--method", method, "--rounds", "3"});
    EXPECT_EQ(why_not_shaped_like(kContract, report), "") << method;
    EXPECT_EQ(report["method"], method);
    EXPECT_EQ(report["options"]["rounds"], 3) << method;
    EXPECT_GT(report["seconds"]["smoothing"].get<double>(), 0) << method;
    EXPECT_GE(report["seconds"]["total"].get<double>(), report["seconds"]["smoothing"].get<double>()) << method;
  }
}

TEST_F(Improve, TheReportHasEveryOptionWithItsDefault) {
  const json methods = json::parse(run_smopt({"methods", "--json"}).out);
  const json report = report_of();
  for (const auto& option : methods[0]["options"]) EXPECT_TRUE(report["options"].contains(option["name"].get<std::string>())) << option;
  EXPECT_EQ(report["options"]["rounds"], 100);
  EXPECT_EQ(report["options"]["rounds-per-screening"], 4);
  EXPECT_EQ(report["options"]["edge-ratio"], 0.1);
  EXPECT_EQ(report["options"]["min-angle"], 10.0);
  EXPECT_EQ(report["options"]["halvings"], 10);
  EXPECT_EQ(report["options"]["tolerance"], "1e-4");
  EXPECT_EQ(report["options"]["cavities"], "delete");
}

TEST_F(Improve, TheReportTellsTheFilesApartByTheirHashes) {
  const json report = report_of();
  EXPECT_EQ(report["input"]["sha256"], sha256_of_file(input));
  EXPECT_EQ(report["output"]["sha256"], sha256_of_file(output));
  EXPECT_NE(report["input"]["sha256"], report["output"]["sha256"]);
  EXPECT_EQ(report["input"]["vertices"], mesh.vertex_count());
  EXPECT_EQ(report["output"]["triangles"], read_mesh(output).triangle_count());
  EXPECT_EQ(report["output"]["euler_characteristic"], 2);
}

TEST_F(Improve, TheReportInAFileIsTheOnePrinted) {
  const std::string file = path_in(folder, "report.json");
  const ProgramResult r = improve({"--report", file, "--json"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_FALSE(r.out.empty());
  EXPECT_EQ(bytes_of(file), r.out);
}

TEST_F(Improve, CountsRemovedCavities) {
  const TriangleMesh hollow = joined(joined(icosphere(3, 10), reversed(icosphere(1, 2, {3, 0, 0}))), reversed(icosphere(1, 2, {-3, 0, 0})));
  put_mesh(folder, "in.off", hollow);
  EXPECT_EQ(report_of()["removed"]["cavities"], 2);
  EXPECT_EQ(report_of()["removed"]["cavity_vertices"], 84);
  EXPECT_EQ(report_of({"--cavities", "keep"})["removed"]["cavities"], 0);
  EXPECT_EQ(report_of({"--method", "laplacian", "--rounds", "1"})["output"]["vertices"], hollow.vertex_count())
      << "the other methods keep cavities unless told otherwise";
}

TEST_F(Improve, AMeshThatFacesInwardsIsTurnedAndLosesNothing) {
  put_mesh(folder, "in.off", reversed(mesh));
  const json report = report_of({"--rounds", "0", "--redundant", "keep"});
  EXPECT_EQ(report["turned"]["whole_mesh"], true);
  EXPECT_EQ(report["output"]["vertices"], mesh.vertex_count());
  EXPECT_NEAR(enclosed_volume(read_mesh(output)), enclosed_volume(mesh), 1e-12);
}

TEST_F(Improve, VerifyCountsThePairsOfTheFile) {
  const ProgramResult r = improve({"--verify", "--json"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  const json verified = json::parse(r.out)["verified"];
  EXPECT_EQ(verified["pairs_before"], 0);
  EXPECT_EQ(verified["pairs_after"], 0);
  EXPECT_THAT(r.err, HasSubstr("0 after"));
}

TEST_F(Improve, VerifyExitsWith1WhenRoundingMakesPairs) {
  for (const std::string& place : {output, std::string("-")}) {
    const ProgramResult r = run_smopt({"improve", input, "-o", place, "--digits", "1", "--rounds", "0", "--redundant", "keep", "--verify"});
    EXPECT_EQ(r.exit_code, 1) << place << r.err;
    EXPECT_THAT(r.err, HasSubstr("verified: 0 intersecting pairs before")) << place;
  }
  EXPECT_GT(metrics::measure(read_mesh(output), {}).intersecting_pairs.value_or(0), 0U);
}

TEST_F(Improve, RoundedOutputIsWarnedOf) {
  EXPECT_THAT(improve({"--digits", "5"}).err, HasSubstr("warning"));
  EXPECT_THAT(run_smopt({"improve", input, "-o", path_in(folder, "out.stl")}).err, HasSubstr("warning"));
  EXPECT_THAT(run_smopt({"improve", input, "-o", path_in(folder, "out.stl.gz")}).err, HasSubstr("warning"));
  EXPECT_THAT(improve().err, Not(HasSubstr("warning")));
}

TEST_F(Improve, AMethodThatDivergedIsWarnedOfAndReported) {
  // Beta 9 throws every vertex past the mean of its neighbours.
  const ProgramResult r = improve({"--method", "laplacian", "--beta", "9", "--rounds", "50", "--report", path_in(folder, "r.json")});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  const json report = json::parse(bytes_of(path_in(folder, "r.json")));
  const auto step = report["diverged_at_step"].get<int>();
  EXPECT_GT(step, 1);
  EXPECT_EQ(report["stopped_because"], "diverged at step " + std::to_string(step));
  EXPECT_THAT(r.err, HasSubstr("warning: the method diverged at step " + std::to_string(step)));
  EXPECT_TRUE(report_of({"--method", "laplacian"})["diverged_at_step"].is_null());
}

TEST_F(Improve, VerifyExitsWith1WhereThePairsCannotBeCounted) {
  const ProgramResult r = improve({"--method", "laplacian", "--beta", "1e300", "--rounds", "3", "--verify", "--json"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_THAT(r.err, HasSubstr("verified: 0 intersecting pairs before, an unknown number of after"));
  EXPECT_TRUE(json::parse(r.out)["verified"]["pairs_after"].is_null());
}

TEST_F(Improve, SaysWhatAMethodNotes) {
  const ProgramResult r = improve({"--method", "iso2mesh", "--vertices", "500", "--rounds", "1"});
  EXPECT_THAT(r.err, HasSubstr("note: resampled from 642 to 500 vertices"));
  EXPECT_EQ(read_mesh(output).vertex_count(), 500U);
}

TEST_F(Improve, AMethodWhoseProgramIsNotInstalledExitsWith1AndWritesNothing) {
  const ProgramResult r = improve({"--method", "external:iso2mesh", "--iso2mesh", path_in(folder, "nowhere")});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_THAT(r.err, HasSubstr("external:iso2mesh"));
  EXPECT_THAT(files_in(folder), ::testing::ElementsAre("in.off"));
}

TEST_F(Improve, DigitsLimitWhatIsWritten) {
  constexpr std::size_t kDigits = 4;
  ASSERT_EQ(improve({"--digits", "4"}).exit_code, 0);
  std::istringstream text(bytes_of(output));
  std::string keyword, line;
  std::size_t vertices = 0;
  text >> keyword >> vertices;
  std::getline(text, line);
  for (std::size_t i = 0; i < 3 * vertices; ++i) {
    std::string number;
    text >> number;
    std::string mantissa = number.substr(0, number.find('e'));
    std::erase_if(mantissa, [](char c) { return c == '-' || c == '.'; });
    EXPECT_LE(mantissa.substr(std::min(mantissa.size(), mantissa.find_first_not_of('0'))).size(), kDigits) << number;
  }
}

TEST_F(Improve, WorksBetweenPipes) {
  ASSERT_EQ(improve().exit_code, 0);
  const ProgramResult piped = run_smopt({"improve", "-", "-o", "-", "--quiet"}, bytes_of(input));
  EXPECT_EQ(piped.exit_code, 0) << piped.err;
  EXPECT_THAT(piped.err, IsEmpty());
  EXPECT_EQ(piped.out, bytes_of(output));
}

TEST_F(Improve, QuietSaysNothing) {
  const ProgramResult r = improve({"--quiet", "--verify"});
  EXPECT_EQ(r.exit_code, 0);
  EXPECT_THAT(r.out, IsEmpty());
  EXPECT_THAT(r.err, IsEmpty());
}

TEST_F(Improve, WritesTheSameBytesForAnyNumberOfThreads) {
  for (const std::string& method : method_names()) {
    ASSERT_EQ(improve({"--method", method, "--rounds", "5", "--threads", "1"}).exit_code, 0);
    const std::string one = bytes_of(output);
    ASSERT_EQ(improve({"--method", method, "--rounds", "5", "--threads", "3"}).exit_code, 0);
    EXPECT_EQ(bytes_of(output), one) << method;
  }
  EXPECT_EQ(report_of({"--threads", "1"})["threads"], 1);
}

TEST_F(Improve, MayReplaceItsInput) {
  ASSERT_EQ(improve().exit_code, 0);
  ASSERT_EQ(run_smopt({"improve", input, "-o", input}).exit_code, 0);
  EXPECT_EQ(bytes_of(input), bytes_of(output));
}

TEST_F(Improve, AReportThatCannotBeWrittenLeavesNoMesh) {
  for (const std::string& place : {path_in(folder, "no/such/folder/report.json"), folder.path().string()}) {
    const ProgramResult r = improve({"--report", place});
    EXPECT_EQ(r.exit_code, 3);
    EXPECT_THAT(r.err, HasSubstr(place));
    EXPECT_THAT(files_in(folder), ::testing::ElementsAre("in.off"));
  }
}

TEST_F(Improve, TheOutputMayBeADevice) {
  EXPECT_EQ(run_smopt({"improve", input, "-o", "/dev/stdout", "--quiet"}).exit_code, 2) << "a name without a format";
  std::filesystem::create_symlink("/dev/null", path_in(folder, "null.off"));
  EXPECT_EQ(run_smopt({"improve", input, "-o", path_in(folder, "null.off")}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(path_in(folder, "null.off")));
}

// ---- Guards and orders ----

TEST_F(Improve, RunsWithEveryGuardAndOrder) {
  const std::vector<std::vector<std::string>> others = {
      {"--guard", "paper", "--vicinity", "3"}, {"--guard", "none"}, {"--order", "jacobi"}, {"--guard", "paper", "--order", "jacobi"}};
  for (const std::vector<std::string>& options : others) {
    const json report = report_of(options);
    for (std::size_t i = 0; i < options.size(); i += 2) {
      const json& value = report["options"][options[i].substr(2)];
      EXPECT_EQ(value.is_string() ? value.get<std::string>() : value.dump(), options[i + 1]);
    }
    EXPECT_GT(report["moves"]["accepted"], 0) << options[1];
    EXPECT_THAT(read_mesh(output), IsClosedManifold());
  }
}

TEST_F(Improve, TheExactGuardAndGaussSeidelAreTheDefaults) {
  const auto output_of = [&](const std::vector<std::string>& options) {
    EXPECT_EQ(improve(options).exit_code, 0);
    return bytes_of(output);
  };
  const std::string by_default = output_of({});
  EXPECT_TRUE(output_of({"--guard", "exact", "--vicinity", "3", "--order", "gauss-seidel"}) == by_default)
      << "the vicinity is the paper's guard's";
  EXPECT_TRUE(output_of({"--order", "jacobi"}) != by_default);
}

TEST_F(Improve, VerifyShowsWhatTheOtherGuardsLetThrough) {
  // A coarse shell shrinks fast through a fine sphere inside it.
  put_mesh(folder, "in.off", joined(noisy(icosphere(1), 0.03, 1), noisy(icosphere(3, 0.8), 0.01, 1)));
  const auto finds_pairs = [&](const std::string& guard, const std::string& rounds) {
    const ProgramResult r = improve({"--guard", guard, "--rounds", rounds, "--verify", "--json", "--cavities", "keep", "--redundant",
                                     "keep", "--bad-angles", "ignore", "--min-angle", "50", "--edge-ratio", "0.9"});
    const bool has_pairs = json::parse(r.out)["verified"]["pairs_after"] != 0;
    EXPECT_EQ(r.exit_code, has_pairs ? 1 : 0) << guard << ": " << r.err;
    return has_pairs;
  };
  for (const std::string guard : {"paper", "none"})
    EXPECT_TRUE(finds_pairs(guard, "1") || finds_pairs(guard, "2") || finds_pairs(guard, "4") || finds_pairs(guard, "8")) << guard;
  for (const std::string rounds : {"1", "2", "4", "8"}) EXPECT_FALSE(finds_pairs("exact", rounds)) << rounds;
}

TEST_F(Improve, TheReportHasEveryRoundWithItsStuckVertices) {
  for (const std::string guard : {"exact", "paper", "none"}) {
    const json report = report_of({"--guard", guard, "--min-angle", "50", "--rounds", "12"});
    ASSERT_EQ(report["each_round"].size(), report["rounds"].get<std::size_t>());
    ASSERT_GT(report["each_round"].size(), 1U);
    std::size_t accepted = 0, refused = 0;
    for (const json& round : report["each_round"]) {
      const auto number = [&](const char* key) { return round.at(key).get<std::size_t>(); };
      EXPECT_LE(number("accepted") + number("refused") + number("stuck"), number("active")) << guard;
      EXPECT_LE(number("shortened"), number("accepted"));
      accepted += number("accepted");
      refused += number("refused");
    }
    EXPECT_EQ(report["moves"]["accepted"], accepted);
    EXPECT_EQ(report["moves"]["refused"], refused);
    EXPECT_EQ(report["each_round"][0]["active"], mesh.vertex_count());
    EXPECT_EQ(report["each_round"][0]["stuck"], 0);
    EXPECT_TRUE(report["moves"]["stuck"].is_number());
  }
}

TEST_F(Improve, TheReportHasTheVolumeBeforeAndAfterSmoothingAndItsChange) {
  const std::vector<std::string> preserving = {"--step", "volume-preserving", "--min-angle", "50", "--redundant", "keep", "--rounds", "20"};
  std::vector<std::string> all_at_once = preserving;
  all_at_once.insert(all_at_once.end(), {"--order", "jacobi"});
  for (const std::vector<std::string>& options : {preserving, all_at_once}) {
    const json volume = report_of(options)["volume"];
    const double before = volume.at("before_smoothing"), after = volume.at("after_smoothing"), change = volume.at("relative_change");
    EXPECT_NEAR(before / enclosed_volume(mesh), 1, 1e-12);
    EXPECT_NEAR(after / enclosed_volume(read_mesh(output)), 1, 1e-12);
    EXPECT_NEAR(change, after / before - 1, 1e-15);
  }
  EXPECT_LT(std::abs(report_of(preserving)["volume"]["relative_change"].get<double>()), 1e-12);
  EXPECT_GT(std::abs(report_of(all_at_once)["volume"]["relative_change"].get<double>()), 1e-9) << "drifts";
}

TEST_F(Improve, ReportsAnUnknownGuardOrOrderWithTheChoicesThereAre) {
  struct Case {
    std::vector<std::string> options, words;
  };
  const std::vector<Case> cases = {{{"--guard", "nonsense"}, {"guard", "nonsense", "exact", "paper", "none"}},
                                   {{"--order", "random"}, {"order", "random", "gauss-seidel", "jacobi"}},
                                   {{"--guard", "paper", "--vicinity", "0"}, {"vicinity", "1"}},
                                   {{"--vicinity", "0"}, {"vicinity", "1"}},
                                   {{"--vicinity", "-1"}, {"vicinity"}},
                                   {{"--vicinity", "1.5"}, {"vicinity"}},
                                   {{"--guard", ""}, {"guard", "exact"}}};
  for (const auto& [options, words] : cases) {
    const ProgramResult r = improve(options);
    EXPECT_EQ(r.exit_code, 2) << options[1];
    for (const std::string& word : words) EXPECT_THAT(r.err, HasSubstr(word)) << options[0] << " " << options[1];
    EXPECT_THAT(files_in(folder), ::testing::ElementsAre("in.off")) << options[1];
  }
}

}  // namespace
}  // namespace smopt::testing
