#include "experiments/runner.h"

#include <gmock/gmock.h>

#include "baselines/baselines.h"
#include "experiments/record.h"
#include "experiments/record_set.h"
#include "experiments/reproduce.h"
#include "experiments/run_layout.h"
#include "smopt/error.h"
#include "smopt/io/sha256.h"
#include "tests/experiments/made_records.h"
#include "tests/support/files.h"
#include "tests/support/shapes.h"

namespace smopt::experiments {
namespace {

using smopt::testing::bytes_of;
using smopt::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Throws;

/// Four atoms of a protein's backbone, close enough for one component.
constexpr const char* kPqr =
    "ATOM 1 N  ALA 1 0.0 0.0 0.0 -0.3 1.8\n"
    "ATOM 2 CA ALA 1 1.4 0.2 0.1  0.1 1.9\n"
    "ATOM 3 C  ALA 1 2.1 1.5 0.3  0.5 1.9\n"
    "ATOM 4 O  ALA 1 1.6 2.6 0.7 -0.5 1.6\n";

Dataset tiny(const TemporaryFolder& folder, const std::string& name = "tiny") {
  Dataset dataset = testing::made_dataset(name);
  dataset.path = folder.file(name + ".pqr", kPqr);
  return dataset;
}

RunOptions options_for(const TemporaryFolder& folder, std::vector<Dataset> datasets, std::vector<std::string> methods) {
  RunOptions options;
  options.datasets = std::move(datasets);
  options.methods = std::move(methods);
  options.directory = folder.path() / "run";
  return options;
}

Method method_that(const std::string& name, std::function<void(TriangleMesh&)> action) {
  Method method;
  method.name = name;
  method.run = [action](TriangleMesh& mesh, const OptionValues&, const ProgressCallback&) {
    action(mesh);
    return MethodReport{};
  };
  return method;
}

Json record_of(const RunOptions& options, const std::string& molecule, const std::string& method) {
  return Json::parse(bytes_of(record_path(options.directory, molecule, method)));
}

TEST(Runner, RunsEveryCaseOfAMoleculeAndRecordsIt) {
  const TemporaryFolder folder;
  RunOptions options = options_for(folder, {tiny(folder)}, {"initial", "smopt", "laplacian"});
  options.repeats = 2;
  const RunSummary summary = run_cases(options, baselines::all_methods());
  EXPECT_EQ(summary.cases.size(), 3U);
  EXPECT_EQ(summary.count(CaseStatus::failed), 0U);
  for (const std::string method : {"initial", "smopt", "laplacian"}) {
    const Json record = record_of(options, "tiny", method);
    EXPECT_EQ(record.at("status"), "done") << method;
    EXPECT_EQ(record.at("molecule").at("atoms"), 4) << method;
    EXPECT_EQ(record.at("molecule").at("sha256"), sha256_hex(kPqr)) << method;
    EXPECT_EQ(record.at("threads"), 1) << method;
    EXPECT_EQ(record.at("repeats").size(), 2U) << method;
    EXPECT_GT(record.at("peak_memory_mb").get<double>(), 0) << method;
    EXPECT_EQ(record.at("metrics").at("after").at("genus"), 0) << method;
    EXPECT_EQ(record.at("solvation").at("status"), "not computed") << method;
    for (const char* switches : {"p", "pY"}) EXPECT_TRUE(record.at("tetgen").at(switches).contains("status")) << method;
  }
}

TEST(Runner, RecordsTheDistanceToTheLevelSetBeforeAndAfter) {
  const TemporaryFolder folder;
  MethodRegistry registry;
  registry.add(method_that("idle", [](TriangleMesh&) {}));
  registry.add(method_that("shrinking", [](TriangleMesh& mesh) { mesh = testing::scaled(std::move(mesh), 0.9); }));
  const RunOptions options = options_for(folder, {tiny(folder)}, {"initial", "idle", "shrinking"});
  run_cases(options, registry);
  const auto distance = [&](const char* method) { return record_of(options, "tiny", method).at("level_set_distance"); };
  EXPECT_EQ(distance("idle").at("before"), distance("idle").at("after"));
  EXPECT_EQ(distance("initial").at("after"), distance("idle").at("before")) << "four atoms have no cavity";
  EXPECT_EQ(distance("initial").at("after").at("unresolved"), 0);
  EXPECT_GT(distance("shrinking").at("after").at("mean").get<double>(), 3 * distance("shrinking").at("before").at("mean").get<double>());
}

/// The record's solvation of a run of `method` on four atoms.
Json solvation_after(const std::string& method, bool has_solvation, const SolvationSettings& settings) {
  const TemporaryFolder folder;
  Dataset dataset = tiny(folder);
  dataset.has_solvation = has_solvation;
  RunOptions options = options_for(folder, {dataset}, {method});
  options.solvation = settings;
  run_cases(options, baselines::all_methods());
  return record_of(options, "tiny", method).at("solvation");
}

TEST(Runner, ComputesTheSolvationEnergiesThatTable1Shows) {
  for (const std::string method : {"initial", "smopt"}) {
    const Json solvation = solvation_after(method, true, {});
    EXPECT_EQ(solvation.at("status"), "success") << method;
    EXPECT_LT(solvation.at("polar_kcal_per_mol").get<double>(), 0) << method;
    EXPECT_GT(solvation.at("nonpolar_kcal_per_mol").get<double>(), 0) << method;
    EXPECT_EQ(solvation.at("options").at("outer_permittivity"), 80) << method;
  }
  EXPECT_EQ(solvation_after("laplacian", true, {}), Json({{"status", "not computed"}, {"reason", "only for Table 1"}}));
  EXPECT_EQ(solvation_after("smopt", false, {}), Json({{"status", "not computed"}, {"reason", "not for this molecule"}}));
}

TEST(Runner, AQuickRunSolvesForQuickMoleculesOnly) {
  SolvationSettings quick;
  quick.is_quick = true;
  EXPECT_EQ(solvation_after("initial", true, quick).at("reason"), "not in a quick run");
  Dataset dataset;
  dataset.has_solvation = dataset.is_quick = true;
  EXPECT_EQ(solvation_plan(dataset, "initial", quick).why_not, "");
}

TEST(Runner, ASolveThatNeedsTooMuchMemoryIsARowWithTheEstimate) {
  SolvationSettings little;
  little.max_memory_bytes = 1000;
  const Json solvation = solvation_after("initial", true, little);
  EXPECT_EQ(solvation.at("status"), "over limit");
  EXPECT_THAT(solvation.at("reason").get<std::string>(), ::testing::MatchesRegex("needs [1-9][0-9]* MB"));
}

TEST(Runner, ASolveThatFailsIsARowWithItsReason) {
  const TemporaryFolder folder;
  Dataset dataset = tiny(folder);
  dataset.has_solvation = true;
  MethodRegistry registry;
  registry.add(method_that("smopt", [](TriangleMesh& mesh) { mesh.triangles.resize(mesh.triangles.size() / 2); }));
  const RunOptions options = options_for(folder, {dataset}, {"smopt"});
  EXPECT_EQ(run_cases(options, registry).count(CaseStatus::failed), 0U);
  const Json solvation = record_of(options, "tiny", "smopt").at("solvation");
  EXPECT_EQ(solvation.at("status"), "failed");
  EXPECT_FALSE(solvation.at("reason").get<std::string>().empty());
}

TEST(Runner, RecordsEveryOptionWithItsDefault) {
  const TemporaryFolder folder;
  const RunOptions options = options_for(folder, {tiny(folder)}, {"smopt"});
  run_cases(options, baselines::all_methods());
  const Json record = record_of(options, "tiny", "smopt");
  for (const MethodOption& option : baselines::all_methods().find("smopt").options)
    EXPECT_TRUE(record.at("options").contains(option.name)) << option.name;
  EXPECT_EQ(record.at("options").at("rounds"), 100);
}

TEST(Runner, TheInitialMeshIsTheSameBeforeAndAfter) {
  const TemporaryFolder folder;
  const RunOptions options = options_for(folder, {tiny(folder)}, {"initial"});
  run_cases(options, baselines::all_methods());
  const Json record = record_of(options, "tiny", "initial");
  EXPECT_EQ(record.at("metrics").at("before"), record.at("metrics").at("after"));
}

TEST(Runner, EveryMethodGetsTheSameMeshAndTheHashesAreThoseOfTheKeptFiles) {
  const TemporaryFolder folder;
  RunOptions options = options_for(folder, {tiny(folder)}, {"initial", "smopt", "laplacian"});
  options.keeps_meshes = true;
  run_cases(options, baselines::all_methods());
  const auto meshes = options.directory / "meshes" / "tiny";
  for (const std::string method : {"smopt", "laplacian"}) {
    const Json record = record_of(options, "tiny", method);
    EXPECT_EQ(record.at("input").at("sha256"), sha256_of_file(meshes / "without-cavities.off"));
    EXPECT_EQ(record.at("output").at("sha256"), sha256_of_file(meshes / (method + ".off")));
  }
  EXPECT_EQ(record_of(options, "tiny", "initial").at("output").at("sha256"), sha256_of_file(meshes / "initial.off"));
}

TEST(Runner, MethodsGetAMeshWithoutItsCavities) {
  const TemporaryFolder folder;
  Dataset shell = tiny(folder, "shell");
  // Atoms on the corners and faces of a cube around an empty middle: an outer component and a cavity.
  std::string pqr;
  for (int i = 0; i < 27; ++i)
    if (i != 13)
      pqr += "ATOM 1 C X 1 " + std::to_string(3 * (i % 3)) + " " + std::to_string(3 * (i / 3 % 3)) + " " + std::to_string(3 * (i / 9)) +
             " 0 1.7\n";
  shell.path = folder.file("shell.pqr", pqr);
  const RunOptions options = options_for(folder, {shell}, {"initial", "laplacian"});
  run_cases(options, baselines::all_methods());
  const Json initial = record_of(options, "shell", "initial");
  const Json laplacian = record_of(options, "shell", "laplacian");
  EXPECT_EQ(initial.at("metrics").at("after").at("components"), 2);
  EXPECT_EQ(laplacian.at("metrics").at("before").at("components"), 1);
  EXPECT_EQ(laplacian.at("removed").at("cavities"), 1);
  EXPECT_GT(laplacian.at("metrics").at("before").at("volume").get<double>(), initial.at("metrics").at("after").at("volume").get<double>());
}

TEST(Runner, AMethodThatFailsIsARecordWithItsReasonAndTheOthersGoOn) {
  const TemporaryFolder folder;
  MethodRegistry registry;
  registry.add(method_that("throws", [](TriangleMesh&) { throw std::runtime_error("the method's own words \xff"); }));
  registry.add(method_that("runs-out", [](TriangleMesh&) { throw std::bad_alloc(); }));
  registry.add(method_that("nothing", [](TriangleMesh&) {}));
  const RunOptions options = options_for(folder, {tiny(folder)}, {"throws", "runs-out", "nothing"});
  const RunSummary summary = run_cases(options, registry);
  EXPECT_EQ(summary.count(CaseStatus::failed), 2U);
  EXPECT_EQ(record_of(options, "tiny", "throws").at("status"), "failed");
  EXPECT_THAT(record_of(options, "tiny", "throws").at("reason").get<std::string>(), HasSubstr("the method's own words"));
  EXPECT_EQ(record_of(options, "tiny", "runs-out").at("reason"), "out of memory");
  EXPECT_EQ(record_of(options, "tiny", "nothing").at("status"), "done");
}

TEST(Runner, ACaseMayAskForTheVerticesOfAnothersResult) {
  // Of both orders the same: where the other has not run, it is run for its number.
  const TemporaryFolder folder;
  MethodRegistry registry;
  registry.add(method_that("smopt", [](TriangleMesh& mesh) { mesh = testing::icosphere(0); }));
  Method iso2mesh = method_that("iso2mesh", [](TriangleMesh&) {});
  for (const char* name : {"vertices", "placement", "smoother", "alpha", "rounds"})
    iso2mesh.options.push_back({name, MethodOption::Kind::text, "", "", "", {}});
  registry.add(iso2mesh);
  RunOptions options = options_for(folder, {tiny(folder)}, {"iso2mesh"});
  run_cases(options, registry);
  EXPECT_EQ(record_of(options, "tiny", "iso2mesh").at("options").at("vertices"), "12");
  options.methods = {"smopt", "iso2mesh"};
  run_cases(options, registry);
  EXPECT_EQ(record_of(options, "tiny", "iso2mesh").at("options").at("vertices"), "12");
}

TEST(Runner, AVariantOfAMethodIsACaseOfItsOwn) {
  const TemporaryFolder folder;
  const RunOptions options = options_for(folder, {tiny(folder)}, {"meshlab-uniform"});
  run_cases(options, baselines::all_methods());
  const Json record = record_of(options, "tiny", "meshlab-uniform");
  EXPECT_EQ(record.at("registered_method"), "meshlab");
  EXPECT_EQ(record.at("options").at("weights"), "uniform");
  EXPECT_EQ(record.at("options").at("rounds"), 100);
}

TEST(Runner, AMethodWhoseProgramIsAbsentIsNoFailure) {
  const TemporaryFolder folder;
  MethodRegistry registry;
  registry.add(method_that("absent", [](TriangleMesh&) { throw NotInstalled("the program is not here"); }));
  registry.add(method_that("crashes", [](TriangleMesh&) { throw MethodFailed("the program crashed"); }));
  const RunOptions options = options_for(folder, {tiny(folder)}, {"absent", "crashes"});
  const RunSummary summary = run_cases(options, registry);
  EXPECT_EQ(summary.count(CaseStatus::not_installed), 1U);
  EXPECT_EQ(summary.count(CaseStatus::failed), 1U);
  EXPECT_EQ(record_of(options, "tiny", "absent").at("status"), "not installed");
  EXPECT_EQ(record_of(options, "tiny", "absent").at("reason"), "the program is not here");
  EXPECT_EQ(record_of(options, "tiny", "crashes").at("status"), "failed");
}

TEST(Runner, AMethodThatSpoilsTheMeshIsMeasuredAllTheSame) {
  const TemporaryFolder folder;
  MethodRegistry registry;
  registry.add(method_that("spoils", [](TriangleMesh& mesh) { mesh.triangles.resize(mesh.triangles.size() / 2); }));
  const RunOptions options = options_for(folder, {tiny(folder)}, {"spoils"});
  EXPECT_EQ(run_cases(options, registry).count(CaseStatus::failed), 0U);
  const Json record = record_of(options, "tiny", "spoils");
  EXPECT_EQ(record.at("metrics").at("after").at("closed"), false);
  EXPECT_TRUE(record.at("metrics").at("after").at("volume").is_null());
  EXPECT_EQ(record.at("tetgen").at("p").at("status"), "failed");
}

TEST(Runner, AMoleculeThatIsMissingFailsItsCasesAndNamesThePackage) {
  const TemporaryFolder folder;
  Dataset missing = tiny(folder, "missing");
  missing.path = folder.path() / "nowhere.pqr";
  missing.package = "apbs-data";
  const RunOptions options = options_for(folder, {missing, tiny(folder)}, {"initial", "laplacian"});
  const RunSummary summary = run_cases(options, baselines::all_methods());
  EXPECT_EQ(summary.count(CaseStatus::failed), 2U);
  for (const char* method : {"initial", "laplacian"}) {
    const std::string reason = record_of(options, "missing", method).at("reason").get<std::string>();
    EXPECT_THAT(reason, ::testing::AllOf(HasSubstr("nowhere.pqr"), HasSubstr("apbs-data"))) << method;
  }
  EXPECT_EQ(record_of(options, "tiny", "laplacian").at("status"), "done");
}

/// The record without what differs from run to run: times and memory.
Json without_times(Json record) {
  for (const char* key : {"repeats", "seconds", "cpu_seconds", "peak_memory_mb"}) record.erase(key);
  for (Json& outcome : record["tetgen"])
    for (const char* key : {"seconds", "peak_memory_mb"}) outcome.erase(key);
  record["solvation"].erase("seconds");
  return record;
}

TEST(Runner, TheSameRunGivesTheSameRecordsButForTimesAndMemory) {
  const TemporaryFolder folder;
  Dataset dataset = tiny(folder);
  dataset.has_solvation = true;
  RunOptions first = options_for(folder, {dataset}, {"initial", "smopt", "laplacian"});
  RunOptions second = first;
  second.directory = folder.path() / "again";
  run_cases(first, baselines::all_methods());
  run_cases(second, baselines::all_methods());
  for (const char* method : {"initial", "smopt", "laplacian"})
    EXPECT_EQ(without_times(record_of(first, "tiny", method)).dump(), without_times(record_of(second, "tiny", method)).dump()) << method;
}

TEST(Runner, TellsEachCaseAsItEndsAndHowFarItIs) {
  const TemporaryFolder folder;
  MethodRegistry registry;
  registry.add(method_that("throws", [](TriangleMesh&) { throw std::runtime_error("no luck"); }));
  std::vector<std::string> lines;
  double last_fraction = 0;
  RunObserver observer;
  observer.line = [&](std::string_view line) { lines.emplace_back(line); };
  observer.progress = [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last_fraction);
    EXPECT_LE(fraction, 1);
    last_fraction = fraction;
    return true;
  };
  run_cases(options_for(folder, {tiny(folder)}, {"initial", "throws"}), registry, observer);
  EXPECT_THAT(lines, ElementsAre(::testing::AllOf(HasSubstr("[1/2] tiny initial"), HasSubstr("0 intersecting pairs"), HasSubstr("left")),
                                 HasSubstr("[2/2] tiny throws: failed: no luck")));
  EXPECT_GT(last_fraction, 0);
}

TEST(Runner, StopsWhenItIsCancelledAndKeepsWhatIsDone) {
  const TemporaryFolder folder;
  const RunOptions options = options_for(folder, {tiny(folder)}, {"initial", "laplacian"});
  bool has_ended = false;
  RunObserver observer;
  observer.line = [&](std::string_view) { has_ended = true; };
  observer.progress = [&](std::string_view, double) { return !has_ended; };
  EXPECT_THAT([&] { run_cases(options, baselines::all_methods(), observer); }, Throws<Cancelled>());
  EXPECT_EQ(record_of(options, "tiny", "initial").at("status"), "done");
  EXPECT_FALSE(std::filesystem::exists(record_path(options.directory, "tiny", "laplacian")));
}

TEST(Runner, RefusesAnUnknownMethodBeforeAnythingRuns) {
  const TemporaryFolder folder;
  const RunOptions options = options_for(folder, {tiny(folder)}, {"initial", "smoppt"});
  EXPECT_THAT([&] { run_cases(options, baselines::all_methods()); }, Throws<InvalidOption>());
  EXPECT_FALSE(std::filesystem::exists(options.directory));
}

TEST(Reproduce, GivesRecordsTablesAndFiguresOfASmallMolecule) {
  const TemporaryFolder folder;
  ReproduceOptions options;
  options.directory = folder.path();
  options.molecules = {"fas2"};
  options.is_quick = true;
  if (smopt::testing::apbs_molecule("misc/fas2.pqr").empty()) GTEST_SKIP() << "apbs-data is not installed";
  EXPECT_EQ(reproduce(options).count(CaseStatus::failed), 0U);
  for (const char* name :
       {"tables/table1.md", "tables/table2.csv", "tables/table3.tex", "figures/fig5.svg", "figures/fig6.png", "figures/fig7.svg"})
    EXPECT_FALSE(bytes_of(folder.path() / name).empty()) << name;
  const RecordSet records = RecordSet::load(folder.path());
  EXPECT_EQ(number_at(records.find("fas2", "smopt"), "/metrics/after/intersecting_pairs"), 0);
  EXPECT_EQ(number_at(records.find("fas2", "smopt"), "/metrics/after/components"), 1);
  EXPECT_EQ(text_at(records.find("fas2", "smopt"), "/solvation/status"), "success");
}

TEST(Reproduce, RefusesAnUnknownMolecule) {
  ReproduceOptions options;
  options.molecules = {"fas3"};
  EXPECT_THAT([&] { reproduce(options); }, Throws<InvalidOption>());
}

}  // namespace
}  // namespace smopt::experiments
