#include "experiments/figures/figures.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <optional>

#include "experiments/run_layout.h"
#include "smopt/error.h"
#include "smopt/io/child_process.h"
#include "smopt/io/mesh_io.h"
#include "tests/experiments/made_records.h"
#include "tests/support/files.h"

namespace smopt::experiments {
namespace {

using smopt::testing::bytes_of;
using smopt::testing::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

constexpr double kTimeLimitSeconds = 300;  // four figures take seconds; a busy machine may need more
constexpr const char* kFigures[] = {"fig5", "fig6", "fig7", "methods"};

void save(const std::filesystem::path& directory, const Json& record) {
  const auto path = record_path(directory, record.at("molecule").at("name").get<std::string>(), record.at("method").get<std::string>());
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << record.dump();
}

/// A case with what the figure of all methods shows.
Json compared_record(const Dataset& dataset, const char* method) {
  Json record = testing::made_record(dataset, method);
  record["metrics"]["after"]["angle_deg"]["min"] = 12.5;
  record["metrics"]["after"]["min_angle_share"] = {{"below_30", 0.25}};
  record["level_set_distance"] = {{"before", {{"mean", 0.02}}}, {"after", {{"mean", 0.03}}}};
  testing::set_cpu_seconds(record, {{1, 2, 3, 4}});
  return record;
}

/// Two molecules, one a stand-in, with four methods; one case failed, one diverged, two were not run. The plain Laplacian's mean leaves samples out,
/// and it took no time that could be measured.
void save_run(const std::filesystem::path& directory) {
  const Dataset ache = testing::ache_monomer();
  const Dataset stand_in = testing::made_dataset("capsid", Role::stand_in);
  for (const char* method : {"initial", "smopt"}) save(directory, compared_record(ache, method));
  Json plain = compared_record(ache, "laplacian");
  plain["level_set_distance"]["after"]["unresolved"] = 12;
  testing::set_cpu_seconds(plain, {{1, 2, 0, 0}});
  save(directory, plain);
  Json diverged = compared_record(ache, "meshlab");
  diverged["diverged_at_step"] = 7;
  save(directory, diverged);
  save(directory, testing::made_record(stand_in, "initial"));
  save(directory, testing::failed_record(stand_in, "smopt", "the reason of the failure"));
}

/// Runs the plotting program by itself; returns what it drew, by figure.
Json drawn_bars(const std::filesystem::path& directory) {
  const TemporaryFolder program;
  write_figure_programs(program.path());
  const auto dump = directory / "bars.json";
  const ProcessOutcome outcome =
      run_process({"/usr/bin/python3", (program.path() / "plot.py").string(), directory.string(), "--dump", dump.string()},
                  {kTimeLimitSeconds, 0}, "figures", {});
  EXPECT_EQ(outcome.exit_status, 0) << outcome.output;
  return Json::parse(bytes_of(dump));
}

const Json& panel(const Json& figure, int row, int column) {
  for (const Json& candidate : figure)
    if (candidate.at("row") == row && candidate.at("column") == column) return candidate;
  throw std::runtime_error("no such panel");
}

/// The figures of one run, drawn once by the library and once, into another folder, by the program itself.
class DrawnFigures : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    save_run(first_.emplace().path());
    save_run(second_.emplace().path());
    draw_figures(RecordSet::load(first_->path()), first_->path());
    bars_ = drawn_bars(second_->path());
  }
  static void TearDownTestSuite() {
    first_.reset();
    second_.reset();
  }

  static const Json& bars(const char* figure, int row, int column) { return panel(bars_.at(figure), row, column).at("bars"); }
  /// Of a molecule in a panel of the figure of all methods: [value, row of the method].
  static const Json& points(int column, const char* molecule) { return panel(bars_.at("methods"), 0, column).at("points").at(molecule); }

  static const Json& bars_of(const char* figure) { return bars_.at(figure); }
  static const Json& panel_of(const char* figure, int column) { return panel(bars_.at(figure), 0, column); }

  inline static std::optional<TemporaryFolder> first_;
  inline static std::optional<TemporaryFolder> second_;

 private:
  inline static Json bars_;
};

TEST_F(DrawnFigures, AreSvgAndPngAndTheSameBytesTwice) {
  for (const std::string name : kFigures) {
    const std::string svg = bytes_of(first_->path() / "figures" / (name + ".svg"));
    const std::string png = bytes_of(first_->path() / "figures" / (name + ".png"));
    EXPECT_THAT(svg, HasSubstr("</svg>")) << name;
    EXPECT_THAT(png, StartsWith("\x89PNG")) << name;
    EXPECT_TRUE(svg == bytes_of(second_->path() / "figures" / (name + ".svg"))) << name;
    EXPECT_TRUE(png == bytes_of(second_->path() / "figures" / (name + ".png"))) << name;
  }
}

