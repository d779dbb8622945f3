#include "baselines/divergence_watch.h"

#include <gmock/gmock.h>

#include <limits>

namespace smopt::baselines {
namespace {

/// A box around (10, 0, 0) whose diagonal is 5: vertices are lost beyond 50.
const std::vector<Vec3> kStart = {{8.5, -2, 0}, {11.5, 2, 0}};

TEST(DivergenceWatch, KnowsTheFirstStepBeyondTenDiagonalsOfTheBox) {
  DivergenceWatch watch(kStart);
  watch.look(std::vector<Vec3>{{10, 49.9, 0}, {10, 0, 0}}, 1);
  EXPECT_EQ(watch.first_bad_step(), std::nullopt);
  watch.look(std::vector<Vec3>{{10, 0, 0}, {10, -50.1, 0}}, 2);
  EXPECT_EQ(watch.first_bad_step(), 2);
  watch.look(std::vector<Vec3>{{100, 0, 0}, {100, 0, 0}}, 3);
  EXPECT_EQ(watch.first_bad_step(), 2);
}

TEST(DivergenceWatch, TakesWhatIsNoNumberForLost) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    DivergenceWatch watch(kStart);
    watch.look(std::vector<Vec3>{{10, 0, 0}, {10, bad, 0}}, 4);
    EXPECT_EQ(watch.first_bad_step(), 4);
  }
}

TEST(DivergenceWatch, SeesNothingWhereThereIsNothing) {
  DivergenceWatch watch(std::vector<Vec3>{});
  watch.look(std::vector<Vec3>{}, 1);
  EXPECT_EQ(watch.first_bad_step(), std::nullopt);
}

}  // namespace
}  // namespace smopt::baselines
