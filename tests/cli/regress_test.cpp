#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "smopt/io/file.h"
#include "tests/cli/smopt_program.h"

namespace smopt::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// A record as far as the gate looks at it.
json record_with_pairs(int pairs) {
  return {{"schema_version", 1},
          {"status", "done"},
          {"molecule", {{"name", "made"}}},
          {"method", "smopt"},
          {"registered_method", "smopt"},
          {"metrics", {{"after", {{"intersecting_pairs", pairs}}}}}};
}

/// A folder in the test's own with one such record.
std::string put_run(const TemporaryFolder& folder, const std::string& name, const json& record) {
  const std::filesystem::path records = folder.path() / name / "records" / "made";
  std::filesystem::create_directories(records);
  write_file(records / "smopt.json", record.dump());
  return (folder.path() / name).string();
}

TEST(Regress, ExitsWithOneWhereSomethingIsWorseAndNamesIt) {
  const TemporaryFolder folder;
  const std::string reference = put_run(folder, "reference", record_with_pairs(0));
  const ProgramResult r = run_smopt({"regress", put_run(folder, "run", record_with_pairs(3)), reference});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_THAT(r.out, HasSubstr("made, smopt: intersecting_pairs 0 → 3"));
  EXPECT_THAT(r.out, HasSubstr("RED"));
}

TEST(Regress, ExitsWithZeroWhereNothingIsWorse) {
  const TemporaryFolder folder;
  const std::string reference = put_run(folder, "reference", record_with_pairs(0));
  const ProgramResult r = run_smopt({"regress", put_run(folder, "run", record_with_pairs(0)), reference, "--complete", "--json"});
  EXPECT_EQ(r.exit_code, 0);
  EXPECT_EQ(json::parse(r.out).at("verdict"), "green");
}

TEST(Regress, CompleteAsksForTheCasesOfTheMoleculesThatAreNamed) {
  const TemporaryFolder folder;
  json other = record_with_pairs(0), laplacian = record_with_pairs(0);
  other["molecule"]["name"] = "other";
  laplacian["method"] = "laplacian";
  const std::string run = put_run(folder, "run", record_with_pairs(0)), reference = put_run(folder, "reference", record_with_pairs(0));
  write_file(folder.path() / "reference" / "records" / "made" / "other.json", other.dump());
  EXPECT_EQ(run_smopt({"regress", run, reference, "--complete"}).exit_code, 1);
  EXPECT_EQ(run_smopt({"regress", run, reference, "--complete", "--molecules", "made"}).exit_code, 0);
  EXPECT_EQ(run_smopt({"regress", run, reference, "--complete", "--molecules", "made,other"}).exit_code, 1) << "the run lost it";
  const ProgramResult unknown = run_smopt({"regress", run, reference, "--molecules", "made,maed"});
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.err, HasSubstr("a molecule 'maed'"));
  write_file(folder.path() / "reference" / "records" / "made" / "laplacian.json", laplacian.dump());
  EXPECT_EQ(run_smopt({"regress", run, reference, "--complete", "--molecules", "made"}).exit_code, 1);
}

TEST(Regress, AcceptMakesTheRunTheReference) {
  const TemporaryFolder folder;
  const std::string reference = put_run(folder, "reference", record_with_pairs(0)), run = put_run(folder, "run", record_with_pairs(3));
  const ProgramResult r = run_smopt({"regress", run, reference, "--accept"});
  EXPECT_EQ(r.exit_code, 0);
  EXPECT_THAT(r.out, HasSubstr("accepted: 1 record"));
  EXPECT_EQ(run_smopt({"regress", run, reference}).exit_code, 0);
}

TEST(Regress, RefusesToAcceptARunIntoItself) {
  const TemporaryFolder folder;
  const std::string run = put_run(folder, "run", record_with_pairs(0));
  EXPECT_EQ(run_smopt({"regress", run, run + "/", "--accept"}).exit_code, 2);
}

TEST(Regress, ExitsWithThreeForFoldersThatAreNoRunsOrHaveNoCaseInCommon) {
  const TemporaryFolder folder;
  const std::string run = put_run(folder, "run", record_with_pairs(0));
  json other = record_with_pairs(0);
  other["molecule"]["name"] = "another";
  EXPECT_EQ(run_smopt({"regress", run, path_in(folder, "nowhere")}).exit_code, 3);
  EXPECT_EQ(run_smopt({"regress", run, put_run(folder, "other", other)}).exit_code, 3);
  EXPECT_EQ(run_smopt({"regress", run}).exit_code, 2);
}

TEST(Regress, TakesTolerancesOfTheUsers) {
  const TemporaryFolder folder;
  const std::string reference = put_run(folder, "reference", record_with_pairs(0)), run = put_run(folder, "run", record_with_pairs(3));
  const auto tolerances = [&](const std::string& text) { return folder.file("mine.json", text).string(); };
  const std::string lax = R"({"tolerances": [{"metrics": ["intersecting_pairs"], "absolute": 5, "why": "an experiment"}]})";
  EXPECT_EQ(run_smopt({"regress", run, reference, "--tolerances", tolerances(lax)}).exit_code, 0);
  const ProgramResult r = run_smopt({"regress", run, reference, "--tolerances", tolerances("{")});
  EXPECT_EQ(r.exit_code, 3);
  EXPECT_THAT(r.err, HasSubstr("mine.json"));
}

/// A molecule whose mesh at this spacing gives pairs when nothing looks after them (14 in 12 000 vertices).
constexpr const char* kMolecule = "hca-bind/hca.pqr";
constexpr const char* kSpacing = "1.3";

/// The run of one case: the molecule's surface improved by smopt with this guard, and measured.
std::string run_with_guard(const TemporaryFolder& folder, const std::string& surface, const std::string& guard) {
  const std::string improved = path_in(folder, guard + ".off");
  EXPECT_EQ(run_smopt({"improve", surface, "-o", improved, "--guard", guard}).exit_code, 0);
  json record = record_with_pairs(0);
  record["options"] = {{"guard", guard}};
  record["metrics"]["after"] = json::parse(run_smopt({"measure", improved, "--json"}).out);
  return put_run(folder, guard, record);
}

TEST(Regress, TheGuardBrokenOnPurposeIsRedAndRestoredIsGreen) {
  const std::filesystem::path molecule = apbs_molecule(kMolecule);
  if (molecule.empty()) GTEST_SKIP() << "apbs-data is not installed";
  const TemporaryFolder folder;
  const std::string surface = path_in(folder, "surface.off");
  ASSERT_EQ(run_smopt({"generate", molecule.string(), "-o", surface, "--spacing", kSpacing}).exit_code, 0);
  const std::string reference = run_with_guard(folder, surface, "exact");
  const ProgramResult broken = run_smopt({"regress", run_with_guard(folder, surface, "none"), reference});
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_THAT(broken.out, HasSubstr("intersecting_pairs 0 → "));
  EXPECT_THAT(broken.out, HasSubstr("--guard: \"exact\" → \"none\""));
  const TemporaryFolder restored;
  EXPECT_EQ(run_smopt({"regress", run_with_guard(restored, surface, "exact"), reference}).exit_code, 0);
}

}  // namespace
}  // namespace smopt::testing
