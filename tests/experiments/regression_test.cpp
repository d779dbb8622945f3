#include <gmock/gmock.h>

#include <algorithm>

#include "experiments/regression/accept.h"
#include "experiments/regression/compare.h"
#include "experiments/regression/comparison_text.h"
#include "experiments/regression/tolerance.h"
#include "experiments/run_layout.h"
#include "metrics/registry.h"
#include "smopt/error.h"
#include "smopt/io/file.h"
#include "tests/experiments/made_records.h"
#include "tests/support/files.h"

namespace smopt::experiments {
namespace {

using smopt::testing::bytes_of;
using smopt::testing::failed_record;
using smopt::testing::made_dataset;
using smopt::testing::made_record;
using smopt::testing::set_solvation;
using smopt::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::Throws;

/// A record with every value that the gate looks at.
Json full_record(const std::string& method = "smopt", const std::string& molecule = "fas2") {
  Json record = made_record(made_dataset(molecule), method);
  Json& after = record["metrics"]["after"];
  after["intersecting_pairs"] = 0;
  for (const char* flag : {"closed", "edge_manifold", "vertex_manifold", "oriented"}) after[flag] = true;
  for (const char* count : {"components", "euler_characteristic", "genus", "isolated_vertices", "duplicate_vertices",
                            "degenerate_triangles", "nonfinite_vertices"})
    after[count] = 1;
  for (const auto& [key, value] : {std::pair("min", 0.3), std::pair("mean", 0.7), std::pair("median", 0.7), std::pair("below_0.1", 0.01)})
    after["edge_ratio"][key] = value;
  for (const auto& [key, value] : {std::pair("min", 30.0), std::pair("max", 110.0), std::pair("mean_min", 45.0)})
    after["angle_deg"][key] = value;
  after["min_angle_share"] = {{"below_5", 0.01}, {"below_10", 0.02}, {"below_20", 0.03}, {"below_30", 0.04}};
  after["max_angle_share"] = {{"above_120", 0.02}, {"above_150", 0.01}};
  after["valence"] = {{"min", 4}, {"max", 9}, {"share_6", 0.6}, {"share_5_6_7", 0.9}};
  record["level_set_distance"] = {{"before", {{"mean", 0.05}, {"largest", 0.5}}}, {"after", {{"mean", 0.06}, {"largest", 0.6}}}};
  record["tetgen"] = {{"p", {{"status", "success"}}}, {"pY", {{"status", "success"}}}, {"pq1.4", {{"status", "success"}}}};
  record["peak_memory_mb"] = 100.0;
  record["cpu_seconds"] = {{"total", 1.0}};
  set_solvation(record, -100, 17, 0);
  return record;
}

RecordSet records_of(const std::vector<Json>& list) {
  RecordSet records;
  for (const Json& record : list) records.add(record, "made for a test");
  return records;
}

Json with(Json record, const std::string& pointer, const Json& value) {
  record[Json::json_pointer(pointer)] = value;
  return record;
}

Comparison compared(const Json& now, const Json& reference) {
  return compare(records_of({now}), records_of({reference}), default_tolerances());
}

std::vector<std::string> quantities_of(const std::vector<Difference>& differences) {
  std::vector<std::string> names;
  for (const Difference& difference : differences) names.push_back(difference.quantity);
  return names;
}

TEST(Regression, TheSameRecordsAreGreenAndSaysHowMuchWasCompared) {
  const Comparison comparison = compared(full_record(), full_record());
  EXPECT_FALSE(is_red(comparison, true));
  EXPECT_THAT(comparison.better, IsEmpty());
  EXPECT_THAT(comparison.shown, IsEmpty());
  EXPECT_GT(comparison.values, 35U);
}

/// A value of a record of `smopt`, changed so that it is worse.
struct Worsening {
  std::string pointer;
  Json value;
  std::string quantity;
};

class EveryQuantity : public ::testing::TestWithParam<Worsening> {};

TEST_P(EveryQuantity, ThatGetsWorseIsRedAndGreenAgainOnceItIsRestored) {
  const Json worse = with(full_record(), GetParam().pointer, GetParam().value);
  const Comparison comparison = compared(worse, full_record());
  EXPECT_TRUE(is_red(comparison, false));
  EXPECT_THAT(quantities_of(comparison.worse), ElementsAre(GetParam().quantity));
  EXPECT_FALSE(is_red(compared(full_record(), full_record()), false));
}

TEST_P(EveryQuantity, ThatIsGoneIsRed) {
  const Comparison comparison = compared(with(full_record(), GetParam().pointer, nullptr), full_record());
  EXPECT_THAT(quantities_of(comparison.worse), ::testing::Contains(GetParam().quantity));
}

INSTANTIATE_TEST_SUITE_P(
    Regression, EveryQuantity,
    ::testing::Values(
        Worsening{"/metrics/after/intersecting_pairs", 1, "intersecting_pairs"}, Worsening{"/metrics/after/closed", false, "closed"},
        Worsening{"/metrics/after/edge_manifold", false, "edge_manifold"},
        Worsening{"/metrics/after/vertex_manifold", false, "vertex_manifold"}, Worsening{"/metrics/after/oriented", false, "oriented"},
        Worsening{"/metrics/after/euler_characteristic", -1, "euler_characteristic"}, Worsening{"/metrics/after/genus", 0, "genus"},
        Worsening{"/metrics/after/components", 2, "components"}, Worsening{"/metrics/after/duplicate_vertices", 2, "duplicate_vertices"},
        Worsening{"/metrics/after/degenerate_triangles", 2, "degenerate_triangles"},
        Worsening{"/metrics/after/nonfinite_vertices", 2, "nonfinite_vertices"}, Worsening{"/metrics/after/vertices", 390, "vertices"},
        Worsening{"/metrics/after/angle_deg/min", 29.7, "angle_deg.min"}, Worsening{"/metrics/after/angle_deg/max", 111.5, "angle_deg.max"},
        Worsening{"/metrics/after/angle_deg/mean_min", 44.0, "angle_deg.mean_min"},
        Worsening{"/metrics/after/min_angle_share/below_5", 0.011, "min_angle_share.below_5"},
        Worsening{"/metrics/after/min_angle_share/below_10", 0.021, "min_angle_share.below_10"},
        Worsening{"/metrics/after/min_angle_share/below_20", 0.031, "min_angle_share.below_20"},
        Worsening{"/metrics/after/min_angle_share/below_30", 0.041, "min_angle_share.below_30"},
        Worsening{"/metrics/after/max_angle_share/above_120", 0.021, "max_angle_share.above_120"},
        Worsening{"/metrics/after/max_angle_share/above_150", 0.011, "max_angle_share.above_150"},
        Worsening{"/metrics/after/edge_ratio/min", 0.28, "edge_ratio.min"},
        Worsening{"/metrics/after/edge_ratio/mean", 0.69, "edge_ratio.mean"},
        Worsening{"/metrics/after/edge_ratio/below_0.1", 0.011, "edge_ratio.below_0.1"},
        Worsening{"/metrics/after/valence/share_6", 0.59, "valence.share_6"},
        Worsening{"/metrics/after/valence/share_5_6_7", 0.89, "valence.share_5_6_7"},
        Worsening{"/metrics/after/valence/max", 11, "valence.max"}, Worsening{"/metrics/after/area", 289.0, "area change"},
        Worsening{"/metrics/after/volume", 879.0, "volume change"},
        Worsening{"/level_set_distance/after/mean", 0.061, "distance to the level set, mean"},
        Worsening{"/level_set_distance/after/largest", 0.8, "distance to the level set, largest"},
        Worsening{"/tetgen/p/status", "failed", "TetGen -p"}, Worsening{"/tetgen/pY/status", "failed", "TetGen -pY"},
        Worsening{"/tetgen/pq1.4/status", "failed", "TetGen -pq1.4"}, Worsening{"/solvation/status", "failed", "solvation"},
        Worsening{"/solvation/iterations", 20, "solver iterations"},
        Worsening{"/solvation/degenerate_vertices", 1, "vertices without a normal"},
        Worsening{"/solvation/polar_kcal_per_mol", -390, "polar solvation energy"},
        Worsening{"/solvation/total_kcal_per_mol", -98, "total solvation energy"}),
    [](const auto& instance) {
      std::string name = instance.param.quantity;
      std::replace_if(
          name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
      return name;
    });

TEST(Regression, WithinItsToleranceAValueIsGreen) {
  EXPECT_THAT(compared(with(full_record(), "/metrics/after/angle_deg/min", 29.8), full_record()).worse, IsEmpty());
  EXPECT_THAT(compared(with(full_record(), "/solvation/iterations", 19), full_record()).worse, IsEmpty());
  EXPECT_THAT(compared(with(full_record(), "/metrics/after/volume", 879.9), full_record()).worse, IsEmpty());
}

TEST(Regression, ABetterValueIsToldAndGreen) {
  const Comparison comparison = compared(with(full_record(), "/metrics/after/angle_deg/min", 33), full_record());
  EXPECT_THAT(quantities_of(comparison.better), ElementsAre("angle_deg.min"));
  EXPECT_FALSE(is_red(comparison, true));
  EXPECT_THAT(to_text(comparison, false), HasSubstr("fas2, smopt: angle_deg.min 30° → 33° (tolerance 0.25°)"));
}

TEST(Regression, VolumeIsBetterTheNearerItIsToThatOfTheMeshThatWasGiven) {
  EXPECT_THAT(quantities_of(compared(with(full_record(), "/metrics/after/volume", 900), full_record()).better),
              ElementsAre("volume change"));
  EXPECT_THAT(quantities_of(compared(with(full_record(), "/metrics/after/volume", 930), full_record()).worse), ElementsAre("volume change"))
      << "too much is as bad as too little";
}

TEST(Regression, ACaseThatNowFailsIsRedWithItsReasonAndNothingElse) {
  const Comparison comparison = compared(failed_record(made_dataset("fas2"), "smopt", "out of memory"), full_record());
  ASSERT_THAT(quantities_of(comparison.worse), ElementsAre("case"));
  EXPECT_THAT(to_text(comparison, false), HasSubstr("fas2, smopt: case done → failed: out of memory"));
}

TEST(Regression, ACaseThatNoLongerFailsIsBetter) {
  const Comparison comparison = compared(full_record(), failed_record(made_dataset("fas2"), "smopt", "out of memory"));
  EXPECT_THAT(quantities_of(comparison.better), ElementsAre("case"));
  EXPECT_FALSE(is_red(comparison, true));
}

TEST(Regression, AMethodWhoseProgramIsNotInstalledHereIsNotCompared) {
  Json absent = full_record("external:mmgs");
  mark_not_installed(absent, "mmgs is not installed");
  const Comparison comparison = compared(absent, full_record("external:mmgs"));
  EXPECT_FALSE(is_red(comparison, true));
  EXPECT_THAT(to_text(comparison, false), HasSubstr("mmgs is not installed"));
}

TEST(Regression, AnyWordThatIsNotTheGoodOneIsWorse) {
  for (const char* status : {"failed", "not_converged", "nonfinite", "something new"})
    EXPECT_THAT(quantities_of(compared(with(full_record(), "/solvation/status", status), full_record()).worse), ElementsAre("solvation"))
        << status;
  const Json failed = with(full_record(), "/solvation/status", "not_converged");
  EXPECT_THAT(compared(with(failed, "/solvation/status", "nonfinite"), failed).worse, IsEmpty()) << "one failure is as bad as another";
}

TEST(Regression, WhatWasNotAskedForIsNoRegression) {
  for (const char* status : {"not computed", "over limit", "no_charges"}) {
    const Json now = with(full_record(), "/solvation", {{"status", status}, {"reason", "not for this molecule"}});
    const Comparison comparison = compared(now, full_record());
    EXPECT_THAT(comparison.worse, IsEmpty()) << status;
    EXPECT_THAT(to_text(comparison, false), HasSubstr("not for this molecule")) << status;
  }
}

TEST(Regression, ATimeLimitThatTheReferenceCameNearIsNoRegressionAndAnyOtherIs) {
  const auto success_after = [](double seconds) {
    return with(full_record(), "/tetgen/pq1.4", {{"status", "success"}, {"reason", nullptr}, {"seconds", seconds}});
  };
  const auto failed_by = [](const char* reason) {
    return with(full_record(), "/tetgen/pq1.4", {{"status", "failed"}, {"reason", reason}, {"seconds", 300}});
  };
  const Json too_long = failed_by("time limit of 300 s exceeded");
  const Comparison slow = compared(too_long, success_after(240));
  EXPECT_THAT(slow.worse, IsEmpty());
  EXPECT_THAT(to_text(slow, false), HasSubstr("time limit of 300 s exceeded"));
  const auto is_red = [](const Json& now, const Json& reference) {
    EXPECT_THAT(quantities_of(compared(now, reference).worse), ElementsAre("TetGen -pq1.4"));
  };
  is_red(too_long, success_after(2));
  is_red(failed_by("memory limit of 8192 MB exceeded"), success_after(240));
  is_red(failed_by("self-intersection (code 3)"), success_after(240));
}

TEST(Regression, PairsOfAMethodWithoutAGuardHaveATolerance) {
  const Json reference = with(full_record("laplacian"), "/metrics/after/intersecting_pairs", 100);
  EXPECT_THAT(compared(with(reference, "/metrics/after/intersecting_pairs", 140), reference).worse, IsEmpty());
  EXPECT_THAT(compared(with(reference, "/metrics/after/intersecting_pairs", 160), reference).worse, SizeIs(1));
}

TEST(Regression, AnAblationOfAMethodOfOursMayHaveNoPairEither) {
  const Json reference = full_record("smopt2-no-flips");
  EXPECT_THAT(compared(with(reference, "/metrics/after/intersecting_pairs", 1), reference).worse, SizeIs(1));
}

TEST(Regression, ADivergedMethodIsShownAndNeverRed) {
  const Json reference = with(full_record("meshlab"), "/metrics/after/intersecting_pairs", 1000);
  const Comparison comparison = compared(with(reference, "/metrics/after/intersecting_pairs", 9000), reference);
  EXPECT_FALSE(is_red(comparison, true));
  EXPECT_THAT(quantities_of(comparison.shown), ElementsAre("intersecting_pairs"));
}

TEST(Regression, TimesAndMemoryAreShownAndNeverRed) {
  const Json now = with(with(full_record(), "/cpu_seconds/total", 50.0), "/peak_memory_mb", 9000.0);
  const Comparison comparison = compared(now, full_record());
  EXPECT_FALSE(is_red(comparison, true));
  EXPECT_THAT(quantities_of(comparison.shown), ElementsAre("processor seconds", "peak memory"));
}

TEST(Regression, NoToleranceCanMakeTimesOrMemoryGate) {
  for (const char* pointer : {"/seconds/total", "/cpu_seconds/smoothing", "/peak_memory_mb"}) {
    const std::string entry = std::string(R"({"quantity": "q", "at": ")") + pointer + R"(", "better": "lower", "why": "because")";
    EXPECT_THROW(parse_tolerances("{\"tolerances\": [" + entry + "}]}", "mine.json"), InvalidInput) << pointer;
    EXPECT_NO_THROW(parse_tolerances("{\"tolerances\": [" + entry + ", \"gates\": false}]}", "mine.json")) << pointer;
  }
}

TEST(Regression, OtherInputOrOptionsAreToldAndStillCompared) {
  Json now = with(full_record(), "/options/guard", "none");
  now["input"] = {{"sha256", "another"}};
  now["metrics"]["after"]["intersecting_pairs"] = 3;
  now["metrics"]["after"]["vertices"] = 300;
  const Comparison comparison = compared(now, full_record());
  const std::string text = to_text(comparison, false);
  EXPECT_THAT(text, HasSubstr("fas2, smopt: --guard: null → \"none\""));
  EXPECT_THAT(text, HasSubstr("the mesh that the method was given is another one"));
  EXPECT_THAT(quantities_of(comparison.worse), ElementsAre("intersecting_pairs")) << "the number of vertices is for the same options only";
  EXPECT_THAT(quantities_of(comparison.shown), ElementsAre("vertices"));
}

TEST(Regression, CasesOfOneOnlyAreListedAndRedOnlyWhereTheRunMustBeComplete) {
  const RecordSet run = records_of({full_record("smopt"), full_record("laplacian")});
  const RecordSet reference = records_of({full_record("smopt"), full_record("smopt", "1a63")});
  const Comparison comparison = compare(run, reference, default_tolerances());
  EXPECT_THAT(comparison.only_in_run, ElementsAre(CaseName{"fas2", "laplacian"}));
  EXPECT_THAT(comparison.only_in_reference, ElementsAre(CaseName{"1a63", "smopt"}));
  EXPECT_FALSE(is_red(comparison, false));
  EXPECT_TRUE(is_red(comparison, true));
  EXPECT_THAT(to_text(comparison, true), HasSubstr("RED"));
}

TEST(Regression, TheJsonSaysWhatTheTextSays) {
  const Json now = with(with(full_record(), "/metrics/after/intersecting_pairs", 4), "/metrics/after/angle_deg/min", 35);
  const Json json = to_json(compared(now, full_record()), false);
  EXPECT_EQ(json.at("verdict"), "red");
  ASSERT_EQ(json.at("worse").size(), 1U);
  EXPECT_EQ(json.at("worse")[0].at("molecule"), "fas2");
  EXPECT_EQ(json.at("worse")[0].at("now"), 4);
  EXPECT_EQ(json.at("worse")[0].at("reference"), 0);
  EXPECT_EQ(json.at("better")[0].at("tolerance"), 0.25);
  EXPECT_EQ(to_json(compared(full_record(), full_record()), false).at("verdict"), "green");
}

TEST(Tolerances, EveryOneSaysWhyAndStandsAtAPlace) {
  EXPECT_GT(default_tolerances().size(), 50U);
  for (const Tolerance& tolerance : default_tolerances()) {
    EXPECT_GT(tolerance.why.size(), 10U) << tolerance.quantity;
    EXPECT_EQ(tolerance.pointer.front(), '/') << tolerance.quantity;
  }
}

TEST(Tolerances, EveryMetricThatHasABetterDirectionIsGuardedForOurMethods) {
  const auto guarded = tolerances_for(default_tolerances(), {"fas2", "smopt", "smopt"});
  for (const metrics::Metric& metric : metrics::metric_registry()) {
    const bool is_of_two_surfaces = metric.name.starts_with("distance.");  // records hold the distance to the level set in its place
    if (metric.better == metrics::Better::kNeutral || is_of_two_surfaces) continue;
    EXPECT_TRUE(std::any_of(guarded.begin(), guarded.end(), [&](const Tolerance* t) { return t->quantity == metric.name && t->gates; }))
        << metric.name;
  }
}

TEST(Tolerances, DirectionAndPlaceOfAMetricAreTheRegistrys) {
  const auto tolerances = parse_tolerances(
      R"({"tolerances": [{"metrics": ["angle_deg.min", "edge_ratio.below_0.1", "closed", "volume"], "why": "because"}]})", "mine.json");
  ASSERT_EQ(tolerances.size(), 4U);
  EXPECT_EQ(tolerances[0].direction, Direction::higher);
  EXPECT_EQ(tolerances[0].pointer, "/metrics/after/angle_deg/min");
  EXPECT_EQ(tolerances[0].unit, "°");
  EXPECT_EQ(tolerances[1].direction, Direction::lower);
  EXPECT_EQ(tolerances[1].pointer, "/metrics/after/edge_ratio/below_0.1");
  EXPECT_EQ(tolerances[3].direction, Direction::equal);
}

TEST(Tolerances, TheLargerOfAbsoluteAndRelativeCounts) {
  Tolerance tolerance;
  tolerance.absolute = 2;
  tolerance.relative = 0.1;
  EXPECT_DOUBLE_EQ(slack(tolerance, 5), 2);
  EXPECT_DOUBLE_EQ(slack(tolerance, -100), 10);
}

TEST(Tolerances, TheFirstEntryWhoseScopeTheCaseIsInCounts) {
  const auto tolerances = parse_tolerances(
      R"({"tolerances": [{"metrics": ["area"], "methods": ["iso2mesh"], "molecules": ["fas2"], "absolute": 1, "why": "because"},
                         {"metrics": ["area"], "absolute": 2, "why": "because"}]})",
      "mine.json");
  EXPECT_EQ(tolerances_for(tolerances, {"fas2", "iso2mesh-hc", "iso2mesh"}).front()->absolute, 1);
  EXPECT_EQ(tolerances_for(tolerances, {"1a63", "iso2mesh-hc", "iso2mesh"}).front()->absolute, 2);
  EXPECT_EQ(tolerances_for(tolerances, {"fas2", "smopt", "smopt"}).front()->absolute, 2);
}

TEST(Tolerances, AnEntryThatCannotBeMeantIsRefusedByItsNumber) {
  for (const char* entry : {
           R"({"metrics": ["no_such_metric"], "why": "because"})",
           R"({"metrics": ["area"]})",
           R"({"metrics": ["area"], "why": ""})",
           R"({"metrics": ["angle_deg.min"], "better": "lower", "why": "because"})",
           R"({"metrics": ["area"], "absolute": -1, "why": "because"})",
           R"({"metrics": ["area"], "absolut": 1, "why": "because"})",
           R"({"quantity": "q", "at": "no pointer", "better": "lower", "why": "because"})",
           R"({"quantity": "q", "at": "/q", "better": "larger", "why": "because"})",
           R"({"quantity": "q", "at": "/q", "why": "because"})",
       }) {
    const std::string text = std::string(R"({"tolerances": [{"metrics": ["volume"], "why": "because"}, )") + entry + "]}";
    EXPECT_THAT([&] { parse_tolerances(text, "mine.json"); }, ::testing::ThrowsMessage<InvalidInput>(HasSubstr("mine.json: entry 2")))
        << entry;
  }
}

/// A run's folder with these records.
void put_run(const std::filesystem::path& folder, const std::vector<Json>& records) {
  for (const Json& record : records) {
    const auto path = record_path(folder, record.at("molecule").at("name").get<std::string>(), record.at("method").get<std::string>());
    std::filesystem::create_directories(path.parent_path());
    write_file(path, record.dump(2));
  }
}

/// A run and a reference that differ in a compared case, a new one and one that only the reference has.
struct TwoRuns {
  TwoRuns() {
    put_run(run, {with(full_record(), "/metrics/after/angle_deg/min", 35), full_record("laplacian"), full_record("smopt2")});
    put_run(reference, {full_record(), full_record("smopt", "1a63"), full_record("smopt2")});
  }
  [[nodiscard]] Comparison comparison() const { return compare(RecordSet::load(run), RecordSet::load(reference), default_tolerances()); }

