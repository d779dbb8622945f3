#include "smopt/geometry/sweep_separation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/geometry/exact_hulls.h"
#include "tests/geometry/random_points.h"

namespace smopt {
namespace {

using namespace testing;

using Corners = std::array<Vec3, 3>;

SweepSeparation::Corners in_single_precision(const Corners& t) {
  return {t[0].cast<float>(), t[1].cast<float>(), t[2].cast<float>()};
}

/// A star around the origin whose centre moves.
struct Star {
  std::vector<Vec3> ring;
  Vec3 displacement;

  [[nodiscard]] std::array<Vec3, 4> swept(std::size_t k) const {
    return {ring[k], ring[(k + 1) % ring.size()], Vec3::Zero(), displacement};
  }
};

class RandomScenes {
 public:
  explicit RandomScenes(std::uint32_t seed) : random_(seed) {}

  Vec3 vector() { return {uniform_(random_), uniform_(random_), uniform_(random_)}; }
  double number() { return uniform_(random_); }
  std::size_t index(std::size_t count) { return random_() % count; }

  Star star(double size, double roughness) {
    Star star;
    const std::size_t n = 3 + index(9);
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
      star.ring.push_back(size * (Vec3(std::cos(angle), std::sin(angle), 0) + roughness * vector()));
    }
    star.displacement = 0.5 * size * vector();
    return star;
  }

