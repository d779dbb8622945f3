#include "smopt/improve/marked_cells.h"

#include <gtest/gtest.h>

#include <random>

namespace smopt {
namespace {

bool overlap(const Extent& a, const Extent& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

Extent random_box(std::mt19937& random, double space, double size) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Vec3 low = space * Vec3(uniform(random), uniform(random), uniform(random));
  return {low, low + size * Vec3(1 + uniform(random), 1 + uniform(random), 1 + uniform(random))};
}

TEST(MarkedCells, CoverWhatWasMarkedAndReachWhatOverlapsIt) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    for (const double offset : {0.0, 1e6, -3e9}) {
      std::mt19937 random(7);
      MarkedCells cells(scale);
      std::vector<Extent> marked;
      for (int i = 0; i < 20; ++i) {
        Extent box = random_box(random, 30 * scale, scale);
        marked.push_back({box.low.array() + offset, box.high.array() + offset});
        cells.mark(marked.back());
      }
      int overlapping = 0;
      for (const Extent& box : marked) EXPECT_TRUE(cells.covers(box) && cells.reaches(box));
      for (int i = 0; i < 10000; ++i) {
        Extent box = random_box(random, 30 * scale, 3 * scale);
        box = {box.low.array() + offset, box.high.array() + offset};
        const bool is_overlapping = std::ranges::any_of(marked, [&](const Extent& m) { return overlap(m, box); });
        overlapping += is_overlapping ? 1 : 0;
        EXPECT_TRUE(!is_overlapping || cells.reaches(box)) << "scale " << scale << ", offset " << offset << ", box " << i;
      }
      EXPECT_GT(overlapping, 20);
    }
  }
}

TEST(MarkedCells, TellMostOfTheRestApart) {
  std::mt19937 random(8);
  MarkedCells cells(1);
  for (int i = 0; i < 1000; ++i) cells.mark(random_box(random, 10, 1));
  int reached = 0;
  for (int i = 0; i < 1000; ++i) {
    Extent box = random_box(random, 1000, 1);
    box.low[0] += 2000;
    box.high[0] += 2000;
    reached += cells.reaches(box) ? 1 : 0;
    EXPECT_FALSE(cells.covers({box.low, box.high + Vec3::Constant(3)}));
  }
  EXPECT_LT(reached, 50);
}

TEST(MarkedCells, AnEnormousBoxIsReachedAndNotCoveredUntilOneIsMarked) {
  MarkedCells cells(1);
  const Extent enormous{Vec3::Constant(-1e30), Vec3::Constant(1e30)}, needle{{0, 0, 0}, {1e9, 0, 0}};
  for (const Extent& box : {enormous, needle}) {
    EXPECT_TRUE(cells.reaches(box));
    EXPECT_FALSE(cells.covers(box));
  }
  cells.mark(needle);
  EXPECT_TRUE(cells.covers(enormous));
}

}  // namespace
}  // namespace smopt