  TemporaryFolder folder;
  std::filesystem::path run = folder.path() / "run";
  std::filesystem::path reference = folder.path() / "reference";
};

TEST(Accept, TakesComparedAndNewCasesOverAndKeepsTheOthers) {
  const TwoRuns runs;
  const std::string kept = bytes_of(record_path(runs.reference, "1a63", "smopt"));
  const auto changed = accept(runs.run, runs.reference, runs.comparison());
  EXPECT_THAT(changed, ElementsAre(CaseName{"fas2", "smopt"}, CaseName{"fas2", "laplacian"})) << "smopt2 is the same bytes";
  for (const char* method : {"smopt", "laplacian", "smopt2"})
    EXPECT_EQ(bytes_of(record_path(runs.reference, "fas2", method)), bytes_of(record_path(runs.run, "fas2", method))) << method;
  EXPECT_EQ(bytes_of(record_path(runs.reference, "1a63", "smopt")), kept);
  EXPECT_THAT(runs.comparison().better, IsEmpty());
}

TEST(Accept, LeavesNothingButTheRecordsBehind) {
  const TwoRuns runs;
  std::filesystem::create_directories(runs.reference / ".accepting" / "records");  // of a run that was killed
  accept(runs.run, runs.reference, runs.comparison());
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(runs.reference)) names.push_back(entry.path().filename());
  EXPECT_THAT(names, ElementsAre("records"));
}

