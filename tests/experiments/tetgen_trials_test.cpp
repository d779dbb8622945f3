#include "experiments/tetgen_trials.h"

#include <gmock/gmock.h>

namespace smopt::experiments {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> switches_of(const std::vector<TetgenTrial>& trials) {
  std::vector<std::string> switches;
  for (const TetgenTrial& trial : trials) switches.push_back(trial.switches);
  return switches;
}

TEST(TetgenTrials, AsksForGoodTetrahedraOfWhatASimulationTakes) {
  for (const char* method : {"smopt", "smopt2"}) EXPECT_THAT(switches_of(tetgen_trials(method)), ElementsAre("p", "pY", "pq1.4")) << method;
  for (const char* method : {"initial", "laplacian"}) EXPECT_THAT(switches_of(tetgen_trials(method)), ElementsAre("p", "pY")) << method;
}

TEST(TetgenTrials, GivesQualityFiveMinutes) {
  EXPECT_EQ(tetgen_trials("smopt2").back().time_limit_seconds, 300);
}

}  // namespace
}  // namespace smopt::experiments
