#include <gmock/gmock.h>

#include <algorithm>

#include "experiments/datasets.h"
#include "smopt/error.h"
#include "tests/experiments/made_records.h"
#include "tests/support/files.h"

namespace smopt::experiments {
namespace {

using smopt::testing::made_dataset;
using smopt::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Dataset of_file(const std::string& name, const std::string& file) {
  Dataset dataset = made_dataset(name);
  dataset.path.clear();
  dataset.file = file;
  dataset.pdb = "1ABC";
  return dataset;
}

const Dataset& named(const std::vector<Dataset>& datasets, const std::string& name) {
  return *std::ranges::find(datasets, name, &Dataset::name);
}

TEST(DataFolder, GivesTheFilesThatDatasetsAskFor) {
  const TemporaryFolder folder;
  const auto path = folder.file("entry.pqr.gz", "");
  const auto datasets = with_data_folder(std::vector{of_file("connexin", "entry.pqr.gz"), made_dataset("other")}, folder.path());
  ASSERT_EQ(datasets.size(), 2U);
  EXPECT_EQ(datasets[0].path, path);
  EXPECT_TRUE(datasets[0].is_of_folder);
  EXPECT_FALSE(datasets[1].is_of_folder);
}

TEST(DataFolder, AddsMoleculesAndMeshesOfTheUsers) {
  const TemporaryFolder folder;
  const auto molecule = folder.file("a.pqr", ""), mesh = folder.file("b.off", ""), both = folder.file("c.pdb.gz", ""),
             surface = folder.file("c.ply", "");
  static_cast<void>(folder.file("notes.txt", ""));
  const auto datasets = with_data_folder({}, folder.path());
  ASSERT_EQ(datasets.size(), 3U);
  EXPECT_EQ(named(datasets, "a").path, molecule);
  EXPECT_TRUE(named(datasets, "a").mesh.empty());
  EXPECT_TRUE(named(datasets, "b").path.empty());
  EXPECT_EQ(named(datasets, "b").mesh, mesh);
  EXPECT_FALSE(named(datasets, "b").has_solvation) << "there is no molecule";
  EXPECT_EQ(named(datasets, "c").path, both);
  EXPECT_EQ(named(datasets, "c").mesh, surface);
  for (const Dataset& dataset : datasets) {
    EXPECT_EQ(dataset.role, Role::extra);
    EXPECT_TRUE(dataset.suites.empty());
    EXPECT_EQ(dataset.surface.spacing, GaussianSurfaceOptions().spacing);
  }
}

TEST(DataFolder, AReadyMeshTakesThePlaceOfAKnownMoleculesSurface) {
  const TemporaryFolder folder;
  const auto mesh = folder.file("ache-monomer.off", "");
  const Dataset dataset = with_data_folder(all_datasets(), folder.path()).front();
  EXPECT_EQ(dataset.name, "ache-monomer");
  EXPECT_EQ(dataset.mesh, mesh);
  EXPECT_EQ(dataset.path, all_datasets().front().path) << "its charges";
}

TEST(DataFolder, AMoleculeOfTheUsersTakesAKnownOnesPlaceAsItIs) {
  const TemporaryFolder folder;
  const auto molecule = folder.file("1ubi.pqr", "");
  const std::vector<Dataset> datasets = with_data_folder(all_datasets(), folder.path());
  const Dataset& dataset = named(datasets, "1ubi");
  ASSERT_TRUE(named(all_datasets(), "1ubi").is_prepared_by_pdb2pqr) << "or this test shows nothing";
  EXPECT_EQ(dataset.path, molecule);
  EXPECT_FALSE(dataset.is_prepared_by_pdb2pqr);
  EXPECT_EQ(dataset.package, "") << "it comes from elsewhere";
}

TEST(DataFolder, OfSeveralFilesOfOneMoleculePqrIsTaken) {
  const TemporaryFolder folder;
  static_cast<void>(folder.file("a.cif", ""));
  static_cast<void>(folder.file("a.pdb", ""));
  const auto molecule = folder.file("a.pqr.gz", "");
  EXPECT_EQ(with_data_folder({}, folder.path()).front().path, molecule);
}

TEST(DataFolder, FilesOfARelativeFolderAreAbsolute) {
  const TemporaryFolder folder;
  const auto molecule = folder.file("a.pqr", "");
  const auto datasets = with_data_folder({}, std::filesystem::relative(folder.path()));
  EXPECT_TRUE(datasets.front().path.is_absolute());
  EXPECT_TRUE(std::filesystem::equivalent(datasets.front().path, molecule));
}

TEST(DataFolder, WhatIsNotThereIsToldWithTheWayToGetIt) {
  EXPECT_THAT([] { require_files(std::vector{of_file("connexin", "entry.pqr.gz")}); },
              ThrowsMessage<InvalidInput>(AllOf(HasSubstr("connexin"), HasSubstr("entry.pqr.gz"), HasSubstr("--data"), HasSubstr("1ABC"))));
  EXPECT_THAT([] { with_data_folder({}, "/nowhere/at/all"); }, ThrowsMessage<InvalidInput>(HasSubstr("/nowhere/at/all")));
}

TEST(DataFolder, ADatasetIsReadBackAsItWasWritten) {
  Dataset dataset = of_file("connexin", "entry.pqr.gz");
  dataset.path = "/data/entry.pqr.gz";
  dataset.mesh = "/data/connexin.off";
  dataset.suites = {"paper"};
  dataset.paper_row = "connexin";
  dataset.is_prepared_by_pdb2pqr = dataset.has_solvation = true;
  dataset.surface.spacing = 1.05;
  const nlohmann::ordered_json list = {{"molecules", {to_json(dataset)}}};
  const Dataset read = parse_datasets(list.dump()).front();
  EXPECT_EQ(to_json(read), to_json(dataset));
  EXPECT_EQ(read.path, dataset.path);
  EXPECT_EQ(read.mesh, dataset.mesh);
}

}  // namespace
}  // namespace smopt::experiments
