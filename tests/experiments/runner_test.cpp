#include "experiments/runner.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "baselines/baselines.h"
#include "experiments/record.h"
#include "experiments/record_set.h"
#include "experiments/reproduce.h"
#include "experiments/run/run_lock.h"
#include "experiments/run_layout.h"
#include "smopt/error.h"
#include "smopt/io/sha256.h"
#include "tests/experiments/made_records.h"
#include "tests/experiments/records_alike.h"
#include "tests/support/files.h"

namespace smopt::experiments {
namespace {

namespace fs = std::filesystem;
using smopt::testing::bytes_of;
using smopt::testing::TemporaryFolder;
using smopt::testing::without_times;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Throws;
using ::testing::ThrowsMessage;

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

RunOptions options_for(const TemporaryFolder& folder, std::vector<Dataset> datasets, const std::vector<std::string>& methods) {
  RunOptions options;
  options.program = SMOPT_PROGRAM;
  options.datasets = std::move(datasets);
  for (const std::string& name : methods) options.cases.push_back(find_method_case(name));
  options.directory = folder.path() / "run";
  options.simulates = false;
  return options;
}

/// The program, which does what `line` of shell says where its arguments are like `pattern`.
fs::path program_that(const TemporaryFolder& folder, const std::string& pattern, const std::string& line) {
  const fs::path program =
      folder.file("program", "#!/bin/sh\ncase \"$*\" in " + pattern + ") " + line + ";; esac\nexec " SMOPT_PROGRAM " \"$@\"\n");
  fs::permissions(program, fs::perms::owner_all);
  return program;
}

Json record_of(const RunOptions& options, const std::string& molecule, const std::string& method) {
  return Json::parse(bytes_of(record_path(options.directory, molecule, method)));
}

TEST(Runner, RunsEveryCaseOfAMoleculeAndRecordsIt) {
  const TemporaryFolder folder;
  RunOptions options = options_for(folder, {tiny(folder)}, {"initial", "smopt", "laplacian"});
  options.repeats = 2;
  options.simulates = true;
  const RunSummary summary = run_cases(options);
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
    for (const char* switches : {"p", "pY"}) EXPECT_EQ(record.at("tetgen").at(switches).at("status"), "success") << method;
    EXPECT_GT(record.at("level_set_distance").at("after").at("mean").get<double>(), 0) << method;
    EXPECT_EQ(record.at("provenance").at("program_sha256"), sha256_of_file(SMOPT_PROGRAM)) << method;
  }
}

/// The record's solvation of a run of `method` on four atoms.
Json solvation_after(const std::string& method, const SolvationSettings& settings) {
  const TemporaryFolder folder;
  Dataset dataset = tiny(folder);
  dataset.has_solvation = true;
  RunOptions options = options_for(folder, {dataset}, {method});
  options.simulates = true;
  options.solvation = settings;
  run_cases(options);
  return record_of(options, "tiny", method).at("solvation");
}

TEST(Runner, ComputesTheSolvationEnergiesThatTable1Shows) {
  for (const std::string method : {"initial", "smopt"}) {
    const Json solvation = solvation_after(method, {});
    EXPECT_EQ(solvation.at("status"), "success") << method;
    EXPECT_LT(solvation.at("polar_kcal_per_mol").get<double>(), 0) << method;
    EXPECT_GT(solvation.at("nonpolar_kcal_per_mol").get<double>(), 0) << method;
    EXPECT_EQ(solvation.at("options").at("outer_permittivity"), 80) << method;
  }
}

TEST(Runner, ASolveThatNeedsTooMuchMemoryIsARowWithTheEstimate) {
  SolvationSettings little;
  little.max_memory_bytes = 1000;
  const Json solvation = solvation_after("initial", little);
  EXPECT_EQ(solvation.at("status"), "over limit");
  EXPECT_THAT(solvation.at("reason").get<std::string>(), ::testing::MatchesRegex("needs [1-9][0-9]* MB"));
}

TEST(Runner, ASolveThatTakesTooLongIsARowThatSaysSo) {
  const TemporaryFolder folder;
  Dataset dataset = tiny(folder);
  dataset.has_solvation = true;
  RunOptions options = options_for(folder, {dataset}, {"initial"});
  options.simulates = true;
  options.program = program_that(folder, "solvate*", "sleep 100");
  options.step_seconds = 20;  // of which the others take little
  EXPECT_EQ(run_cases(options).count(CaseStatus::failed), 0U);
  const Json solvation = record_of(options, "tiny", "initial").at("solvation");
  EXPECT_EQ(solvation.at("status"), "over limit");
  EXPECT_EQ(solvation.at("reason"), "not finished after 20 s");
}

TEST(Runner, RecordsEveryOptionWithItsDefault) {
  const TemporaryFolder folder;
  const RunOptions options = options_for(folder, {tiny(folder)}, {"smopt"});
  run_cases(options);
  const Json record = record_of(options, "tiny", "smopt");
  for (const MethodOption& option : baselines::all_methods().find("smopt").options)
    EXPECT_TRUE(record.at("options").contains(option.name)) << option.name;
  EXPECT_EQ(record.at("options").at("rounds"), 100);
  EXPECT_EQ(record.at("options").at("cavities"), "delete");
}

TEST(Runner, TheInitialMeshIsTheSameBeforeAndAfter) {
  const TemporaryFolder folder;
  const RunOptions options = options_for(folder, {tiny(folder)}, {"initial"});
  run_cases(options);
  const Json record = record_of(options, "tiny", "initial");
  EXPECT_EQ(record.at("metrics").at("before"), record.at("metrics").at("after"));
}

TEST(Runner, EveryMethodGetsTheSameMeshAndTheHashesAreThoseOfTheMeshes) {
  const TemporaryFolder folder;
  RunOptions options = options_for(folder, {tiny(folder)}, {"initial", "smopt", "laplacian"});
  options.keeps_meshes = true;
  run_cases(options);
  const auto digest = [&](const char* subject) { return sha256_of_file(*find_mesh(options.directory, "tiny", subject)); };
  for (const char* method : {"smopt", "laplacian"}) {
    const Json record = record_of(options, "tiny", method);
    EXPECT_EQ(record.at("input").at("sha256"), digest("without-cavities"));
    EXPECT_EQ(record.at("output").at("sha256"), digest(method));
    EXPECT_FALSE(bytes_of(options.directory / "meshes" / "tiny" / (std::string(method) + ".off")).empty());
  }
  EXPECT_EQ(record_of(options, "tiny", "initial").at("output").at("sha256"), digest("initial"));
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
  run_cases(options);
  const Json initial = record_of(options, "shell", "initial");
  const Json laplacian = record_of(options, "shell", "laplacian");
  EXPECT_EQ(initial.at("metrics").at("after").at("components"), 2);
  EXPECT_EQ(laplacian.at("metrics").at("before").at("components"), 1);
  EXPECT_EQ(laplacian.at("removed").at("cavities"), 1);
  EXPECT_GT(laplacian.at("metrics").at("before").at("volume").get<double>(), initial.at("metrics").at("after").at("volume").get<double>());
}

/// What becomes of a run in which the program does what `line` says when it is to improve a mesh by the plain Laplacian.
Json record_where_laplacian(const std::string& line, std::size_t memory_mb = 0) {
  const TemporaryFolder folder;
  RunOptions options = options_for(folder, {tiny(folder)}, {"laplacian", "smopt"});
  options.program = program_that(folder, "*laplacian.ply*", line);
  options.step_seconds = 20;
  options.step_memory_mb = memory_mb;
  EXPECT_EQ(run_cases(options).count(CaseStatus::failed), 1U) << line;
  EXPECT_EQ(record_of(options, "tiny", "smopt").at("status"), "done") << "the others go on: " << line;
  return record_of(options, "tiny", "laplacian");
}

TEST(Runner, AMethodThatFailsCrashesOrHangsIsARowWithItsReasonAndTheOthersGoOn) {
  EXPECT_THAT(record_where_laplacian("echo \"smopt: the method's own words \\377\" >&2; exit 1").at("reason").get<std::string>(),
              HasSubstr("the method's own words"));
  EXPECT_THAT(record_where_laplacian("kill -SEGV $$").at("reason").get<std::string>(), HasSubstr("crashed (signal 11"));
  const Json record = record_where_laplacian("sleep 1000");
  EXPECT_EQ(record.at("status"), "failed");
  EXPECT_EQ(record.at("reason"), "not finished after 20 s");
  EXPECT_EQ(record.at("molecule").at("atoms"), 4) << "it is filled as far as it got";
}

TEST(Runner, AMethodThatEatsMemoryIsARowWithItsReason) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "there is no limit under AddressSanitizer";
#endif
  // The limit is above what the program itself takes.
  const std::string eat = "dd if=/dev/zero of=/dev/null bs=4G count=1 || { echo 'smopt: out of memory' >&2; exit 4; }";
  EXPECT_EQ(record_where_laplacian(eat, 1000).at("reason"), "out of memory: more than 1000 MB");
}

