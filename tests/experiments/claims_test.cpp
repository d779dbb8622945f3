#include "experiments/claims/claims.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/claims/predicates.h"
#include "experiments/paper_table.h"
#include "smopt/error.h"
#include "tests/experiments/made_records.h"
#include "tests/support/files.h"

namespace smopt::experiments {
namespace {

using smopt::testing::bytes_of;
using smopt::testing::failed_record;
using smopt::testing::made_record;
using smopt::testing::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Not;

double paper_number(int table, const std::string& row, const std::string& column) {
  return std::stod(paper_table(table).value(row, column).value());
}

/// `bins` bins between 0 and `high`, one count in each whose middle is in [from, to].
Json histogram(double high, int bins, double from, double to) {
  Json edges = Json::array({0.0}), counts = Json::array();
  for (int i = 0; i < bins; ++i) {
    const double middle = high * (i + 0.5) / bins;
    edges.push_back(high * (i + 1) / bins);
    counts.push_back(middle >= from && middle <= to ? 1 : 0);
  }
  return {{"edges", edges}, {"counts", counts}};
}

Json ratio_histogram(double from, double to) {
  return histogram(1, 50, from, to);
}

Json angle_histogram(double from, double to) {
  return histogram(180, 90, from, to);
}

Json good_metrics(double vertices) {
  return {{"vertices", vertices},
          {"closed", true},
          {"edge_manifold", true},
          {"vertex_manifold", true},
          {"oriented", true},
          {"euler_characteristic", -2},
          {"intersecting_pairs", 0},
          {"degenerate_triangles", 0},
          {"area", 100.0},
          {"volume", 100.0},
          {"edge_ratio", {{"median", 0.7}, {"below_0.1", 0.0}, {"histogram", ratio_histogram(0.6, 0.8)}}},
          {"angle_deg", {{"min", 30.5}, {"max", 109.0}, {"histogram", angle_histogram(45, 75)}}},
          {"min_angle_share", {{"below_10", 0.1}}},
          {"valence", {{"share_5_6_7", 0.998}}}};
}

Json tetgen(const std::string& status) {
  return {{"p", {{"status", status}}}, {"pY", {{"status", status}}}, {"pq1.4", {{"status", status}}}};
}

/// A molecule of the paper's, on which all that the paper says is so, and all that is said of smopt2.
struct GoodMolecule {
  explicit GoodMolecule(const std::string& paper_row) : row(paper_row) {
    dataset = testing::made_dataset(paper_row, Role::real);
    dataset.paper_row = paper_row;
    initial = paper_number(1, row, "vertices_initial");
    improved = paper_number(1, row, "vertices_improved");
  }

  [[nodiscard]] Json record(const std::string& method) const {
    Json json = made_record(dataset, method);
    json["molecule"]["atoms"] = 2'000'000;
    json["metrics"] = {{"before", good_metrics(initial)}, {"after", good_metrics(improved)}};
    json["level_set_distance"] = {{"before", {{"mean", 0.05}}}, {"after", {{"mean", 0.04}}}};
    json["tetgen"] = tetgen("success");
    json["options"] = {{"rounds", 100}};
    json["cpu_seconds"] = {{"total", 5.0}};
    return json;
  }

  [[nodiscard]] Json initial_record() const {
    Json json = record("initial");
    json["metrics"]["after"] = good_metrics(initial);
    json["metrics"]["after"]["edge_ratio"]["histogram"] = ratio_histogram(0, 0.8);
    json["metrics"]["after"]["angle_deg"]["histogram"] = angle_histogram(0, 180);
    json["tetgen"] = tetgen("failed");
    json["solvation"] = {{"status", "not_converged"}, {"iterations", 100}};
    return json;
  }

