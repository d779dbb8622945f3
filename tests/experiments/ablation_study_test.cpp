#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "experiments/ablation/ablate.h"
#include "experiments/ablation/ablation_page.h"
#include "experiments/ablation/ablation_tables.h"
#include "experiments/ablation/embedded.h"
#include "experiments/ablation/findings.h"
#include "experiments/run_layout.h"
#include "experiments/tables/markdown.h"
#include "smopt/error.h"
#include "smopt/io/child_process.h"
#include "tests/experiments/made_records.h"
#include "tests/support/files.h"

namespace smopt::experiments {
namespace {

using smopt::testing::bytes_of;
using smopt::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

constexpr double kTimeLimitSeconds = 300;  // four figures take seconds; a busy machine may need more
constexpr double kRounding = 1e-9;

const AblationPlan& plan() {
  return ablation_plan(true);
}

/// The place of the case's level of a factor, counted from that factor's default: 0 for the default, then 1, 2, ….
double steps_from_default(const DesignCase& c, const char* factor) {
  for (std::size_t i = 0; i < plan().factors.size(); ++i)
    if (plan().factors[i].name == factor)
      return std::abs(static_cast<double>(c.levels[i]) - static_cast<double>(plan().factors[i].default_level));
  throw std::runtime_error("no such factor");
}

bool is_without_guard(const DesignCase& c) {
  return steps_from_default(c, "guard") == 4;
}

/// What a case comes to, by its levels: without a guard there are eight pairs, a step rule takes a per cent of the volume, keeping redundant points
/// doubles the time.
Json record_of(const Dataset& dataset, const DesignCase& c) {
  Json record = testing::made_record(dataset, c.method_case.name);
  record["method_title"] = c.method_case.title;
  record["options"] = {{"cavities", c.method_case.cavities}};
  record["stopped_because"] = "quality reached";
  record["metrics"]["before"]["volume"] = 1000;
  Json& after = record["metrics"]["after"];
  after["intersecting_pairs"] = is_without_guard(c) ? 8 : 0;
  after["angle_deg"]["min"] = 10 + steps_from_default(c, "edge-ratio") + steps_from_default(c, "min-angle");
  after["min_angle_share"] = {{"below_10", 0}, {"below_20", 0.02}};
  after["volume"] = 990 - 10 * steps_from_default(c, "step");
  record["cpu_seconds"] = {
      {"validity", 0.25}, {"cavities", 0}, {"redundant", 0.25}, {"smoothing", steps_from_default(c, "redundant") > 0 ? 1.5 : 0.5}};
  record["moves"] = {{"accepted", 100}};
  return record;
}

/// All cases of the quick plan, of one molecule. The volume-preserving step's pairs were not counted; keeping the cavities fails.
std::vector<Json> made_study(const Dataset& dataset) {
  std::vector<Json> records;
  for (const DesignCase& c : chosen_cases(plan(), {})) {
    const std::string& name = c.method_case.name;
    records.push_back(name == "cavities-keep" ? testing::failed_record(dataset, name, "out of luck") : record_of(dataset, c));
    if (name == "step-volume-preserving") records.back()["metrics"]["after"]["intersecting_pairs"] = nullptr;
  }
  return records;
}

RecordSet study_of(const std::vector<Json>& list) {
  RecordSet records;
  for (const Json& record : list) records.add(record, "made");
  return records;
}

/// A study and what is made of it.
class AblationStudy : public ::testing::Test {
 protected:
  const RecordSet records_ = study_of(made_study(testing::ache_monomer()));
  const std::vector<Outcomes> molecules_ = outcomes_of(records_);

