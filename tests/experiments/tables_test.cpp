#include <gmock/gmock.h>

#include <algorithm>

#include "experiments/tables/methods_table.h"
#include "experiments/tables/table1.h"
#include "experiments/tables/table2.h"
#include "experiments/tables/table3.h"
#include "experiments/tables/write_tables.h"
#include "tests/experiments/made_records.h"
#include "tests/support/files.h"

namespace smopt::experiments {
namespace {

using smopt::testing::ache_monomer;
using smopt::testing::failed_record;
using smopt::testing::made_dataset;
using smopt::testing::made_record;
using smopt::testing::set_cpu_seconds;
using smopt::testing::set_solvation;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kDash = "—";

RecordSet records_of(const std::vector<Json>& list) {
  RecordSet records;
  for (const Json& record : list) records.add(record, "made for a test");
  return records;
}

/// All three default methods, done.
std::vector<Json> three_methods(const Dataset& dataset) {
  return {made_record(dataset, "initial"), made_record(dataset, "smopt"), made_record(dataset, "laplacian")};
}

/// What stands in a table where a molecule's row meets a column.
std::string cell(const Table& table, const std::string& title, const std::string& column_id) {
  const auto column = std::find_if(table.columns.begin(), table.columns.end(), [&](const Column& c) { return c.id == column_id; });
  const auto row = std::find_if(table.rows.begin(), table.rows.end(),
                                [&](const std::vector<Cell>& cells) { return cell_text(cells.front(), kDash) == title; });
  if (column == table.columns.end()) return "no column " + column_id;
  if (row == table.rows.end()) return "no row " + title;
  return cell_text((*row)[static_cast<std::size_t>(column - table.columns.begin())], kDash);
}

const std::string kAche = "AChE monomer";

TEST(Tables, ShowThePapersValuesBesideOurs) {
  const RecordSet records = records_of(three_methods(ache_monomer()));
  const Table one = table1(records);
  EXPECT_EQ(cell(one, kAche, "atoms"), "1000");
  EXPECT_EQ(cell(one, kAche, "paper_atoms"), "8280");
  EXPECT_EQ(cell(one, kAche, "triangles_improved"), "800");
  EXPECT_EQ(cell(one, kAche, "paper_triangles_improved"), "126782");
  EXPECT_EQ(cell(one, kAche, "paper_afmpb_initial"), "NaN");
  EXPECT_EQ(cell(one, kAche, "paper_afmpb_improved_kcal_per_mol"), "-2.50917e+03");
  const Table two = table2(records);
  EXPECT_EQ(cell(two, kAche, "paper_cpu_s_manifold_and_cavities"), "3.39");
  EXPECT_EQ(cell(two, kAche, "paper_cpu_s_redundant_points_and_smoothing"), "43.06");
  const Table three = table3(records);
  EXPECT_EQ(cell(three, kAche, "intersecting_pairs_laplacian"), "7");
  EXPECT_EQ(cell(three, kAche, "paper_intersecting_pairs_smopt"), "0");
  EXPECT_EQ(cell(three, kAche, "paper_intersecting_pairs_iso2mesh"), "57");
}

/// What stands in the table of all methods in a method's row.
std::string cell_of_method(const Table& table, const std::string& title, const std::string& column_id) {
  Table by_method = table;
  for (auto& row : by_method.rows) row.front() = row[1];
  return cell(by_method, title, column_id);
}

TEST(Tables, TheTableOfMethodsHasARowForEveryCaseHoweverItEnded) {
  std::vector<Json> list = three_methods(ache_monomer());
  list[1]["stopped_because"] = "nothing moved";
  list.push_back(made_record(ache_monomer(), "meshlab"));
  list.back()["stopped_because"] = "diverged at step 28";
  list.push_back(failed_record(ache_monomer(), "cgal_remesh", "too thin"));
  list.push_back(made_record(ache_monomer(), "external:mmgs"));
  mark_not_installed(list.back(), "mmgs is not installed");
  const Table table = methods_table(records_of(list));
  ASSERT_EQ(table.rows.size(), 6U);
  EXPECT_EQ(cell_text(table.rows[0][1], kDash), "initial");
  EXPECT_EQ(cell_of_method(table, "SMOPT", "intersecting_pairs"), "7");
  EXPECT_EQ(cell_of_method(table, "SMOPT", "ended"), "nothing moved");
  EXPECT_EQ(cell_of_method(table, "SMOPT", "tetgen_p"), "failed");
  EXPECT_EQ(cell_of_method(table, "SMOPT", "tetgen_pY"), "success");
  EXPECT_EQ(cell_of_method(table, "MeshLab", "ended"), "diverged at step 28");
  EXPECT_EQ(cell_of_method(table, "CGAL, isotropic remeshing", "ended"), "failed: too thin");
  EXPECT_EQ(cell_of_method(table, "MMG", "ended"), "not installed");
}

TEST(Tables, TheTableOfMethodsGivesChangesAgainstTheMeshThatTheMethodsGot) {
  std::vector<Json> list = three_methods(ache_monomer());
  for (Json& record : list) {
    record["metrics"]["before"]["area"] = 200.0;
    record["metrics"]["after"]["area"] = 150.0;
  }
  const Table table = methods_table(records_of(list));
  EXPECT_EQ(cell_of_method(table, "SMOPT", "area_change_percent"), "-25.00");
  EXPECT_EQ(cell_of_method(table, "initial", "area_change_percent"), kDash) << "nothing was done to it";
}

TEST(Tables, TheTableOfMethodsShowsWhatASimulationAsksFor) {
  std::vector<Json> list = three_methods(ache_monomer());
  list[1]["metrics"]["after"]["angle_deg"]["max"] = 123.456;
  list[1]["metrics"]["after"]["valence"] = {{"share_5_6_7", 0.98765}};
  list[1]["level_set_distance"] = {{"before", {{"mean", 0.02}}}, {"after", {{"mean", 0.05}}}};
  list[1]["tetgen"]["pq1.4"] = {{"status", "success"}};
  const Table table = methods_table(records_of(list));
  EXPECT_EQ(cell_of_method(table, "SMOPT", "max_angle_deg"), "123.46");
  EXPECT_EQ(cell_of_method(table, "SMOPT", "valence_5_6_7_percent"), "98.77");
  EXPECT_EQ(cell_of_method(table, "SMOPT", "level_set_distance_mean_A"), "0.0500");
  EXPECT_EQ(cell_of_method(table, "SMOPT", "level_set_distance_ratio"), "2.50");
  EXPECT_EQ(cell_of_method(table, "SMOPT", "tetgen_pq1.4"), "success");
  for (const char* column : {"max_angle_deg", "valence_5_6_7_percent", "level_set_distance_ratio", "tetgen_pq1.4"})
    EXPECT_EQ(cell_of_method(table, "plain Laplacian", column), kDash) << column;
}

TEST(Tables, TheTableOfMethodsSaysWhichMeanDistancesLeaveSamplesOut) {
  std::vector<Json> list = three_methods(ache_monomer());
  const std::size_t notes = methods_table(records_of(list)).notes.size();
  list[1]["level_set_distance"] = {{"before", {{"mean", 0.02}}}, {"after", {{"mean", 0.05}, {"unresolved", 12}}}};
  const Table table = methods_table(records_of(list));
  ASSERT_EQ(table.notes.size(), notes + 1);
  EXPECT_THAT(table.notes.back(), ::testing::AllOf(HasSubstr("AChE monomer, SMOPT: 12"), HasSubstr("of 200000")));
}

TEST(Tables, EveryRowIsAsLongAsTheHead) {
  const RecordSet records = records_of(three_methods(ache_monomer()));
  for (const Table& table : {table1(records), table2(records), table3(records), methods_table(records)})
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.name;
}

TEST(Tables, AMoleculeThatThePaperDoesNotHaveShowsADash) {
  const RecordSet records = records_of(three_methods(made_dataset("fas2")));
  EXPECT_EQ(cell(table1(records), "The fas2", "paper_atoms"), kDash);
  EXPECT_EQ(cell(table2(records), "The fas2", "paper_vertices_initial"), kDash);
  EXPECT_EQ(cell(table3(records), "The fas2", "paper_vertices_iso2mesh"), kDash);
}

TEST(Tables, AStandInIsCalledOneAndExplained) {
  Dataset dataset = made_dataset("70S", Role::stand_in);
  dataset.paper_row = "70S ribosome";
  const RecordSet records = records_of(three_methods(dataset));
  for (const Table& table : {table1(records), table2(records), table3(records)}) {
    EXPECT_EQ(cell(table, "The 70S (stand-in)", "paper_vertices_initial"), "1160599") << table.name;
    EXPECT_THAT(table.notes, Contains(HasSubstr("The 70S (stand-in): made for a test"))) << table.name;
  }
}

TEST(Tables, ACaseOfOtherOptionsThanItsNameStandsForIsExplained) {
  std::vector<Json> records = three_methods(made_dataset("fas2"));
  for (Json& record : records)
    if (record.at("method") == "smopt") record["method_title"] = "SMOPT (guard=none)";
  for (const Table& table : {table1(records_of(records)), table2(records_of(records)), table3(records_of(records))})
    EXPECT_THAT(table.notes, Contains("The fas2: SMOPT (guard=none) in place of SMOPT.")) << table.name;
}

TEST(Tables, AFailedCaseIsARowWithItsReason) {
  const RecordSet records = records_of({made_record(ache_monomer(), "initial"), failed_record(ache_monomer(), "smopt", "out of memory")});
  EXPECT_EQ(cell(table1(records), kAche, "vertices_improved"), "failed: out of memory");
  EXPECT_EQ(cell(table2(records), kAche, "vertices_improved"), "failed: out of memory");
  EXPECT_EQ(cell(table3(records), kAche, "vertices_smopt"), "failed: out of memory");
  EXPECT_EQ(cell(table1(records), kAche, "vertices_initial"), "400");
  EXPECT_EQ(cell(table3(records), kAche, "intersecting_pairs_smopt"), kDash);
  EXPECT_EQ(cell(table1(records), kAche, "tetgen_p_improved"), kDash);
}

TEST(Tables, ACaseThatWasNotRunSaysSo) {
  const RecordSet records = records_of({made_record(ache_monomer(), "initial")});
  EXPECT_EQ(cell(table1(records), kAche, "vertices_improved"), "not run");
  EXPECT_EQ(cell(table2(records), kAche, "cpu_s_redundant_points_and_smoothing"), kDash);
}

TEST(Tables, AMissingMetricIsADash) {
  std::vector<Json> list = three_methods(ache_monomer());
  list[1]["metrics"]["after"]["intersecting_pairs"] = nullptr;
  const RecordSet records = records_of(list);
  EXPECT_EQ(cell(table3(records), kAche, "intersecting_pairs_smopt"), kDash);
  EXPECT_EQ(cell(table3(records), kAche, "vertices_smopt"), "400");
}

TEST(Table1, TellsWhyTetgenFailed) {
  const RecordSet records = records_of(three_methods(ache_monomer()));
  EXPECT_EQ(cell(table1(records), kAche, "tetgen_p_improved"), "Failed: too sharp");
  EXPECT_EQ(cell(table1(records), kAche, "tetgen_pY_improved"), "Success");
  EXPECT_EQ(cell(table1(records), kAche, "paper_tetgen_initial"), "Failed");
}

TEST(Table1, ShowsWhatTheSolverFoundOrWhyItFoundNothing) {
  std::vector<Json> list = three_methods(ache_monomer());
  set_solvation(list[1], -2509.17, 12, 3);
  const Table table = table1(records_of(list));
  EXPECT_EQ(cell(table, kAche, "afmpb_initial_kcal_per_mol"), "not computed: not asked for");
  EXPECT_EQ(cell(table, kAche, "afmpb_improved_kcal_per_mol"), "-2509.2");
  EXPECT_EQ(cell(table, kAche, "solver_iterations_initial"), kDash);
  EXPECT_EQ(cell(table, kAche, "solver_iterations_improved"), "12");
  EXPECT_EQ(cell(table, kAche, "degenerate_vertices_improved"), "3");
  EXPECT_THAT(table.notes, Contains("AChE monomer, improved: polar -2809.2, nonpolar 300.0 kcal/mol."));
}

TEST(Table1, ShowsNoEnergyOfASolutionThatDidNotConverge) {
  std::vector<Json> list = three_methods(ache_monomer());
  set_solvation(list[0], -2509.17, 100, 0);
  list[0]["solvation"]["status"] = "not_converged";
  list[0]["solvation"]["reason"] = "residual 0.1 after 100 iterations";
  list[1]["solvation"] = {{"status", "over limit"}, {"reason", "needs 13000 MB"}};
  const Table table = table1(records_of(list));
  EXPECT_EQ(cell(table, kAche, "afmpb_initial_kcal_per_mol"), "not_converged: residual 0.1 after 100 iterations");
  EXPECT_EQ(cell(table, kAche, "solver_iterations_initial"), "100");
  EXPECT_EQ(cell(table, kAche, "afmpb_improved_kcal_per_mol"), "over limit: needs 13000 MB");
  EXPECT_THAT(table.notes, Contains(HasSubstr("converges on none of the initial meshes")));
}

TEST(Table1, SaysWhereTheSolverTakesTheInitialMeshToo) {
  std::vector<Json> list = three_methods(ache_monomer());
  EXPECT_THAT(table1(records_of(list)).notes, Contains(HasSubstr("was run on none of the initial meshes")));
  set_solvation(list[0], -2500, 20, 7);
  EXPECT_THAT(table1(records_of(list)).notes, Contains(AllOf(HasSubstr("converges on the initial mesh too"), HasSubstr("AChE monomer"))));
}

TEST(Table1, SaysWhereTetgenTakesTheInitialMeshToo) {
  const Table table = table1(records_of(three_methods(ache_monomer())));
  EXPECT_THAT(table.notes, Contains(HasSubstr("TetGen -p succeeds on none of the initial meshes")));
  EXPECT_THAT(table.notes, Contains(AllOf(HasSubstr("TetGen -pY succeeds on the initial mesh too"), HasSubstr("AChE monomer"))));
}

TEST(Table2, AddsStagesRepeatByRepeatAndTakesTheMedianOfTheSums) {
  std::vector<Json> list = three_methods(ache_monomer());
  // The sums differ from what the stages' medians add up to: 3 and 9 against 2 + 2 and 5 + 3.
  set_cpu_seconds(list[1], {{1, 2, 1, 10}, {2, 5, 5, 2}, {3, 0, 6, 3}});
  set_cpu_seconds(list[2], {{0, 0, 0, 5}, {0, 0, 0, 4}, {0, 0, 0, 100}});
  const Table table = table2(records_of(list));
  EXPECT_EQ(cell(table, kAche, "cpu_s_manifold_and_cavities"), "3.000");
  EXPECT_EQ(cell(table, kAche, "cpu_s_redundant_points_and_smoothing"), "9.000");
  EXPECT_EQ(cell(table, kAche, "cpu_s_plain_laplacian"), "5.000");
  EXPECT_EQ(cell(table, kAche, "smoothing_to_plain_laplacian"), "0.60");
  EXPECT_THAT(table.notes, Contains(HasSubstr("100 rounds")));
}

TEST(Table2, HasNoRatioToAMethodThatTookNoTime) {
  const Table table = table2(records_of(three_methods(ache_monomer())));
  EXPECT_EQ(cell(table, kAche, "smoothing_to_plain_laplacian"), kDash);
}

TEST(Table3, ShowsTheMethodsThatBelongBesideThePapers) {
  std::vector<Json> list = three_methods(ache_monomer());
  list.push_back(made_record(ache_monomer(), "meshlab"));
  list.push_back(made_record(ache_monomer(), "taubin"));
  const Table table = table3(records_of(list));
  EXPECT_EQ(cell(table, kAche, "intersecting_pairs_meshlab"), "7");
  EXPECT_EQ(cell(table, kAche, "intersecting_pairs_taubin"), "no column intersecting_pairs_taubin");
}

TEST(Table3, SaysWhichResultsDiverged) {
  std::vector<Json> list = three_methods(ache_monomer());
  list.push_back(made_record(ache_monomer(), "meshlab"));
  EXPECT_THAT(table3(records_of(list)).notes, Not(Contains(HasSubstr("diverged"))));
  list.back()["diverged_at_step"] = 36;
  EXPECT_THAT(table3(records_of(list)).notes, Contains("MeshLab diverged at step 36 on AChE monomer."));
}

TEST(Table3, ShowsIso2meshBesideThePapersWhenItRan) {
  std::vector<Json> list = three_methods(ache_monomer());
  const Table without = table3(records_of(list));
  EXPECT_THAT(cell(without, kAche, "vertices_iso2mesh"), HasSubstr("no column"));
  list.push_back(made_record(ache_monomer(), "iso2mesh"));
  const Table with = table3(records_of(list));
  EXPECT_EQ(cell(with, kAche, "vertices_iso2mesh"), "400");
  EXPECT_EQ(cell(with, kAche, "paper_vertices_iso2mesh"), "63341");
}

TEST(Tables, AreWrittenInThreeForms) {
  const smopt::testing::TemporaryFolder folder;
  write_tables(records_of(three_methods(ache_monomer())), folder.path() / "tables");
  for (const char* name : {"table1", "table2", "table3", "methods"})
    for (const char* ending : {".md", ".csv", ".tex"})
      EXPECT_THAT(smopt::testing::bytes_of(folder.path() / "tables" / (std::string(name) + ending)), HasSubstr("AChE monomer"));
}

}  // namespace
}  // namespace smopt::experiments