  [[nodiscard]] Json smopt_record(const std::string& name = "smopt") const {
    Json json = record(name);
    json["registered_method"] = "smopt";
    json["metrics"]["after"]["area"] = 98.0;
    json["metrics"]["after"]["volume"] = 99.0;
    json["metrics"]["after"]["min_angle_share"]["below_10"] = 0.001;
    const double total = paper_number(1, row, "afmpb_improved_kcal_per_mol");
    json["solvation"] = {{"status", "success"}, {"iterations", 30}, {"total_kcal_per_mol", total}, {"polar_kcal_per_mol", total - 10}};
    const double drop = initial - paper_number(1, row, "triangles_initial") / 2 - improved + paper_number(1, row, "triangles_improved") / 2;
    json["removed"] = {{"redundant_valence3", 3}, {"redundant_valence4", 4}, {"cavities", drop / 2}, {"cavity_vertices", 1000}};
    json["moves"] = {{"accepted", initial}, {"refused", 0}};
    json["rounds"] = 3;
    json["each_round"] = {{{"active", initial}}, {{"active", 100}}, {{"active", 50}}};
    json["cpu_seconds"] = {{"validity", 0.01 * std::pow(initial / 67955, 1.75)},
                           {"cavities", 0.0},
                           {"redundant", 0.01},
                           {"smoothing", 1e-6 * initial},
                           {"total", 0.1}};
    return json;
  }

  [[nodiscard]] Json iso2mesh_record() const {
    Json json = record("iso2mesh");
    json["metrics"]["after"]["intersecting_pairs"] = 57;
    json["metrics"]["after"]["edge_ratio"]["histogram"] = ratio_histogram(0.4, 1);
    return json;
  }

  [[nodiscard]] std::vector<Json> records() const {
    Json meshlab = record("meshlab"), vicinity = smopt_record("smopt-vicinity"), kept = smopt_record("smopt-kept");
    meshlab["diverged_at_step"] = 5;
    vicinity["options"]["guard"] = "paper";
    kept["options"]["cavities"] = "keep";
    kept["metrics"]["after"]["intersecting_pairs"] = 4;
    return {initial_record(), smopt_record(), iso2mesh_record(), meshlab, vicinity, kept, record("smopt2")};
  }