TEST(Runner, AMethodWhoseProgramIsAbsentIsNoFailure) {
  const TemporaryFolder folder;
  RunOptions options = options_for(folder, {tiny(folder)}, {"laplacian"});
  options.program = program_that(folder, "*laplacian.ply*", "echo 'smopt: not installed: the program is not here' >&2; exit 1");
  const RunSummary summary = run_cases(options);
  EXPECT_EQ(summary.count(CaseStatus::not_installed), 1U);
  EXPECT_EQ(summary.count(CaseStatus::failed), 0U);
  EXPECT_EQ(record_of(options, "tiny", "laplacian").at("status"), "not installed");
  EXPECT_EQ(record_of(options, "tiny", "laplacian").at("reason"), "the program is not here");
}

TEST(Runner, ACaseMayAskForTheVerticesOfAnothersResult) {
  const TemporaryFolder folder;
  const RunOptions options = options_for(folder, {tiny(folder)}, {"iso2mesh", "smopt"});
  run_cases(options);
  const Json options_of_iso2mesh = record_of(options, "tiny", "iso2mesh").at("options");
  EXPECT_EQ(options_of_iso2mesh.at("vertices"), record_of(options, "tiny", "smopt").at("output").at("vertices"));
  EXPECT_FALSE(options_of_iso2mesh.contains("match"));
}

