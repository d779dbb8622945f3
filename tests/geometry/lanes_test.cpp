#include "smopt/geometry/lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace smopt {
namespace {

Masks mask_of(unsigned bits) {
  Masks mask{};
  for (std::size_t lane = 0; lane < kLanes; ++lane) mask[lane] = (bits >> lane & 1) != 0 ? -1 : 0;
  return mask;
}

TEST(Lanes, ABitPerLaneSaysWhichAreSet) {
  for (unsigned bits = 0; bits < 16; ++bits) {
    EXPECT_EQ(lanes_set(mask_of(bits)), bits);
    EXPECT_EQ(is_set_in_all(mask_of(bits)), bits == 15);
  }
}

TEST(Lanes, ComparisonsSetTheLanesWhereTheyHold) {
  const Floats a{1, 2, -3, 0}, b{2, 2, -4, -0.0F};
  EXPECT_EQ(lanes_set(a < b), 0b0001U);
  EXPECT_EQ(lanes_set(a <= b), 0b1011U);
  EXPECT_EQ(lanes_set(a == b), 0b1010U);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(lanes_set(Floats{kNan, 1, kNan, 1} <= Floats{1, kNan, kNan, 1}), 0b1000U) << "nothing holds for what is no number";
}

TEST(Lanes, SmallerAndLargerAreChosenLaneByLane) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Floats a{1, -2, kInfinity, 5}, b{2, -3, 7, 5};
  const Floats smaller = smaller_of(a, b), larger = larger_of(a, b);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    EXPECT_EQ(smaller[lane], std::min(a[lane], b[lane]));
    EXPECT_EQ(larger[lane], std::max(a[lane], b[lane]));
  }
}

TEST(Lanes, ABitPerLaneSaysWhichOfEightAreSet) {
  using Halves = std::int16_t __attribute__((vector_size(16)));
  for (unsigned bits = 0; bits < 256; ++bits) {
    Halves mask{};
    for (unsigned lane = 0; lane < 8; ++lane) mask[lane] = (bits >> lane & 1) != 0 ? -1 : 0;
    EXPECT_EQ(lanes_set(mask), bits);
  }
}

TEST(Lanes, AbsoluteValuesKeepZeroAndInfinity) {
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(is_set_in_all(absolute(Floats{1, -2, 0, -infinity}) == Floats{1, 2, 0, infinity}));
}

TEST(Lanes, OneNumberFillsAllLanes) {
  EXPECT_TRUE(is_set_in_all(in_all_lanes(1.25F) == Floats{1.25F, 1.25F, 1.25F, 1.25F}));
}

}  // namespace
}  // namespace smopt