TEST_F(DrawnFigures, TheBarsOfFigures6And7AreTheRecordsCounts) {
  const Json record = testing::made_record(testing::ache_monomer(), "smopt");
  for (const auto& [figure, quantity] : {std::pair("fig6", "edge_ratio"), std::pair("fig7", "angle_deg")}) {
    const Json& histogram = record.at("metrics").at("after").at(quantity).at("histogram");
    const Json& drawn = bars(figure, 0, 1);
    ASSERT_EQ(drawn.size(), histogram.at("counts").size()) << figure;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      EXPECT_NEAR(drawn[i][0].get<double>(), histogram.at("edges")[i].get<double>(), 1e-9) << figure;
      EXPECT_EQ(drawn[i][2], histogram.at("counts")[i]) << figure;
    }
    EXPECT_TRUE(bars(figure, 1, 1).empty()) << figure << ": a case that failed has no bars";
    EXPECT_TRUE(bars(figure, 1, 2).empty()) << figure << ": a case that was not run has no bars";
  }
}

TEST_F(DrawnFigures, Figure5ShowsTheInitialMeshWithAndWithoutCavitiesBesideEachMethod) {
  // Points of one series: the two molecules, as far as they have the value. MeshLab's mesh has diverged: no point.
  const auto values = [](int row, const char* series) {
    std::vector<double> list;
    const Json& all = panel(bars_of("fig5"), row, 0).at("points");
    if (all.contains(series))
      for (const Json& point : all.at(series)) list.push_back(point[0].get<double>());
    return list;
  };
  EXPECT_THAT(values(0, "initial"), ::testing::ElementsAre(290, 290));
  EXPECT_THAT(values(0, "initial, cavities deleted"), ::testing::ElementsAre(300.5));
  EXPECT_THAT(values(0, "smopt"), ::testing::ElementsAre(290));
  EXPECT_THAT(values(0, "meshlab"), ::testing::IsEmpty());
  EXPECT_THAT(values(1, "initial, cavities deleted"), ::testing::ElementsAre(900.25));
  EXPECT_THAT(values(1, "laplacian"), ::testing::ElementsAre(880));
}

TEST_F(DrawnFigures, Figure5TellsEachMethodsChangeAndWhyThereIsNone) {
  const Json& changes = panel(bars_of("fig5"), 1, 1);
  EXPECT_NEAR(changes.at("points").at("smopt")[0][0].get<double>(), 100 * (880 / 900.25 - 1), 1e-9);
  EXPECT_FALSE(changes.at("points").contains("initial")) << "no method's";
  EXPECT_THAT(changes.at("notes").get<std::vector<std::string>>(),
              ::testing::IsSupersetOf({"MeshLab: diverged at step 7", "SMOPT: failed", "plain Laplacian: not run"}));
}

TEST_F(DrawnFigures, TheFigureOfAllMethodsHasAPointForEachMethodThatHasTheNumber) {
  // Rows: initial, SMOPT, plain Laplacian, MeshLab. MeshLab has diverged, and the mesh as generated took no method's time.
  const auto values = [](int column, const char* molecule) {
    std::vector<double> list;
    for (const Json& point : points(column, molecule)) list.push_back(point[0].get<double>());
    return list;
  };
  EXPECT_THAT(values(0, "ache-monomer"), ::testing::ElementsAre(12.5, 12.5, 12.5));
  EXPECT_THAT(values(1, "ache-monomer"), ::testing::ElementsAre(25, 25, 25));
  EXPECT_THAT(values(2, "ache-monomer"), ::testing::Each(::testing::DoubleEq(1.5)));
  EXPECT_THAT(values(3, "ache-monomer"), ::testing::ElementsAre(7, 7, 7));
  EXPECT_THAT(values(4, "ache-monomer"), ::testing::ElementsAre(7)) << "redundant points and smoothing; a logarithmic axis has no 0";
  EXPECT_THAT(values(0, "capsid"), ::testing::IsEmpty()) << "its records have no such number, or failed";
  EXPECT_EQ(points(3, "capsid").size(), 1U);
}

TEST_F(DrawnFigures, TheFigureOfAllMethodsPutsAMethodsPointsInItsRow) {
  for (int row = 0; row < 3; ++row) EXPECT_NEAR(points(0, "ache-monomer")[static_cast<std::size_t>(row)][1].get<double>(), row, 0.5);
  EXPECT_NE(points(3, "ache-monomer")[0][1], points(3, "capsid")[0][1]) << "or one would hide the other";
}