  [[nodiscard]] const Outcomes& outcomes() const { return molecules_.front(); }
  [[nodiscard]] std::optional<double> value(const char* quantity, const char* name) const {
    return outcomes().value(find_quantity(quantity), name);
  }
};

/// The texts of the row whose first cells are these.
std::vector<std::string> row_of(const Table& table, const std::vector<std::string>& head) {
  for (const auto& row : table.rows) {
    std::vector<std::string> texts;
    for (const Cell& cell : row) texts.push_back(cell_text(cell, "—"));
    if (std::equal(head.begin(), head.end(), texts.begin())) return texts;
  }
  return {};
}

std::string cell_of(const Table& table, const std::vector<std::string>& head, const std::string& column) {
  const std::vector<std::string> row = row_of(table, head);
  for (std::size_t i = 0; i < row.size(); ++i)
    if (table.columns[i].id == column) return row[i];
  return "no such cell";
}

TEST_F(AblationStudy, ValuesAreTheRecords) {
  EXPECT_EQ(value("intersecting_pairs", "guard-none"), 8);
  EXPECT_EQ(value("cpu_s", "default"), 1) << "validity, cavities, redundant points and smoothing together";
  EXPECT_NEAR(value("volume_change_percent", "default").value_or(0), -1, kRounding);
  EXPECT_NEAR(value("below_20_percent", "default").value_or(0), 2, kRounding);
  EXPECT_EQ(value("moves", "default"), 100);
  EXPECT_FALSE(value("moves", "cavities-keep"));
  EXPECT_FALSE(value("moves", "no-such-case"));
}

TEST_F(AblationStudy, OneAtATimeHasARowForEachCaseAndOneForTheMeshBefore) {
  const Table table = one_at_a_time_table(plan(), molecules_);
  EXPECT_EQ(table.rows.size(), one_at_a_time(plan(), plan().one_at_a_time).size() + 1);
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  EXPECT_EQ(cell_of(table, {"AChE monomer", "Guard", "none"}, "intersecting_pairs"), "8");
  EXPECT_EQ(cell_of(table, {"AChE monomer", "none", "before SMOPT"}, "intersecting_pairs"), "7");
  EXPECT_EQ(cell_of(table, {"AChE monomer", "none", "before SMOPT"}, "moves"), "—");
  EXPECT_EQ(cell_of(table, {"AChE monomer", "all", "defaults"}, "ended"), "quality reached");
}

TEST_F(AblationStudy, AFailedCaseIsARowWithItsReasonAndPairsNotCountedAreTold) {
  const Table table = one_at_a_time_table(plan(), molecules_);
  EXPECT_EQ(cell_of(table, {"AChE monomer", "Cavities", "kept"}, "ended"), "failed: out of luck");
  EXPECT_EQ(cell_of(table, {"AChE monomer", "Cavities", "kept"}, "moves"), "—");
  EXPECT_EQ(cell_of(table, {"AChE monomer", "Step rule", "volume-preserving"}, "intersecting_pairs"), "not counted");
  const std::string page = ablation_page(plan(), molecules_, {});
  EXPECT_THAT(page, HasSubstr("Cavities: kept: failed: out of luck"));
  EXPECT_THAT(page, HasSubstr("intersecting pairs not counted"));
}

TEST_F(AblationStudy, ACaseThatWasNotRunIsARowThatSaysSo) {
  const RecordSet one = study_of({record_of(testing::ache_monomer(), design_case(plan(), default_levels(plan())))});
  const std::vector<Outcomes> molecules = outcomes_of(one);
  EXPECT_EQ(cell_of(one_at_a_time_table(plan(), molecules), {"AChE monomer", "Guard", "none"}, "ended"), "not run");
  EXPECT_NO_THROW(main_effects_table(plan(), molecules));
  EXPECT_THAT(ablation_page(plan(), molecules, {}), HasSubstr("cannot be told"));
}

TEST_F(AblationStudy, EffectsOfTheFactorialAreThoseThatTheRecordsWereMadeWith) {
  const Table means = main_effects_table(plan(), molecules_);
  EXPECT_EQ(cell_of(means, {"AChE monomer", "Step rule", "umbrella"}, "volume_change_percent"), "-1.00");
  EXPECT_EQ(cell_of(means, {"AChE monomer", "Step rule", "volume-preserving"}, "volume_change_percent"), "-2.00");
  EXPECT_EQ(cell_of(means, {"AChE monomer", "Redundant points", "kept"}, "cpu_s"), "2.000") << "a geometric mean";
  const Table shares = interactions_table(plan(), molecules_);
  EXPECT_EQ(cell_of(shares, {"AChE monomer", "Step rule"}, "volume_change_percent"), "100.0");
  EXPECT_EQ(cell_of(shares, {"AChE monomer", "Redundant points"}, "cpu_s"), "100.0");
  EXPECT_EQ(cell_of(shares, {"AChE monomer", "Guard"}, "cpu_s"), "0.0");
  EXPECT_EQ(cell_of(shares, {"AChE monomer", "Guard"}, "moves"), "—") << "alike in all cases";
}

TEST_F(AblationStudy, ALevelThatEffectsLeaveOutIsNamed) {
  // The volume-preserving step's pairs were not counted in one case of four.
  const Table means = main_effects_table(plan(), molecules_);
  EXPECT_THAT(means.notes, Contains(AllOf(HasSubstr("intersecting pairs"), HasSubstr("without"))));
  EXPECT_THAT(means.notes, Not(Contains(HasSubstr("the effects on moves"))));
}

TEST_F(AblationStudy, ThePageSaysWhatDoesTheMostToEachQuantity) {
  EXPECT_THAT(largest_change_findings(plan(), outcomes()), Contains(AllOf(HasSubstr("Guard: none"), HasSubstr("to 8 from 0"))));
  EXPECT_THAT(largest_change_findings(plan(), outcomes()), Contains(AllOf(StartsWith("Moves"), HasSubstr("no single change"))));
  EXPECT_THAT(factorial_findings(plan(), outcomes()),
              Contains(AllOf(HasSubstr("volume"), HasSubstr("**Step rule** does the most (100 %"))));
  EXPECT_THAT(factorial_findings(plan(), outcomes()), Contains("Moves: alike in all cases."));
  EXPECT_THAT(threshold_findings(plan(), outcomes()),
              Contains(AllOf(HasSubstr("smallest angle: from 10.00° (edge-ratio 0.1, min-angle 10°)"))));
}

TEST(AblationQuantities, ANumberThatRoundsToZeroHasNoSign) {
  EXPECT_EQ(in_words(find_quantity("volume_change_percent"), -1e-9), "0.00 %");
  EXPECT_EQ(in_words(find_quantity("volume_change_percent"), -0.006), "-0.01 %");
  EXPECT_EQ(in_words(find_quantity("intersecting_pairs"), std::nullopt), "none");
}

TEST_F(AblationStudy, WhatASwitchDoesNotChangeIsSaid) {
  for (const FactorFinding& finding : one_at_a_time_findings(plan(), outcomes()))
    if (finding.title == "Rounds") {
      EXPECT_THAT(finding.sentences, Each(HasSubstr("changes nothing noticeably")));
    }
}

TEST_F(AblationStudy, TablesOfTwoMoleculesHaveTheRowsOfBoth) {
  std::vector<Json> list = made_study(testing::ache_monomer());
  for (const Json& record : made_study(testing::made_dataset("capsid", Role::stand_in))) list.push_back(record);
  const RecordSet records = study_of(list);
  const std::vector<Outcomes> molecules = outcomes_of(records);
  EXPECT_EQ(thresholds_table(plan(), molecules).rows.size(), 2 * full_factorial(plan(), plan().thresholds).size());
  EXPECT_THAT(to_markdown(factorial_table(plan(), molecules)), HasSubstr("The capsid (stand-in)"));
}

/// The figures of a made study, drawn twice; the second time the numbers that were drawn are kept.
class AblationFigures : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::vector<Json> list = made_study(testing::ache_monomer());
    for (const Json& record : made_study(testing::made_dataset("capsid"))) list.push_back(record);
    write_ablation(plan(), study_of(list), {}, folder_.emplace().path());
    write_ablation(plan(), study_of(list), {}, again_.emplace().path());
    const auto dump = folder_->path() / "drawn.json";
    const ProcessOutcome outcome = run_process(
        {"/usr/bin/python3", "-c", std::string(embedded::plot_ablation_program()), folder_->path().string(), "--dump", dump.string()},
        {kTimeLimitSeconds, 0}, "figures", {});
    ASSERT_EQ(outcome.exit_status, 0) << outcome.output;
    drawn_ = Json::parse(bytes_of(dump));
  }
  static void TearDownTestSuite() {
    folder_.reset();
    again_.reset();
  }