TEST(Runner, AVariantOfAMethodIsACaseOfItsOwn) {
  const TemporaryFolder folder;
  RunOptions options = options_for(folder, {tiny(folder)}, {"meshlab-uniform", "smopt"});
  options.cases[1].options["guard"] = "none";
  run_cases(options);
  const Json record = record_of(options, "tiny", "meshlab-uniform");
  EXPECT_EQ(record.at("registered_method"), "meshlab");
  EXPECT_EQ(record.at("options").at("weights"), "uniform");
  EXPECT_EQ(record_of(options, "tiny", "smopt").at("options").at("guard"), "none");
}

TEST(Runner, AMoleculeThatIsMissingFailsItsCasesAndNamesThePackage) {
  const TemporaryFolder folder;
  Dataset missing = tiny(folder, "missing");
  missing.path = folder.path() / "nowhere.pqr";
  missing.package = "apbs-data";
  const RunOptions options = options_for(folder, {missing, tiny(folder)}, {"initial", "laplacian"});
  const RunSummary summary = run_cases(options);
  EXPECT_EQ(summary.count(CaseStatus::failed), 2U);
  for (const char* method : {"initial", "laplacian"}) {
    const std::string reason = record_of(options, "missing", method).at("reason").get<std::string>();
    EXPECT_THAT(reason, AllOf(HasSubstr("nowhere.pqr"), HasSubstr("apbs-data"))) << method;
  }
  EXPECT_EQ(record_of(options, "tiny", "laplacian").at("status"), "done");
}

TEST(Runner, AReadyMeshIsACaseLikeAnyOther) {
  const TemporaryFolder folder;
  const RunOptions made = options_for(folder, {tiny(folder)}, {"initial", "smopt"});
  run_cases(made);
  Dataset mesh = testing::made_dataset("mesh");
  mesh.path.clear();
  mesh.mesh = *find_mesh(made.directory, "tiny", "initial");
  RunOptions options = options_for(folder, {mesh}, {"initial", "smopt"});
  options.directory = folder.path() / "of-meshes";
  EXPECT_EQ(run_cases(options).count(CaseStatus::done), 2U);
  EXPECT_EQ(record_of(options, "mesh", "smopt").at("output"), record_of(made, "tiny", "smopt").at("output"));
}

TEST(Runner, TheSameRunGivesTheSameRecordsButForTimesAndMemory) {
  const TemporaryFolder folder;
  Dataset dataset = tiny(folder);
  dataset.has_solvation = true;
  RunOptions first = options_for(folder, {dataset}, {"initial", "smopt", "laplacian"});
  first.simulates = true;
  RunOptions second = first;
  second.directory = folder.path() / "again";
  second.jobs = 1;
  run_cases(first);
  run_cases(second);
  for (const char* method : {"initial", "smopt", "laplacian"})
    EXPECT_EQ(without_times(record_of(first, "tiny", method)).dump(), without_times(record_of(second, "tiny", method)).dump()) << method;
}