TEST_F(DrawnFigures, TheFigureOfAllMethodsTellsWhereAResultHasNoPointAndWhatAPointLeavesOut) {
  // In the order of the molecules, then of the methods. The capsid's one result is that of the mesh as generated, with pairs alone.
  const auto notes = [](int column) { return panel_of("methods", column).at("notes").get<std::vector<std::string>>(); };
  EXPECT_THAT(notes(0), ::testing::UnorderedElementsAre("none", "1 failed", "1 diverged"));
  EXPECT_THAT(notes(1), ::testing::ElementsAre("none"));
  EXPECT_THAT(notes(2), ::testing::ElementsAre("12 without a foot", "none"));
  EXPECT_THAT(notes(3), ::testing::IsEmpty());
  EXPECT_THAT(notes(4), ::testing::ElementsAre("none", "0", "none")) << "the meshes as generated took no method's time";
}

/// Records of `count` molecules "m0", "m1", …, of which the first `paper` have a row in the paper, and of both SMOPT's.
void save_molecules(const std::filesystem::path& directory, int count, int paper) {
  for (int i = 0; i < count; ++i) {
    Dataset dataset = testing::made_dataset(fmt::format("m{:02}", i));
    if (i < paper) dataset.paper_row = dataset.title;
    for (const char* method : {"initial", "smopt"}) save(directory, compared_record(dataset, method));
  }
}

TEST(Figures, ThePapersFiguresShowThePapersMoleculesAndExtraPagesTheOthers) {
  const TemporaryFolder folder;
  save_molecules(folder.path(), 15, 3);
  const Json drawn = drawn_bars(folder.path());
  EXPECT_EQ(drawn.at("fig6").size(), 3U * 2) << "rows by columns";
  EXPECT_EQ(drawn.at("fig6-extra-1").size(), 10U * 2);
  EXPECT_EQ(drawn.at("fig6-extra-2").size(), 2U * 2);
  EXPECT_FALSE(drawn.contains("fig6-extra-3"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "figures" / "fig5-extra-2.svg"));
}

TEST(Figures, PagesOfALargerRunBeforeAreRemoved) {
  const TemporaryFolder folder;
  save_molecules(folder.path(), 4, 2);
  std::filesystem::create_directories(folder.path() / "figures");
  std::ofstream(folder.path() / "figures" / "fig6-extra-9.png") << "old";
  EXPECT_EQ(drawn_bars(folder.path()).at("fig6").size(), 4U * 2) << "two molecules of the paper are too few for a figure of their own";
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "figures" / "fig6-extra-9.png"));
}

TEST(Figures, OfManyMoleculesTheMedianIsShownAndTheOthersAreCounted) {
  const TemporaryFolder folder;
  save_molecules(folder.path(), 8, 0);
  save(folder.path(), testing::failed_record(testing::made_dataset("m01"), "smopt", "a reason"));
  const Json drawn = drawn_bars(folder.path());
  const Json& first = panel(drawn.at("methods"), 0, 0);
  ASSERT_EQ(first.at("points").at("median").size(), 2U);
  EXPECT_EQ(first.at("points").at("median")[1][0], 12.5);
  EXPECT_THAT(first.at("notes").get<std::vector<std::string>>(), ::testing::Contains("1 failed"));
}

/// Sets an environment variable until the end of the scope.
class WithEnvironment {
 public:
  WithEnvironment(const char* name, const std::string& value) : name_(name) {
    if (const char* old = getenv(name)) old_ = old;
    setenv(name, value.c_str(), 1);
  }
  ~WithEnvironment() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }
  WithEnvironment(const WithEnvironment&) = delete;
  WithEnvironment& operator=(const WithEnvironment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

TEST(Figures, APythonWithoutMatplotlibIsAnErrorThatNamesThePackage) {
  const TemporaryFolder folder;
  save_run(folder.path());
  // -S leaves out the folders of installed packages.
  const auto python = folder.file("python-without-packages", "#!/bin/sh\nexec /usr/bin/python3 -S \"$@\"\n");
  std::filesystem::permissions(python, std::filesystem::perms::owner_all);
  const WithEnvironment environment("SMOPT_PYTHON", python.string());
  EXPECT_THAT([&] { draw_figures(RecordSet::load(folder.path()), folder.path()); },
              ThrowsMessage<InvalidInput>(HasSubstr("python3-matplotlib")));
}

TEST(Figures, APythonThatDoesNotExistIsNamed) {
  const TemporaryFolder folder;
  save_run(folder.path());
  const WithEnvironment environment("SMOPT_PYTHON", (folder.path() / "no-python").string());
  EXPECT_THAT([&] { draw_figures(RecordSet::load(folder.path()), folder.path()); },
              ThrowsMessage<InvalidInput>(::testing::AllOf(HasSubstr("no-python"), HasSubstr("SMOPT_PYTHON"))));
}

}  // namespace
}  // namespace smopt::experiments