  /// A triangle of any size up to `size` that has one corner just inside, on, or just outside what a triangle of the star sweeps over.
  Corners touching(const Star& star, double size) {
    const auto hull = star.swept(index(star.ring.size()));
    Vec3 weights = 0.5 * (vector() + Vec3::Ones());
    weights /= std::max(1.0, weights.sum() + 1e-3);
    if (index(3) == 0) weights[static_cast<int>(index(3))] = 0;
    const Vec3 p = hull[3] + weights[0] * (hull[0] - hull[3]) + weights[1] * (hull[1] - hull[3]) + weights[2] * (hull[2] - hull[3]);
    const Vec3 away = p - 0.25 * (hull[0] + hull[1] + hull[2] + hull[3]);
    const Vec3 corner = p + std::pow(10.0, -9 + 7 * std::abs(number())) * number() * away;
    const double reach = size * std::pow(10.0, -2 * std::abs(number()));
    return {corner, corner + reach * (away.normalized() + vector()), corner + reach * (away.normalized() + vector())};
  }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// Separates all triangles of the star from the candidate, with the star's mean normal or any other direction for `up`.
SweepSeparation separated(const Star& star, const Vec3& up, const Corners& candidate) {
  SweepSeparation separation;
  separation.set_star(star.ring);
  separation.set_target(star.displacement, up);
  separation.open_all();
  separation.separate(in_single_precision(candidate));
  return separation;
}

struct Count {
  int closed = 0;
  int kept_open = 0;
};

/// Every triangle of the star that is closed has to be clear of the candidate exactly.
void expect_closed_are_clear(const Star& star, const Vec3& up, const Corners& candidate, Count& count) {
  const SweepSeparation separation = separated(star, up, candidate);
  for (std::size_t k = 0; k < star.ring.size(); ++k) {
    const bool is_open = separation.is_open(k);
    ++(is_open ? count.kept_open : count.closed);
    if (is_open) continue;
    ASSERT_FALSE(hulls_meet_beyond(candidate, star.swept(k), {})) << "triangle " << k << " of " << star.ring.size();
  }
}

TEST(SweepSeparation, WhatIsClosedIsExactlyClear) {
  RandomScenes scenes(11);
  for (const double size : {1e-3, 1.0, 1e3}) {
    for (const double candidate_size : {0.3, 3.0, 1e4}) {
      Count count;
      for (int i = 0; i < 300 / kThinning; ++i) {
        const Star star = scenes.star(size, 0.05 + 0.1 * (i % 8));
        const Vec3 up = i % 3 == 0 ? scenes.vector() : Vec3(0, 0, 1e-6);
        expect_closed_are_clear(star, up, scenes.touching(star, candidate_size * size), count);
        ASSERT_FALSE(HasFatalFailure()) << "star of size " << size << ", candidate of size " << candidate_size << ", case " << i;
      }
      EXPECT_GT(count.closed, 100 / kThinning) << "the test proves nothing";
      EXPECT_GT(count.kept_open, 100 / kThinning);
    }
  }
}

TEST(SweepSeparation, FlatStarsThatSlideInTheirPlaneAreJudgedSoundly) {
  RandomScenes scenes(12);
  Count count;
  for (int i = 0; i < 500 / kThinning; ++i) {
    Star star = scenes.star(1, 0.3);
    for (Vec3& p : star.ring) p.z() = 0;
    star.displacement.z() = 0;
    Corners candidate = scenes.touching(star, 2);
    if (i % 2 == 0)
      for (Vec3& p : candidate) p.z() = 1e-8 * (p.z() > 0 ? 1 : -1);
    expect_closed_are_clear(star, Vec3::UnitZ(), candidate, count);
    ASSERT_FALSE(HasFatalFailure()) << "case " << i;
  }
  EXPECT_GT(count.closed, 100 / kThinning);
}

TEST(SweepSeparation, CoordinatesThatOverflowInSinglePrecisionAreNeverClosedWrongly) {
  RandomScenes scenes(13);
  Count count;
  for (const double candidate_size : {1e10, 1e20, 1e30}) {
    for (int i = 0; i < 100; ++i) {
      const Star star = scenes.star(1, 0.3);
      expect_closed_are_clear(star, Vec3::UnitZ(), scenes.touching(star, candidate_size), count);
      ASSERT_FALSE(HasFatalFailure()) << "candidate of size " << candidate_size << ", case " << i;
    }
  }
}

TEST(SweepSeparation, ATriangleOfTheNeighbourhoodThatSharesACornerStaysOpen) {
  RandomScenes scenes(14);
  for (int i = 0; i < 300; ++i) {
    const Star star = scenes.star(1, 0.3);
    const std::size_t k = scenes.index(star.ring.size());
    const Corners candidate{star.ring[k], star.ring[k] + scenes.vector(), star.ring[k] + scenes.vector()};
    const SweepSeparation separation = separated(star, Vec3::UnitZ(), candidate);
    EXPECT_TRUE(separation.is_open(k));
    EXPECT_TRUE(separation.is_open((k + star.ring.size() - 1) % star.ring.size()));
  }
}

TEST(SweepSeparation, SheetsFacingTheStarAreClearedAtOnce) {
  RandomScenes scenes(15);
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.9, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  int cleared = 0;
  constexpr int kSheets = 1000;
  for (int i = 0; i < kSheets; ++i) {
    Star star = scenes.star(1, 0.1);
    star.displacement *= 0.2;
    Corners candidate{Vec3(-1, -1, 0.45), Vec3(1.5, -1, 0.45), Vec3(0, 2, 0.45)};
    for (Vec3& p : candidate) p = tilt * (p + 0.1 * scenes.vector());
    for (Vec3& p : star.ring) p = tilt * p;
    star.displacement = tilt * star.displacement;
    SweepSeparation separation;
    separation.set_star(star.ring);
    separation.set_target(star.displacement, tilt.col(2));
    separation.open_all();
    cleared += static_cast<int>(separation.separate(in_single_precision(candidate)));
  }
  EXPECT_GE(cleared, kSheets * 99 / 100);
}

TEST(SweepSeparation, MostOfWhatIsClearByATenthIsCleared) {
  RandomScenes scenes(16);
  int clear = 0, cleared = 0;
  for (int i = 0; i < 1000 / kThinning; ++i) {
    const Star star = scenes.star(1, 0.3);
    const Vec3 middle = 1.2 * scenes.vector();
    const Corners candidate{middle + 0.5 * scenes.vector(), middle + 0.5 * scenes.vector(), middle + 0.5 * scenes.vector()};
    // Clear with room to spare: also when blown up around its own middle, and moved a tenth nearer.
    Corners nearer = candidate;
    for (Vec3& p : nearer) p += 0.2 * (p - middle) - 0.1 * middle.normalized();
    const SweepSeparation separation = separated(star, Vec3::UnitZ(), candidate);
    for (std::size_t k = 0; k < star.ring.size(); ++k) {
      if (hulls_meet_beyond(candidate, star.swept(k), {}) || hulls_meet_beyond(nearer, star.swept(k), {})) continue;
      ++clear;
      cleared += static_cast<int>(!separation.is_open(k));
    }
  }
  EXPECT_GT(clear, 1000 / kThinning);
  EXPECT_GE(cleared, clear * 95 / 100);
}

TEST(SweepSeparation, OnlyOpenTrianglesAreInQuestion) {
  Star star;
  for (int i = 0; i < 6; ++i) star.ring.emplace_back(std::cos(i * std::numbers::pi / 3), std::sin(i * std::numbers::pi / 3), 0);
  star.displacement = {0, 0, 0.1};
  const Corners piercing{Vec3(0.5, 0.25, -1), Vec3(0.5, 0.25, 1), Vec3(0.55, 0.3, 1)};  // triangle 0 only
  SweepSeparation separation;
  separation.set_star(star.ring);
  separation.set_target(star.displacement, Vec3::UnitZ());
  separation.open_all();
  for (std::size_t k = 0; k < 6; ++k) EXPECT_TRUE(separation.is_open(k));
  EXPECT_FALSE(separation.separate(in_single_precision(piercing)));
  EXPECT_TRUE(separation.is_open(0));
  separation.open_all();
  separation.close(0);
  EXPECT_FALSE(separation.is_open(0));
  EXPECT_TRUE(separation.separate(in_single_precision(piercing)));
  separation.open_all();
  EXPECT_TRUE(separation.is_open(0)) << "closing is for one candidate";
}

TEST(SweepSeparation, ASecondStarDoesNotRememberTheFirst) {
  RandomScenes scenes(17);
  SweepSeparation reused;
  for (int i = 0; i < 300; ++i) {
    const Star star = scenes.star(1, 0.3);
    const Corners candidate = scenes.touching(star, 1);
    reused.set_star(star.ring);
    reused.set_target(0.1 * star.displacement, Vec3::UnitX());
    reused.set_target(star.displacement, Vec3::UnitZ());
    reused.open_all();
    reused.separate(in_single_precision(candidate));
    const SweepSeparation fresh = separated(star, Vec3::UnitZ(), candidate);
    for (std::size_t k = 0; k < star.ring.size(); ++k) ASSERT_EQ(reused.is_open(k), fresh.is_open(k)) << "case " << i;
  }
}

}  // namespace
}  // namespace smopt
