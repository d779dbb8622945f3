#include "experiments/datasets.h"

#include <gmock/gmock.h>

#include <set>

#include "experiments/paper_table.h"
#include "smopt/error.h"

namespace smopt::experiments {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Property;
using ::testing::StartsWith;
using ::testing::Throws;
using ::testing::ThrowsMessage;

std::vector<std::string> names_of(const std::vector<Dataset>& datasets) {
  std::vector<std::string> names;
  for (const Dataset& dataset : datasets) names.push_back(dataset.name);
  return names;
}

constexpr const char* kOne = R"({"molecules": [{"name": "n", "title": "T", "paper_row": null, "role": "stand-in", "about": "a",
  "source": {"package": "p", "path": "/f.pqr"}, "surface": {"decay_per_A2": 0.5, "isovalue": 2, "spacing_A": 0.7}, "suites": ["quick"], "solvation": true}]})";

std::string one_with(const std::string& from, const std::string& to) {
  std::string text = kOne;
  return text.replace(text.find(from), from.size(), to);
}

TEST(Datasets, TheDefaultOnesAreTheFiveMoleculesOfTheMainJob) {
  EXPECT_THAT(names_of(datasets_of(all_datasets(), kDefaultSuite)), ElementsAre("ache-monomer", "achbp", "fas2", "actin-dimer", "1a63"));
  EXPECT_THAT(names_of(datasets_of(all_datasets(), kQuickSuite)), ElementsAre("fas2", "1a63", "hca-coarse"));
}

TEST(Datasets, ThePapersSuiteIsItsSixRows) {
  EXPECT_EQ(datasets_of(all_datasets(), kPaperSuite).size(), 6U);
  for (const Dataset& dataset : all_datasets()) {
    EXPECT_EQ(dataset.paper_row.has_value(), dataset.is_in(kPaperSuite)) << dataset.name;
    EXPECT_EQ(dataset.role != Role::extra, dataset.paper_row.has_value()) << dataset.name;
    EXPECT_EQ(dataset.role == Role::real, dataset.name == "ache-monomer") << dataset.name;
    EXPECT_EQ(paper_table(1).value(dataset.paper_row, "atoms").has_value(), dataset.paper_row.has_value()) << dataset.name;
  }
}

TEST(Datasets, AreMeshedAsTheProgramDoesByDefault) {
  const GaussianSurfaceOptions defaults;
  for (const Dataset& dataset : all_datasets()) {
    const bool has_grid_of_its_own = dataset.name == "4v5a_70S" || dataset.name == "hca-coarse";
    EXPECT_EQ(dataset.surface.decay, defaults.decay) << dataset.name;
    EXPECT_EQ(dataset.surface.isovalue, defaults.isovalue) << dataset.name;
    EXPECT_EQ(dataset.surface.spacing != defaults.spacing, has_grid_of_its_own) << dataset.name;
  }
}

TEST(Datasets, NameWhoseSolvationEnergiesTable1Shows) {
  std::vector<Dataset> solved = all_datasets();
  std::erase_if(solved, [](const Dataset& dataset) { return !dataset.has_solvation; });
  std::erase_if(solved, [](const Dataset& dataset) { return !dataset.is_in(kDefaultSuite); });
  EXPECT_THAT(names_of(solved), ElementsAre("ache-monomer", "fas2"));
  for (const Dataset& dataset : datasets_of(all_datasets(), kPaperSuite)) EXPECT_TRUE(dataset.has_solvation) << dataset.name;
}

TEST(Datasets, ReadEveryField) {
  const std::vector<Dataset> datasets = parse_datasets(kOne);
  ASSERT_EQ(datasets.size(), 1U);
  const Dataset& d = datasets.front();
  EXPECT_EQ(d.name, "n");
  EXPECT_EQ(d.title, "T");
  EXPECT_FALSE(d.paper_row);
  EXPECT_EQ(d.role, Role::stand_in);
  EXPECT_EQ(d.package, "p");
  EXPECT_EQ(d.path, "/f.pqr");
  EXPECT_EQ(d.surface.decay, 0.5);
  EXPECT_EQ(d.surface.isovalue, 2);
  EXPECT_EQ(d.surface.spacing, 0.7);
  EXPECT_TRUE(d.is_in(kQuickSuite));
  EXPECT_FALSE(d.is_in(kDefaultSuite));
  EXPECT_TRUE(d.has_solvation);
}

TEST(Datasets, SayWhichEntryIsWrong) {
  EXPECT_THAT([] { parse_datasets(one_with("stand-in", "friend")); },
              ThrowsMessage<InvalidInput>(::testing::AllOf(HasSubstr("molecule 0"), HasSubstr("'friend'"))));
  EXPECT_THAT([] { parse_datasets(one_with("\"title\"", "\"titel\"")); }, ThrowsMessage<InvalidInput>(HasSubstr("title")));
  EXPECT_THAT([] { parse_datasets("{"); }, Throws<InvalidInput>());
}

TEST(Datasets, AreFoundByNameInTheOrderAskedFor) {
  const std::vector<std::string> names = {"fas2", "ache-monomer"};
  EXPECT_THAT(names_of(find_datasets(all_datasets(), names)), ElementsAre("fas2", "ache-monomer"));
}

TEST(Datasets, AnUnknownNameIsAWrongOptionThatListsTheNames) {
  const std::vector<std::string> names = {"fas3"};
  EXPECT_THAT([&] { find_datasets(all_datasets(), names); },
              ThrowsMessage<InvalidOption>(::testing::AllOf(HasSubstr("'fas3'"), HasSubstr("fas2"), HasSubstr("1a63"))));
}

TEST(Datasets, AStandInIsCalledOne) {
  EXPECT_EQ(labelled_title("70S ribosome", "stand-in"), "70S ribosome (stand-in)");
  EXPECT_EQ(labelled_title("30S ribosome", "near-copy"), "30S ribosome (near copy)");
  EXPECT_EQ(labelled_title("connexin", "real"), "connexin");
  EXPECT_EQ(labelled_title("Fasciculin-2", "extra"), "Fasciculin-2");
}

}  // namespace
}  // namespace smopt::experiments