TEST(Runner, ResumingDoesNothingAgainThatWasDone) {
  const TemporaryFolder folder;
  RunOptions options = options_for(folder, {tiny(folder)}, {"initial", "smopt", "laplacian"});
  const std::size_t steps = run_cases(options).steps_run;
  const std::string before = bytes_of(record_path(options.directory, "tiny", "smopt"));
  options.resumes = true;
  const RunSummary again = run_cases(options);
  EXPECT_EQ(again.steps_run, 0U);
  EXPECT_EQ(again.steps_reused, steps);
  EXPECT_EQ(bytes_of(record_path(options.directory, "tiny", "smopt")), before) << "the times, too, are those of the run that was";
  options.resumes = false;
  EXPECT_EQ(run_cases(options).steps_run, steps);
}

TEST(Runner, ResumingDoesAgainWhatAnotherOptionChanges) {
  const TemporaryFolder folder;
  RunOptions options = options_for(folder, {tiny(folder)}, {"initial", "smopt", "laplacian"});
  run_cases(options);
  options.resumes = true;
  options.cases[2].options["rounds"] = "3";
  EXPECT_EQ(run_cases(options).steps_run, 2U) << "improve and measure";
  EXPECT_EQ(record_of(options, "tiny", "laplacian").at("rounds"), 3);
}

TEST(Runner, WhatFailedIsTriedAgainWhereThatIsAskedFor) {
  const TemporaryFolder folder;
  RunOptions options = options_for(folder, {tiny(folder)}, {"laplacian"});
  const fs::path luck = folder.path() / "luck";
  options.program = program_that(folder, "*laplacian.ply*", "test -e " + luck.string() + " || exit 3");
  options.resumes = true;
  EXPECT_EQ(run_cases(options).count(CaseStatus::failed), 1U);
  static_cast<void>(folder.file("luck", ""));
  EXPECT_EQ(run_cases(options).count(CaseStatus::failed), 1U) << "a failure is remembered";
  options.retries = true;
  EXPECT_EQ(run_cases(options).count(CaseStatus::failed), 0U);
}

TEST(Runner, TwoRunsInOneFolderAreRefused) {
  const TemporaryFolder folder;
  const RunOptions options = options_for(folder, {tiny(folder)}, {"initial"});
  const RunLock other(options.directory);
  EXPECT_THAT([&] { run_cases(options); }, ThrowsMessage<InvalidInput>(HasSubstr("another run")));
}

TEST(Runner, AStepAtATimeGivesTheSameRecordsAsTheRun) {
  const TemporaryFolder folder;
  RunOptions options = options_for(folder, {tiny(folder)}, {"initial", "smopt", "iso2mesh"});
  options.simulates = true;
  run_cases(options);
  RunOptions planned = options;
  planned.directory = folder.path() / "planned";
  const RunPlan plan = write_plan(planned);
  EXPECT_FALSE(fs::exists(planned.directory / "steps"));
  for (const Step& step : plan.steps) run_planned_step({planned.directory / "plan.json", step.id, planned.program}, {});
  for (const char* method : {"initial", "smopt", "iso2mesh"})
    EXPECT_EQ(without_times(record_of(planned, "tiny", method)).dump(), without_times(record_of(options, "tiny", method)).dump()) << method;
  EXPECT_THAT(
      [&] {
        run_planned_step({planned.directory / "plan.json", "tiny/none.improve", planned.program}, {});
      },
      Throws<InvalidOption>());
}

TEST(Runner, TellsEachCaseAsItEndsAndHowFarItIs) {
  const TemporaryFolder folder;
  RunOptions options = options_for(folder, {tiny(folder)}, {"initial", "laplacian"});
  options.program = program_that(folder, "*laplacian.ply*", "echo 'smopt: no luck' >&2; exit 3");
  std::vector<std::string> lines, running;
  double last_fraction = 0;
  RunObserver observer;
  observer.line = [&](std::string_view line) { lines.emplace_back(line); };
  observer.progress = [&](std::string_view what, double fraction) {
    EXPECT_GE(fraction, last_fraction);
    EXPECT_LE(fraction, 1);
    last_fraction = fraction;
    running.emplace_back(what);
    return true;
  };
  run_cases(options, observer);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("tiny initial"), HasSubstr("0 intersecting pairs"))));
  EXPECT_THAT(lines, Contains(HasSubstr("tiny laplacian: failed: no luck")));
  EXPECT_THAT(lines.front(), AllOf(HasSubstr("[1/2]"), HasSubstr("left")));
  EXPECT_THAT(lines.back(), HasSubstr("[2/2]"));
  EXPECT_EQ(last_fraction, 1);
}

