#include "smopt/geometry/swept_triangle.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tests/geometry/exact_hulls.h"
#include "tests/geometry/random_points.h"

namespace smopt {
namespace {

using namespace testing;

constexpr std::uint32_t kSeed = 97;
/// Cases of each kind of lattice and each number of shared corners.
constexpr int kCases = 250 / kThinning;

/// A triangle and a sweep, and the corners that they share.
struct Encounter {
  TrianglePoints triangle;
  SharedCorners shared;
  SweptTriangle sweep;

  [[nodiscard]] std::vector<Vec3> shared_points() const {
    std::vector<Vec3> points;
    if (shared.a >= 0) points.push_back(sweep.a);
    if (shared.b >= 0) points.push_back(sweep.b);
    return points;
  }
  [[nodiscard]] bool meets(std::span<const Vec3> hull) const { return hulls_meet_beyond(triangle, hull, shared_points()); }
  /// Whether the sweep's triangle has an area at every moment of the move: only a move in its own plane can take it away.
  [[nodiscard]] bool keeps_its_area() const {
    if (rational_orient3d(sweep.a, sweep.b, sweep.from, sweep.to) != 0) return true;
    for (int u = 0; u < 3; ++u) {
      const auto side = [&](const Vec3& p) {
        const int v = (u + 1) % 3;
        return rational_orient2d(sweep.a[u], sweep.a[v], sweep.b[u], sweep.b[v], p[u], p[v]);
      };
      if (side(sweep.from) * side(sweep.to) > 0) return true;
    }
    return false;
  }
  [[nodiscard]] bool meets_start() const { return meets(std::array{sweep.a, sweep.b, sweep.from}); }
  [[nodiscard]] bool meets_hull() const { return meets(std::array{sweep.a, sweep.b, sweep.from, sweep.to}); }
  [[nodiscard]] bool meets_other_faces() const {
    return meets(std::array{sweep.a, sweep.b, sweep.to}) || meets(std::array{sweep.a, sweep.from, sweep.to}) ||
           meets(std::array{sweep.b, sweep.from, sweep.to});
  }
};

std::string describe(const Encounter& e) {
  std::string text;
  for (const Vec3& p : {e.triangle[0], e.triangle[1], e.triangle[2], e.sweep.a, e.sweep.b, e.sweep.from, e.sweep.to})
    text += fmt::format(" ({}, {}, {})", p.x(), p.y(), p.z());
  return fmt::format("triangle, a, b, from, to:{}, shared {} {}", text, e.shared.a, e.shared.b);
}

/// A random encounter with `shared` common corners, each in any of the triangle's places.
Encounter random_encounter(LatticePoints& point, int shared) {
  Encounter e;
  for (Vec3& p : e.triangle) p = point();
  e.sweep = {point(), point(), point(), point()};
  const int first = static_cast<int>(point.random()() % 3), second = (first + 1 + static_cast<int>(point.random()() % 2)) % 3;
  const bool is_b_first = point.random()() % 2 == 0;
  if (shared == 2 || (shared == 1 && !is_b_first)) e.shared.a = first;
  if (shared == 2 || (shared == 1 && is_b_first)) e.shared.b = second;
  if (e.shared.a >= 0) e.triangle[e.shared.a] = e.sweep.a;
  if (e.shared.b >= 0) e.triangle[e.shared.b] = e.sweep.b;
  return e;
}

/// Moves the sweep's target into the plane of its triangle, as far as the lattice allows (exactly where it is not turned or shaken).
void flatten(SweptTriangle& sweep) {
  sweep.to = sweep.a + sweep.b - sweep.from;
}

template <class Check>
void for_random_encounters(bool is_flat, const Check& check) {
  for (const LatticePoints::Kind& kind : lattice_kinds()) {
    LatticePoints point(kind, kSeed);
    for (int shared = 0; shared <= 2; ++shared) {
      for (int i = 0; i < kCases; ++i) {
        Encounter e = random_encounter(point, shared);
        if (is_flat) flatten(e.sweep);
        check(e);
        ASSERT_FALSE(::testing::Test::HasFailure()) << kind.name << ", " << shared << " shared, case " << i << ", " << describe(e);
      }
    }
  }
}

void expect_agreement_where_the_start_is_free(bool is_flat) {
  std::map<std::pair<std::size_t, bool>, int> seen;
  for_random_encounters(is_flat, [&](const Encounter& e) {
    if (e.meets_start()) return;
    const bool expected = e.meets_hull();
    ++seen[{e.shared_points().size(), expected}];
    // Where the sweep's triangle is degenerate at some moment, only the safe answer is promised.
    if (!expected && !e.keeps_its_area()) return;
    EXPECT_EQ(meets_sweep(e.triangle, e.shared, e.sweep), expected);
  });
  for (std::size_t shared = 0; shared <= 2; ++shared)
    for (const bool expected : {false, true})
      EXPECT_GT((seen[{shared, expected}]), 30 / kThinning)
          << shared << " shared: too few cases that " << (expected ? "meet" : "stay apart");
}

TEST(SweptTriangle, IsMetWhereTheTetrahedronIs) {
  expect_agreement_where_the_start_is_free(false);
}

TEST(SweptTriangle, IsMetWhereTheFlatTetrahedronIs) {
  expect_agreement_where_the_start_is_free(true);
}

TEST(SweptTriangle, ContactWithAnotherFaceCountsWhateverTouchesTheStart) {
  int met = 0;
  for_random_encounters(false, [&](const Encounter& e) {
    if (!e.meets_other_faces()) return;
    ++met;
    EXPECT_TRUE(meets_sweep(e.triangle, e.shared, e.sweep));
  });
  EXPECT_GT(met, 500 / kThinning);
}

const SweptTriangle kSweep{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 4, 4}};

TEST(SweptTriangle, ASmallTriangleThatIsSwallowedIsMet) {
  EXPECT_TRUE(meets_sweep({Vec3(0.5, 2, 1), Vec3(0.7, 2, 1), Vec3(0.5, 2.1, 1.1)}, {}, kSweep));
}

TEST(SweptTriangle, ASheetInBetweenIsMet) {
  // Neither the start nor the end of the move meets it.
  EXPECT_TRUE(meets_sweep({Vec3(-9, 3, 1), Vec3(9, 3, 1), Vec3(0, 9, 1.01)}, {}, kSweep));
}

TEST(SweptTriangle, TheNeighbourAcrossTheEdgeIsMetWhenTheMoveFoldsOntoIt) {
  const TrianglePoints neighbour{Vec3(4, 0, 0), Vec3(0, 0, 0), Vec3(1, -3, 0)};
  const SharedCorners shared{1, 0};
  EXPECT_FALSE(meets_sweep(neighbour, shared, {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 1, 0}}));
  EXPECT_TRUE(meets_sweep(neighbour, shared, {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, -1, 0}})) << "slides over it in its plane";
  EXPECT_FALSE(meets_sweep(neighbour, shared, {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, -1, 1}})) << "passes above it";
}

TEST(SweptTriangle, ANeighbourThatKeepsTheSharedCornerOnlyIsNotMet) {
  EXPECT_FALSE(meets_sweep({Vec3(0, 0, 0), Vec3(-1, -2, 0), Vec3(-2, -1, 0)}, {0, -1}, kSweep));
  EXPECT_TRUE(meets_sweep({Vec3(0, 0, 0), Vec3(-1, -2, 0), Vec3(-2, -1, 0)}, {}, kSweep)) << "not shared: contact";
}

}  // namespace
}  // namespace smopt
