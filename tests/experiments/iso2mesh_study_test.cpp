#include <gmock/gmock.h>

#include <cmath>

#include "experiments/iso2mesh_study/study_markdown.h"
#include "tests/support/shapes.h"

namespace smopt::experiments {
namespace {

using baselines::CollapsePlacement;
using baselines::SmoothsurfMethod;
using ::testing::HasSubstr;
using ::testing::Not;

Iso2meshOutcome outcome(SmoothsurfMethod method, int rounds, std::optional<double> area_change, std::optional<double> volume_change) {
  Iso2meshOutcome result;
  result.setting.smoothing = {method, rounds, 0.5};
  result.area_change = area_change;
  result.volume_change = volume_change;
  return result;
}

TEST(Iso2meshStudy, TriesEverySettingOnce) {
  // Two placements, each without smoothing and with three methods, two alphas, two numbers of rounds.
  const auto settings = settings_of({{0.1, 0.5}, {0, 3, 100}});
  EXPECT_EQ(settings.size(), 2U * (1 + 3 * 2 * 2));
  std::vector<std::string> names;
  for (const auto& setting : settings) names.push_back(describe(setting));
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
  EXPECT_THAT(names, ::testing::Contains("lindstrom-turk, laplacianhc, alpha 0.1, 100 rounds"));
  EXPECT_THAT(names, ::testing::Contains("midpoint, not smoothed"));
}

TEST(Iso2meshStudy, TheClosestIsTheOneWhoseWorseChangeIsSmallest) {
  const std::vector<Iso2meshOutcome> outcomes = {
      outcome(SmoothsurfMethod::laplacian, 100, -0.01, 0.3), outcome(SmoothsurfMethod::lowpass, 100, -0.1, 0.1),
      outcome(SmoothsurfMethod::laplacianhc, 100, 0.0, std::nullopt), outcome(SmoothsurfMethod::laplacian, 3, 0, 0)};
  ASSERT_NE(closest(outcomes, 100), nullptr);
  EXPECT_EQ(closest(outcomes, 100)->setting.smoothing.method, SmoothsurfMethod::lowpass);
  EXPECT_EQ(closest(outcomes, 7), nullptr);
  EXPECT_DOUBLE_EQ(deviation(outcomes[0]), 0.3);
  EXPECT_EQ(deviation(outcomes[2]), HUGE_VAL);
}

TEST(Iso2meshStudy, MeasuresAgainstTheMeshThatWasGiven) {
  const TriangleMesh sphere = testing::icosphere(3);
  const auto outcomes = run_iso2mesh_study(sphere, 400, {{0.5}, {0, 100}});
  ASSERT_EQ(outcomes.size(), 8U);
  for (const Iso2meshOutcome& found : outcomes) {
    EXPECT_EQ(found.vertices, 400U) << describe(found.setting);
    ASSERT_TRUE(found.volume_change && found.area_change);
  }
  EXPECT_LT(*outcomes[0].volume_change, 0) << "fewer vertices on a sphere enclose less";
  // 100 Laplacian rounds shrink the sphere; the two methods that were made not to, less.
  const auto change_by = [&](std::size_t i) { return *outcomes[i].volume_change; };
  EXPECT_EQ(outcomes[1].setting.smoothing.method, SmoothsurfMethod::laplacian);
  EXPECT_LT(change_by(1), 5 * change_by(0));
  EXPECT_GT(change_by(2), change_by(1));
  EXPECT_GT(change_by(3), change_by(1));
  EXPECT_EQ(outcomes[0].pairs, 0U);
}

TEST(Iso2meshStudy, DoesNotCountThePairsOfATangle) {
  // Lowpass with α = 3 multiplies what is rough by −3 · 4 a round and more.
  const auto outcomes = run_iso2mesh_study(testing::noisy(testing::icosphere(2), 0.05, 1), 162, {{3}, {30}});
  for (const Iso2meshOutcome& found : outcomes) {
    if (found.setting.smoothing.method != SmoothsurfMethod::lowpass) continue;
    EXPECT_TRUE(found.diverged_at_step);
    EXPECT_EQ(found.pairs, std::nullopt);
  }
}

TEST(Iso2meshStudy, ThePageNamesTheClosestSettingAndThePapers) {
  Iso2meshMoleculeStudy study{"Some molecule", 1000, 900, 57, {}};
  study.outcomes = {outcome(SmoothsurfMethod::laplacian, 100, -0.4, -0.07), outcome(SmoothsurfMethod::laplacianhc, 100, -0.05, 0.001)};
  study.outcomes[0].pairs = 60;
  study.outcomes[1].pairs = 0;
  const std::string page = study_markdown({study}, "the command");
  EXPECT_THAT(page, HasSubstr("## Some molecule"));
  EXPECT_THAT(page, HasSubstr("default alpha (midpoint, laplacian, alpha 0.5, 100 rounds): area -40.00 %, volume -7.00 %"));
  EXPECT_THAT(page,
              HasSubstr("Closest of its Laplacian method after 100 rounds: midpoint, laplacian, alpha 0.5, 100 rounds: area -40.00 %"));
  EXPECT_THAT(page, HasSubstr("**Closest to Figure 5 of all after 100 rounds: midpoint, laplacianhc, alpha 0.5, 100 rounds: area -5.00 %"));
  EXPECT_THAT(page, HasSubstr("paper's 57 intersecting pairs after 100 rounds:\n  - midpoint, laplacian, alpha 0.5, 100 rounds: area"));
  EXPECT_THAT(page, HasSubstr("Made by `the command`."));
}

}  // namespace
}  // namespace smopt::experiments