  static const Json& panel(const char* figure, const std::string& title) {
    for (const Json& candidate : drawn_.at(figure))
      if (candidate.at("title") == title) return candidate;
    throw std::runtime_error("no panel " + title);
  }

  inline static std::optional<TemporaryFolder> folder_, again_;
  inline static Json drawn_;
};

TEST_F(AblationFigures, AreSvgAndPngAndTheSameBytesTwice) {
  for (const std::string name : {"ablation-one-at-a-time", "ablation-main-effects", "ablation-interactions", "ablation-thresholds"}) {
    const std::string svg = bytes_of(folder_->path() / "figures" / (name + ".svg"));
    const std::string png = bytes_of(folder_->path() / "figures" / (name + ".png"));
    EXPECT_THAT(svg, HasSubstr("</svg>")) << name;
    EXPECT_THAT(png, StartsWith("\x89PNG")) << name;
    EXPECT_TRUE(svg == bytes_of(again_->path() / "figures" / (name + ".svg"))) << name;
    EXPECT_TRUE(png == bytes_of(again_->path() / "figures" / (name + ".png"))) << name;
  }
}

TEST_F(AblationFigures, TheLinksOfThePageAreFilesThatAreThere) {
  const std::string page = bytes_of(folder_->path() / "README.md");
  std::size_t links = 0;
  for (std::size_t at = page.find("]("); at != std::string::npos; at = page.find("](", at + 1)) {
    const std::string target = page.substr(at + 2, page.find(')', at) - at - 2);
    EXPECT_FALSE(bytes_of(folder_->path() / target).empty()) << target;
    ++links;
  }
  EXPECT_GE(links, 9U);
  for (const char* ending : {".csv", ".tex"})
    EXPECT_FALSE(bytes_of(folder_->path() / "tables" / (std::string("ablation-factorial") + ending)).empty());
}

