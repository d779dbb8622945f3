#include <gmock/gmock.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

#include "experiments/figures/figure4_input.h"
#include "experiments/figures/figures.h"
#include "experiments/run_layout.h"
#include "smopt/error.h"
#include "smopt/io/mesh_io.h"
#include "tests/experiments/made_records.h"
#include "tests/support/files.h"

namespace smopt::experiments {
namespace {

using smopt::testing::bytes_of;
using smopt::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kPovray = "/usr/bin/povray";

/// A square pyramid without its base, and a triangle that stands in one of its sides where `has_pair`.
TriangleMesh made_mesh(bool has_pair) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0.5, 0.5, 0.5}, {0.2, 0.2, 0.1}, {0.6, 0.1, 0.6}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  if (has_pair) mesh.triangles.push_back({5, 6, 7});
  return mesh;
}

void save(const std::filesystem::path& directory, const Json& record) {
  const auto path = record_path(directory, record.at("molecule").at("name").get<std::string>(), record.at("method").get<std::string>());
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << record.dump();
}

void save_mesh(const std::filesystem::path& directory, const std::string& molecule, const std::string& method, bool has_pair) {
  std::filesystem::create_directories(directory / "meshes" / molecule);
  write_mesh(directory / "meshes" / molecule / (method + ".off"), made_mesh(has_pair));
}

/// The AChE monomer with three methods, of which SMOPT failed; and another molecule.
void save_run(const std::filesystem::path& directory) {
  const Dataset ache = testing::ache_monomer();
  save(directory, testing::made_record(testing::made_dataset("aaa"), "initial"));
  for (const char* method : {"initial", "iso2mesh"}) save(directory, testing::made_record(ache, method));
  save(directory, testing::failed_record(ache, "smopt", "out of luck"));
}

std::vector<std::string> draw(const std::filesystem::path& directory, const FigureOptions& options = {}) {
  return draw_figures(RecordSet::load(directory), directory, {}, options);
}

std::string figure(const std::filesystem::path& directory, const char* name) {
  return bytes_of(directory / "figures" / name);
}

TEST(Figure4, ShowsThePapersMoleculeUnlessAnotherIsNamed) {
  const TemporaryFolder folder;
  save_run(folder.path());
  const RecordSet records = RecordSet::load(folder.path());
  EXPECT_EQ(figure4_molecule(records, ""), "ache-monomer");
  EXPECT_EQ(figure4_molecule(records, "aaa"), "aaa");
  EXPECT_THROW(figure4_molecule(records, "zzz"), InvalidOption);
}

TEST(Figure4, ItsInputNamesThePairOfIso2meshsMesh) {
  const TemporaryFolder folder;
  save_mesh(folder.path(), "m", "initial", false);
  save_mesh(folder.path(), "m", "iso2mesh", true);
  const ScratchFolder scratch("test");
  const auto input = figure4_input(folder.path(), "m", scratch);
  ASSERT_TRUE(input);
  EXPECT_EQ(input->at("pair").at("faces"), Json({0, 4}));
  EXPECT_TRUE(input->at("panels")[1].at("mesh").is_null());
  EXPECT_EQ(read_mesh(input->at("panels")[2].at("mesh").get<std::string>()).triangle_count(), 5U);
}

TEST(Figure4, ItsInputSaysWhyThereIsNoPair) {
  const TemporaryFolder folder;
  save_mesh(folder.path(), "m", "iso2mesh", false);
  const ScratchFolder scratch("test");
  const auto input = figure4_input(folder.path(), "m", scratch);
  ASSERT_TRUE(input);
  EXPECT_TRUE(input->at("pair").is_null());
  EXPECT_THAT(input->at("why_no_pair").get<std::string>(), HasSubstr("no intersecting pair"));
}

TEST(Figure4, IsLeftOutWithAWordWhereNoMeshWasKeptAndAnEarlierOneStays) {
  const TemporaryFolder folder;
  save_run(folder.path());
  std::filesystem::create_directories(folder.path() / "figures");
  std::ofstream(folder.path() / "figures" / "fig4.png") << "as it was";
  EXPECT_THAT(draw(folder.path()), ElementsAre(AllOf(HasSubstr("figure 4"), HasSubstr("ache-monomer"), HasSubstr("--keep-meshes"))));
  EXPECT_EQ(figure(folder.path(), "fig4.png"), "as it was");
}

TEST(Figure4, WithoutPovrayIsLeftOutAndThePackageIsNamedAndTheOthersAreDrawn) {
  const TemporaryFolder folder;
  save_run(folder.path());
  save_mesh(folder.path(), "ache-monomer", "initial", false);
  setenv("SMOPT_POVRAY", "/nowhere/povray", 1);
  const std::vector<std::string> notes = draw(folder.path());
  unsetenv("SMOPT_POVRAY");
  EXPECT_THAT(notes, ElementsAre(AllOf(HasSubstr("figure 4"), HasSubstr("Debian package povray"))));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "figures" / "fig4.png"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "figures" / "fig7.png"));
}

TEST(Figure4, IsRenderedTheSameTwiceAndSaysWhatIsMissingInItsPanel) {
  if (!std::filesystem::exists(kPovray)) GTEST_SKIP() << "needs Debian's package povray";
  const TemporaryFolder folder;
  save_run(folder.path());
  save_mesh(folder.path(), "ache-monomer", "initial", false);
  save_mesh(folder.path(), "ache-monomer", "iso2mesh", true);
  EXPECT_THAT(draw(folder.path()), IsEmpty());
  const std::string svg = figure(folder.path(), "fig4.svg"), png = figure(folder.path(), "fig4.png");
  EXPECT_THAT(svg, HasSubstr("out of luck"));
  EXPECT_THAT(svg, HasSubstr("where they cross")) << "the legend of a pair";
  EXPECT_THAT(svg, Not(HasSubstr("not kept")));
  draw(folder.path());
  EXPECT_TRUE(svg == figure(folder.path(), "fig4.svg"));
  EXPECT_TRUE(png == figure(folder.path(), "fig4.png"));
}

TEST(Figure4, WithoutAPairSaysSo) {
  if (!std::filesystem::exists(kPovray)) GTEST_SKIP() << "needs Debian's package povray";
  const TemporaryFolder folder;
  save_run(folder.path());
  save_mesh(folder.path(), "ache-monomer", "iso2mesh", false);
  EXPECT_THAT(draw(folder.path()), IsEmpty());
  const std::string svg = figure(folder.path(), "fig4.svg");
  EXPECT_THAT(svg, HasSubstr("of this molecule has no")) << "the line is broken after that";
  EXPECT_THAT(svg, HasSubstr("its mesh was not kept"));
  EXPECT_THAT(svg, Not(HasSubstr("where they cross")));
}

}  // namespace
}  // namespace smopt::experiments