TEST(Accept, LeavesTheReferenceAsItWasWhenARecordCannotBeRead) {
  const TwoRuns runs;
  const Comparison comparison = runs.comparison();
  const std::string before = bytes_of(record_path(runs.reference, "fas2", "smopt"));
  std::filesystem::remove(record_path(runs.run, "fas2", "laplacian"));
  EXPECT_THROW(accept(runs.run, runs.reference, comparison), InvalidInput);
  EXPECT_EQ(bytes_of(record_path(runs.reference, "fas2", "smopt")), before);
}

TEST(Accept, KeepsTheRecordOfAMethodThatIsNotInstalledWhereTheRunWasMade) {
  const TwoRuns runs;
  Json absent = full_record("external:mmgs");
  put_run(runs.reference, {absent});
  mark_not_installed(absent, "mmgs is not installed");
  put_run(runs.run, {absent});
  accept(runs.run, runs.reference, runs.comparison());
  EXPECT_THAT(bytes_of(record_path(runs.reference, "fas2", "external:mmgs")), Not(HasSubstr("not installed")));
}

TEST(Accept, RefusesARunAsItsOwnReference) {
  const TwoRuns runs;
  EXPECT_THROW(accept(runs.run, runs.run / "records" / "..", runs.comparison()), InvalidOption);
}

}  // namespace
}  // namespace smopt::experiments
