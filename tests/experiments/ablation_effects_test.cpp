#include "experiments/ablation/effects.h"

#include <gmock/gmock.h>

#include <cmath>

namespace smopt::experiments {
namespace {

using ::testing::Eq;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kRounding = 1e-12;

/// The response of factors with 3, 2 and 2 levels whose number is `value(a, b, c)`.
template <class Value>
FactorialResponse response_of(const Value& value) {
  FactorialResponse response{{3, 2, 2}, {}};
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 2; ++b)
      for (int c = 0; c < 2; ++c) response.values.push_back(value(a, b, c));
  return response;
}

/// −1 and +1 at a factor's two levels.
double sign(int level) {
  return 2.0 * level - 1;
}

/// 10 + 2(a − 1) + 3 sign(b) + 0.5 (a − 1) sign(c): its mean squares over the twelve cases are 8/3, 9 and 1/6.
double known(int a, int b, int c) {
  return 10 + 2.0 * (a - 1) + 3 * sign(b) + 0.5 * (a - 1) * sign(c);
}
constexpr double kKnownTotal = 8.0 / 3 + 9 + 1.0 / 6;

TEST(AblationEffects, AreThoseThatTheNumberWasMadeOf) {
  const auto effects = effects_of(response_of([](int a, int b, int c) { return std::optional(known(a, b, c)); }));
  ASSERT_TRUE(effects);
  EXPECT_NEAR(effects->mean, 10, kRounding);
  EXPECT_TRUE(effects->varies);
  EXPECT_THAT(effects->left_out, IsEmpty());
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(*effects->level_means[0][static_cast<std::size_t>(a)], 10 + 2.0 * (a - 1), kRounding);
  for (int b = 0; b < 2; ++b) EXPECT_NEAR(*effects->level_means[1][static_cast<std::size_t>(b)], 10 + 3 * sign(b), kRounding);
  for (int c = 0; c < 2; ++c) EXPECT_NEAR(*effects->level_means[2][static_cast<std::size_t>(c)], 10, kRounding);
  EXPECT_NEAR(*effects->shares[0][0], 8.0 / 3 / kKnownTotal, kRounding);
  EXPECT_NEAR(*effects->shares[1][1], 9 / kKnownTotal, kRounding);
  EXPECT_NEAR(*effects->shares[2][2], 0, kRounding);
  EXPECT_NEAR(*effects->shares[0][2], 1.0 / 6 / kKnownTotal, kRounding);
  EXPECT_NEAR(*effects->shares[0][1], 0, kRounding);
  EXPECT_NEAR(*effects->shares[1][2], 0, kRounding);
  EXPECT_NEAR(*effects->rest_share, 0, kRounding);
}

TEST(AblationEffects, AnInteractionOfThreeFactorsIsTheRest) {
  const auto effects = effects_of(response_of([](int a, int b, int c) { return std::optional((a - 1) * sign(b) * sign(c)); }));
  ASSERT_TRUE(effects);
  for (const auto& row : effects->shares)
    for (const auto& share : row) EXPECT_NEAR(*share, 0, kRounding);
  EXPECT_NEAR(*effects->rest_share, 1, kRounding);
}

TEST(AblationEffects, SharesAndRestAddUpToAllOfAnyNumber) {
  const auto effects = effects_of(response_of([](int a, int b, int c) { return std::optional(std::sin(7 * a + 3 * b * b + 11 * c * a)); }));
  ASSERT_TRUE(effects);
  double sum = *effects->rest_share;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j) {
      sum += *effects->shares[i][j];
      EXPECT_THAT(effects->shares[j][i], Eq(effects->shares[i][j]));
    }
  EXPECT_NEAR(sum, 1, kRounding);
  EXPECT_GT(*effects->rest_share, 1e-6) << "or there was nothing to add up";
}

TEST(AblationEffects, CasesThatAreAlikeHaveNoShares) {
  const auto effects = effects_of(response_of([](int, int, int) { return std::optional(0.1); }));
  ASSERT_TRUE(effects);
  EXPECT_FALSE(effects->varies);
  EXPECT_FALSE(effects->shares[0][0]);
  EXPECT_FALSE(effects->rest_share);
  EXPECT_NEAR(*effects->level_means[2][1], 0.1, kRounding);
}

TEST(AblationEffects, ALevelWithoutNumbersIsLeftOutAndTheOthersAreAsWithoutIt) {
  const auto effects = effects_of(response_of([](int a, int b, int c) { return a == 1 ? std::nullopt : std::optional(known(a, b, c)); }));
  ASSERT_TRUE(effects);
  ASSERT_THAT(effects->left_out, SizeIs(1));
  EXPECT_EQ(effects->left_out[0].factor, 0U);
  EXPECT_EQ(effects->left_out[0].level, 1U);
  EXPECT_FALSE(effects->level_means[0][1]);
  EXPECT_NEAR(*effects->level_means[0][0], 8, kRounding);
  EXPECT_NEAR(*effects->level_means[0][2], 12, kRounding);
  const double total = 4 + 9 + 0.25;
  EXPECT_NEAR(*effects->shares[0][0], 4 / total, kRounding);
  EXPECT_NEAR(*effects->shares[0][2], 0.25 / total, kRounding);
}

TEST(AblationEffects, AFactorWithOneLevelLeftHasNoEffect) {
  const auto effects = effects_of(response_of([](int a, int b, int c) { return b == 1 ? std::nullopt : std::optional(known(a, b, c)); }));
  ASSERT_TRUE(effects);
  EXPECT_FALSE(effects->shares[1][1]);
  EXPECT_FALSE(effects->shares[0][1]);
  EXPECT_TRUE(effects->shares[0][0]);
}

TEST(AblationEffects, OneCaseWithoutANumberTakesItsRarestLevelOut) {
  // A twelfth of all cases, a quarter of those with a = 2, a sixth of those with b = 1 and with c = 1.
  const auto effects = effects_of(
      response_of([](int a, int b, int c) { return a == 2 && b == 1 && c == 1 ? std::nullopt : std::optional(known(a, b, c)); }));
  ASSERT_TRUE(effects);
  ASSERT_THAT(effects->left_out, SizeIs(1));
  EXPECT_EQ(effects->left_out[0].factor, 0U);
  EXPECT_EQ(effects->left_out[0].level, 2U);
}

TEST(AblationEffects, AreNothingWithoutNumbers) {
  EXPECT_FALSE(effects_of(response_of([](int, int, int) { return std::optional<double>(); })));
  EXPECT_FALSE(effects_of({{2}, {}}));
}

}  // namespace
}  // namespace smopt::experiments