TEST_F(AblationFigures, OneAtATimeHasAPointForEachResultAndAWordForEachOther) {
  const Json& pairs = panel("ablation-one-at-a-time", "Intersecting pairs");
  const std::size_t cases = one_at_a_time(plan(), plan().one_at_a_time).size();
  // The mesh before is a row too; one case failed, of one the pairs were not counted.
  EXPECT_EQ(pairs.at("points").at("AChE monomer").size(), cases + 1 - 2);
  EXPECT_THAT(pairs.at("notes").get<std::vector<std::string>>(),
              ::testing::UnorderedElementsAre("failed", "failed", "not counted", "not counted"));
  double largest = 0;
  for (const Json& point : pairs.at("points").at("The capsid")) largest = std::max(largest, point[0].get<double>());
  EXPECT_EQ(largest, 8);
}

TEST_F(AblationFigures, PointsOfOneRowAreOfOneCaseAndNoTwoRowsAreTheSame) {
  std::set<double> rows;
  const Json& points = panel("ablation-one-at-a-time", "Smallest angle (°)").at("points").at("AChE monomer");
  for (const Json& point : points) rows.insert(std::round(point[1].get<double>()));
  EXPECT_EQ(rows.size(), points.size());
}

TEST_F(AblationFigures, MainEffectsAreTheMeansOfTheLevels) {
  std::vector<double> means;
  for (const Json& point : panel("ablation-main-effects", "Volume change (%)").at("points").at("AChE monomer"))
    means.push_back(point[1].get<double>());
  // Guard (exact, none), step (umbrella, volume-preserving), redundant points (deleted, kept).
  EXPECT_THAT(means, ::testing::Pointwise(::testing::DoubleNear(kRounding), {-1.5, -1.5, -1.0, -2.0, -1.5, -1.5}));
}