  std::string row;
  Dataset dataset;
  double initial = 0, improved = 0;
};

/// Three molecules, so that there is a trend.
std::vector<Json> good_records() {
  std::vector<Json> all;
  for (const char* row : {"AChE monomer", "connexin", "AChE tetramer"})
    for (Json& record : GoodMolecule(row).records()) all.push_back(std::move(record));
  return all;
}

RecordSet records_of(const std::vector<Json>& list) {
  RecordSet records;
  for (const Json& record : list) records.add(record, "made for a test");
  return records;
}

Evidence evidence_for(std::string_view id, const std::vector<Json>& records) {
  for (const JudgedClaim& judged : judge_claims(records_of(records)))
    if (judged.claim->id == id) return judged.evidence;
  ADD_FAILURE() << "no claim " << id;
  return {};
}

/// What makes a claim false: in the records of `method`, `change` is made.
struct Refutation {
  std::string id;
  std::string method;
  std::function<void(Json&)> change;
};

std::function<void(Json&)> set(const std::string& pointer, const Json& value) {
  return [=](Json& record) { record[Json::json_pointer(pointer)] = value; };
}

std::function<void(Json&)> set_both(const std::function<void(Json&)>& first, const std::function<void(Json&)>& second) {
  return [=](Json& record) {
    first(record);
    second(record);
  };
}

std::vector<Refutation> refutations() {
  const std::string after = "/metrics/after/";
  return {
      {"no-pairs", "smopt", set(after + "intersecting_pairs", 1)},
      {"initial-is-manifold", "initial", set(after + "edge_manifold", false)},
      {"manifoldness-kept", "smopt", set(after + "degenerate_triangles", 1)},
      {"topology-kept", "smopt", set(after + "euler_characteristic", -4)},
      {"any-mesh", "smopt", [](Json& record) { mark_failed(record, "too thin"); }},
      {"redundant-points", "smopt", set_both(set("/removed/redundant_valence3", 0), set("/removed/redundant_valence4", 0))},
      {"fewer-vertices", "smopt", set(after + "vertices", 60000)},
      {"cavities", "smopt", set("/removed/cavities", 3)},
      {"initial-fails-in-tetgen", "initial", set("/tetgen", tetgen("success"))},
      {"improved-succeeds-in-tetgen", "smopt", set("/tetgen", tetgen("failed"))},
      {"initial-fails-in-afmpb", "initial", set("/solvation/status", "success")},
      {"improved-succeeds-in-afmpb", "smopt", set("/solvation/status", "not_converged")},
      {"energies", "smopt", set("/solvation/total_kcal_per_mol", 909.5)},
      {"check-seconds", "smopt", set("/cpu_seconds/validity", 1000)},
      {"smoothing-seconds", "smopt", set("/cpu_seconds/smoothing", 1000)},
      {"smoothing-is-linear", "smopt",
       [](Json& record) { record["cpu_seconds"]["smoothing"] = std::pow(record["moves"]["accepted"].get<double>(), 2); }},
      {"check-is-not-linear", "smopt", [](Json& record) { record["cpu_seconds"]["validity"] = record["moves"]["accepted"]; }},
      {"smoothing-dominates", "smopt", set("/cpu_seconds/cavities", 100)},
      {"screening", "smopt", set("/each_round", {{{"active", 100}}, {{"active", 90}}})},
      {"fewer-and-fewer", "smopt", set("/each_round", {{{"active", 100}}, {{"active", 5}}, {{"active", 6}}})},
      {"converges", "smopt", set("/rounds", 100)},
      {"halving-always-ends", "smopt", set("/moves/refused", 1)},
      {"greatly-improved", "smopt", set(after + "min_angle_share/below_10", 0.05)},
      {"area-hardly-changes", "smopt", set(after + "area", 92)},
      {"area-shrinks", "smopt", set(after + "area", 101)},
      {"volume-kept", "smopt", set(after + "volume", 96.5)},
      {"initial-ratios-uniform", "initial", set(after + "edge_ratio/histogram", ratio_histogram(0.4, 0.8))},
      {"more-concentrated", "smopt", set(after + "edge_ratio/histogram", ratio_histogram(0, 1))},
      {"no-low-ratio", "smopt", set(after + "edge_ratio/below_0.1", 1e-5)},
      {"angles-clustered", "smopt", set(after + "angle_deg/histogram", angle_histogram(20, 100))},
      {"few-sharp-angles", "smopt", set(after + "angle_deg/histogram", angle_histogram(8, 100))},
      {"iso2mesh-pairs", "iso2mesh", set(after + "intersecting_pairs", 0)},
      {"iso2mesh-vertices", "iso2mesh", set(after + "vertices", 1000)},
      {"iso2mesh-preserves", "iso2mesh", set_both(set(after + "area", 60), set(after + "volume", 90))},
      {"meshlab-diverges", "meshlab", set("/diverged_at_step", nullptr)},
      {"vicinity-suffices", "smopt-vicinity", set(after + "intersecting_pairs", 64)},
      {"kept-cavities-collapse", "smopt-kept", set(after + "intersecting_pairs", 0)},
      {"million-atoms", "initial", set(after + "closed", false)},
      {"smopt2-no-pairs", "smopt2", set(after + "intersecting_pairs", 1)},
      {"smopt2-smallest-angle", "smopt2", set(after + "angle_deg/min", 24)},
      {"smopt2-largest-angle", "smopt2", set(after + "angle_deg/max", 126)},
      {"smopt2-valence", "smopt2", set(after + "valence/share_5_6_7", 0.9)},
      {"smopt2-volume", "smopt2", set(after + "volume", 99.9)},
      {"smopt2-area", "smopt2", set(after + "area", 97)},
      {"smopt2-level-set", "smopt2", set("/level_set_distance/after/mean", 0.06)},
      {"smopt2-tetgen", "smopt2", set("/tetgen", tetgen("failed"))},
      {"smopt2-cost", "smopt2", set("/cpu_seconds/total", 0.05)},
  };
}

class EveryClaim : public ::testing::TestWithParam<Refutation> {};

TEST_P(EveryClaim, HoldsWhereItIsSoAndNotWhereItIsNot) {
  std::vector<Json> records = good_records();
  const Evidence holds = evidence_for(GetParam().id, records);
  EXPECT_EQ(holds.verdict, ClaimVerdict::holds) << holds.ours;
  EXPECT_FALSE(holds.ours.empty());
  for (Json& record : records)
    if (record["method"] == GetParam().method) GetParam().change(record);
  const Evidence fails = evidence_for(GetParam().id, records);
  EXPECT_EQ(fails.verdict, ClaimVerdict::does_not_hold) << fails.ours;
}

TEST_P(EveryClaim, CannotBeToldWithoutItsRecords) {
  std::vector<Json> records = good_records();
  std::erase_if(records, [](const Json& record) { return record["method"] == GetParam().method; });
  EXPECT_EQ(evidence_for(GetParam().id, records).verdict, ClaimVerdict::cannot_be_told);
}

INSTANTIATE_TEST_SUITE_P(Claims, EveryClaim, ::testing::ValuesIn(refutations()), [](const auto& instance) {
  std::string name = instance.param.id;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Claims, TwoPartsThatDisagreeHoldInPart) {
  for (const auto& [id, method, pointer, value] : {std::tuple("ratios-clustered", "iso2mesh", "/metrics/after/edge_ratio/median", 0.4),
                                                   std::tuple("closer-to-the-surface", "smopt", "/level_set_distance/after/mean", 0.1),
                                                   std::tuple("iso2mesh-preserves", "iso2mesh", "/metrics/after/area", 60.0)}) {
    std::vector<Json> records = good_records();
    EXPECT_EQ(evidence_for(id, records).verdict, ClaimVerdict::holds) << id;
    for (Json& record : records)
      if (record["method"] == method) record[Json::json_pointer(pointer)] = value;
    EXPECT_EQ(evidence_for(id, records).verdict, ClaimVerdict::in_part) << id;
  }
}

TEST(Claims, AClaimThatHoldsOnSomeMoleculesHoldsInPart) {
  std::vector<Json> records = good_records();
  for (Json& record : records)
    if (record["method"] == "smopt" && record["molecule"]["name"] == "connexin") record["metrics"]["after"]["volume"] = 90;
  const Evidence evidence = evidence_for("volume-kept", records);
  EXPECT_EQ(evidence.verdict, ClaimVerdict::in_part);
  EXPECT_THAT(evidence.ours, HasSubstr("The connexin: -10.00 %"));
  EXPECT_THAT(evidence.ours, HasSubstr("The AChE monomer: -1.00 %"));
}

TEST(Claims, AFailedCaseCountsAgainstAClaimAndIsNamed) {
  std::vector<Json> records = good_records();
  for (Json& record : records)
    if (record["method"] == "smopt" && record["molecule"]["name"] == "connexin") mark_failed(record, "out of memory");
  const Evidence evidence = evidence_for("no-pairs", records);
  EXPECT_EQ(evidence.verdict, ClaimVerdict::in_part);
  EXPECT_THAT(evidence.ours, HasSubstr("The connexin failed (out of memory)"));
}

TEST(Claims, MoleculesThatThePaperDoesNotHaveAreARange) {
  std::vector<Json> records = good_records();
  for (const auto& [name, area] : {std::pair("fas2", 97.0), std::pair("1a63", 99.0)}) {
    Json record = GoodMolecule("connexin").smopt_record();
    record["molecule"]["name"] = name;
    record["molecule"]["paper_row"] = nullptr;
    record["metrics"]["after"]["area"] = area;
    records.push_back(record);
  }
  EXPECT_THAT(evidence_for("area-shrinks", records).ours, HasSubstr("2 others: -3.00 % to -1.00 %"));
}

TEST(Claims, TheEnergyOfAStandInIsNotHeldAgainstThePapers) {
  std::vector<Json> records = good_records();
  for (Json& record : records) record["molecule"]["role"] = "stand-in";
  EXPECT_EQ(evidence_for("energies", records).verdict, ClaimVerdict::cannot_be_told);
}

TEST(Claims, ATrendNeedsMoleculesOfDifferentSizes) {
  std::vector<Json> records = good_records();
  std::erase_if(records, [](const Json& record) { return record["molecule"]["name"] == "AChE tetramer"; });
  EXPECT_EQ(evidence_for("smoothing-is-linear", records).verdict, ClaimVerdict::cannot_be_told);
}

TEST(Claims, EveryOneIsAnsweredOnceByAPredicateOrByAnArgument) {
  std::set<std::string> answered;
  for (const Predicate& predicate : all_predicates()) EXPECT_TRUE(answered.emplace(predicate.id).second) << predicate.id;
  std::set<std::string> claims;
  for (const Claim& claim : all_claims()) {
    EXPECT_TRUE(claims.insert(claim.id).second) << claim.id;
    EXPECT_NE(claim.is_argued, answered.contains(claim.id)) << claim.id;
    EXPECT_FALSE(claim.why.empty()) << claim.id;
    EXPECT_TRUE(!claim.is_argued || claim.why.contains(claim.argued)) << claim.id;
  }
  for (const std::string& id : answered) EXPECT_TRUE(claims.contains(id)) << id;
}

TEST(Claims, EveryPredicateIsTestedBothWays) {
  std::set<std::string> tested = {"ratios-clustered", "closer-to-the-surface"};  // TwoPartsThatDisagreeHoldInPart
  for (const Refutation& refutation : refutations()) tested.insert(refutation.id);
  for (const Predicate& predicate : all_predicates()) EXPECT_TRUE(tested.contains(std::string(predicate.id))) << predicate.id;
}

TEST(Claims, AnEntryThatCannotBeMeantIsRefusedByItsNumber) {
  const std::string entry = R"({"id": "a", "group": "b", "section": "c", "claim": "d", "paper": "e", "why": {"perhaps": "f"}})";
  EXPECT_THAT([&] { parse_claims("{\"claims\": [" + entry + "]}"); }, ::testing::ThrowsMessage<InvalidInput>(HasSubstr("entry 1")));
  EXPECT_THROW(parse_claims("{"), InvalidInput);
}

TEST(ClaimsPage, HasARowForEveryClaimWithFiguresVerdictAndReason) {
  const std::string page = claims_markdown(records_of(good_records()));
  for (const Claim& claim : all_claims()) EXPECT_THAT(page, HasSubstr("| " + claim.text));
  EXPECT_THAT(page, HasSubstr("The AChE monomer: 57 (paper 57); The AChE tetramer: 57 (paper 256); The connexin: 57 (paper 10)"));
  EXPECT_THAT(page, HasSubstr("3 of the paper's 6 rows"));
  EXPECT_THAT(page, HasSubstr("does not hold: 2, cannot be told: 1")) << "those that are answered by argument";
  EXPECT_THAT(page, Not(HasSubstr("does not hold** |  |")));
}

/// Bars that are not part of a cell's text.
long cell_borders(const std::string& line) {
  long count = 0;
  for (std::size_t i = 0; i < line.size(); ++i) count += line[i] == '|' && (i == 0 || line[i - 1] != '\\') ? 1 : 0;
  return count;
}

TEST(ClaimsPage, EveryLineOfATableHasAsManyCells) {
  const std::string page = claims_markdown(records_of(good_records()));
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) EXPECT_TRUE(!line.starts_with("|") || cell_borders(line) == 6) << line;
}

TEST(ClaimsPage, IsWrittenWhereItIsAskedFor) {
  const TemporaryFolder folder;
  const RecordSet records = records_of(good_records());
  write_claims(records, folder.path() / "README.md");
  EXPECT_EQ(bytes_of(folder.path() / "README.md"), claims_markdown(records));
}

}  // namespace
}  // namespace smopt::experiments