TEST(Runner, StopsWhenItIsCancelledAndGoesOnWhereItWas) {
  const TemporaryFolder folder;
  RunOptions options = options_for(folder, {tiny(folder)}, {"initial", "laplacian"});
  options.program = program_that(folder, "measure*laplacian.ply*", "test -e " + (folder.path() / "go").string() + " || sleep 1000");
  RunObserver observer;
  observer.progress = [&](std::string_view running, double) { return running.find("laplacian.measure") == std::string_view::npos; };
  EXPECT_THAT([&] { run_cases(options, observer); }, Throws<Cancelled>());
  EXPECT_FALSE(fs::exists(record_path(options.directory, "tiny", "laplacian")));
  static_cast<void>(folder.file("go", ""));
  options.resumes = true;
  const RunSummary rest = run_cases(options);
  EXPECT_EQ(rest.count(CaseStatus::done), 2U);
  EXPECT_GE(rest.steps_reused, 3U);
}

TEST(Runner, RefusesAnUnknownMethodBeforeAnythingRuns) {
  const TemporaryFolder folder;
  const RunOptions options = options_for(folder, {tiny(folder)}, {"initial", "smoppt"});
  EXPECT_THAT([&] { run_cases(options); }, Throws<InvalidOption>());
  EXPECT_FALSE(fs::exists(options.directory / "steps"));
}

TEST(Reproduce, GivesRecordsTablesAndFiguresOfASmallMolecule) {
  const TemporaryFolder folder;
  ReproduceOptions options;
  options.run.program = SMOPT_PROGRAM;
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

TEST(Reproduce, ChoosesMoleculesByNameSuiteAndFolder) {
  const TemporaryFolder folder;
  static_cast<void>(folder.file("mine.pqr", kPqr));
  const auto chosen = [&](const ReproduceOptions& options) {
    std::vector<std::string> names;
    for (const Dataset& dataset : run_options(options).datasets) names.push_back(dataset.name);
    return names;
  };
  ReproduceOptions options;
  EXPECT_THAT(chosen(options), ::testing::Not(Contains("mine")));
  options.data = folder.path();
  EXPECT_THAT(chosen(options), AllOf(Contains("mine"), Contains("ache-monomer")));
  EXPECT_THAT(left_out_of_folder(options), ::testing::IsEmpty());
  options.is_quick = true;
  EXPECT_THAT(chosen(options), ::testing::UnorderedElementsAre("fas2", "1a63", "hca-coarse"));
  EXPECT_THAT(left_out_of_folder(options), ::testing::ElementsAre("mine"));
  options = {};
  options.molecules = {"fas2"};
  EXPECT_THAT(chosen(options), ::testing::ElementsAre("fas2"));
}

TEST(Reproduce, OverridesAnOptionOfOneCase) {
  ReproduceOptions options;
  options.molecules = {"fas2"};
  options.methods = {"initial", "smopt", "external:meshlab"};
  options.overrides = {"smopt:guard=none", "external:meshlab:rounds=5"};
  const RunOptions run = run_options(options);
  EXPECT_EQ(run.cases[1].options.at("guard"), "none");
  EXPECT_EQ(run.cases[2].options.at("rounds"), "5");
  EXPECT_EQ(run.cases[0].title, find_method_case("initial").title);
  EXPECT_EQ(run.cases[1].title, "SMOPT (guard=none)");
  for (const char* wrong : {"smopt", "smopt:guard", "guard=none", "laplacian:rounds=1"}) {
    options.overrides = {wrong};
    EXPECT_THAT([&] { run_options(options); }, Throws<InvalidOption>()) << wrong;
  }
}

TEST(Reproduce, RefusesAnUnknownMolecule) {
  ReproduceOptions options;
  options.molecules = {"fas3"};
  EXPECT_THAT([&] { reproduce(options); }, Throws<InvalidOption>());
}

}  // namespace
}  // namespace smopt::experiments