TEST_F(AblationFigures, InteractionsShowTheShares) {
  const Json& volume = panel("ablation-interactions", "AChE monomer: Volume change (%)");
  EXPECT_NEAR(volume.at("cells")[1][1].get<double>(), 100, kRounding);
  EXPECT_NEAR(volume.at("cells")[0][1].get<double>(), 0, kRounding);
  const Json& moves = panel("ablation-interactions", "AChE monomer: Moves");
  EXPECT_TRUE(moves.at("cells")[0][0].is_null());
  EXPECT_EQ(moves.at("notes")[0], "alike in all cases");
}

TEST_F(AblationFigures, TheGridIsOfTheRecordsAndTheDefaultIsMarked) {
  const Json& angle = panel("ablation-thresholds", "AChE monomer: Smallest angle (°)");
  EXPECT_EQ(angle.at("points").at("default")[0], Json::array({0.1, 10.0}));
  // Edge ratios 0, 0.1, 0.3 are two, no and two levels from the default; so are angles 0, 10, 20.
  EXPECT_EQ(angle.at("cells"), Json::parse("[[14.0, 12.0, 14.0], [12.0, 10.0, 12.0], [14.0, 12.0, 14.0]]"));
  EXPECT_THAT(panel("ablation-thresholds", "AChE monomer: Intersecting pairs").at("notes")[0].get<std::string>(),
              HasSubstr("0 at every threshold"));
}

TEST(AblationRuns, ADesignThatIsNoneIsRefused) {
  EXPECT_THAT([] { chosen_designs("latin-square"); }, ThrowsMessage<InvalidOption>(HasSubstr("latin-square")));
  AblateOptions options;
  options.molecules = {"fas3"};
  EXPECT_THAT([&] { ablate(options); }, ::testing::Throws<InvalidOption>());
  options.data = "/nowhere/at/all";
  EXPECT_THAT([&] { ablate(options); }, ThrowsMessage<InvalidInput>(HasSubstr("/nowhere/at/all")));
}

TEST(AblationRuns, AQuickStudyOfASmallMoleculeShowsWhatTheGuardAndTheCavitiesAreFor) {
  if (smopt::testing::apbs_molecule("misc/fas2.pqr").empty()) GTEST_SKIP() << "apbs-data is not installed";
  const TemporaryFolder folder;
  AblateOptions options;
  options.directory = folder.path();
  options.is_quick = true;
  options.run.program = SMOPT_PROGRAM;
  const RunSummary summary = ablate(options);
  EXPECT_EQ(summary.cases.size(), chosen_cases(plan(), {}).size());
  EXPECT_EQ(summary.count(CaseStatus::failed), 0U);
  const RecordSet records = RecordSet::load(folder.path());
  for (const DesignCase& c : chosen_cases(plan(), {})) {
    const auto* const record = records.find("fas2", c.method_case.name);
    ASSERT_NE(record, nullptr) << c.method_case.name;
    EXPECT_EQ(text_at(record, "/options/cavities"), c.method_case.cavities) << c.method_case.name;
    if (steps_from_default(c, "guard") == 0) {
      EXPECT_EQ(number_at(record, "/metrics/after/intersecting_pairs"), 0) << c.method_case.name;
    }
  }
  EXPECT_EQ(number_at(records.find("fas2", "rounds-0"), "/moves/accepted"), 0);
  EXPECT_GT(number_at(records.find("fas2", "cavities-keep"), "/metrics/after/components"),
            number_at(records.find("fas2", "default"), "/metrics/after/components"));
  EXPECT_EQ(number_at(records.find("fas2", "cavities-keep"), "/metrics/before/volume"),
            number_at(records.find("fas2", "default"), "/metrics/before/volume"))
      << "changes are held against the mesh without cavities, even where a case keeps them";
  EXPECT_GT(number_at(records.find("fas2", "screening-off-10"), "/moves/accepted"),
            number_at(records.find("fas2", "default"), "/moves/accepted"));
  EXPECT_THAT(bytes_of(folder.path() / "README.md"), HasSubstr("Fasciculin-2"));

  options.run.resumes = true;
  const RunSummary resumed = ablate(options);
  EXPECT_EQ(resumed.steps_run, 0U);
  EXPECT_EQ(resumed.cases.size(), summary.cases.size());
}

}  // namespace
}  // namespace smopt::experiments
