#include "experiments/tetgen_run.h"

#include <gmock/gmock.h>

#include "tests/support/shapes.h"

namespace smopt::experiments {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> switches_of(const std::vector<TetgenTrial>& trials) {
  std::vector<std::string> switches;
  for (const TetgenTrial& trial : trials) switches.push_back(trial.switches);
  return switches;
}

TEST(TetgenRun, AsksForGoodTetrahedraOfWhatASimulationTakes) {
  for (const char* method : {"smopt", "smopt2"}) EXPECT_THAT(switches_of(tetgen_trials(method)), ElementsAre("p", "pY", "pq1.4")) << method;
  for (const char* method : {"initial", "laplacian"}) EXPECT_THAT(switches_of(tetgen_trials(method)), ElementsAre("p", "pY")) << method;
}

TEST(TetgenRun, GivesQualityFiveMinutes) {
  EXPECT_EQ(tetgen_trials("smopt2").back().time_limit_seconds, 300);
}

TEST(TetgenRun, TellsEveryOutcomeBySwitches) {
  const auto outcomes = tetgen_of(testing::icosphere(1), tetgen_trials("smopt2"), {});
  for (const char* switches : {"p", "pY", "pq1.4"}) {
    EXPECT_EQ(outcomes.at(switches).at("status"), "success") << switches;
    EXPECT_EQ(outcomes.at(switches).at("switches"), switches);
  }
}

TEST(TetgenRun, DoesNotRefineWhatCannotBeFilled) {
  // Two tetrahedra through each other.
  const auto crossing = testing::joined(testing::tetrahedron(), testing::translated(testing::tetrahedron(), {0.3, 0.2, 0.1}));
  const auto outcomes = tetgen_of(crossing, tetgen_trials("smopt2"), {});
  EXPECT_EQ(outcomes.at("p").at("status"), "failed");
  EXPECT_EQ(outcomes.at("pq1.4").at("status"), "failed");
  EXPECT_THAT(outcomes.at("pq1.4").at("reason").get<std::string>(), HasSubstr("not tried"));
}

}  // namespace
}  // namespace smopt::experiments
