#include "smopt/geometry/normal_cone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <string>

#include "tests/geometry/exact_hulls.h"
#include "tests/geometry/random_points.h"

namespace smopt {
namespace {

using namespace testing;

/// Coordinates are multiples of this, so that the moments of a move, in 32nds, are exact in double precision.
constexpr double kStep = 0x1p-20;
constexpr int kMoments = 32;

Vec3 rounded(const Vec3& p) {
  return kStep * (p / kStep).array().round().matrix();
}

Vec3 at_moment(const Vec3& from, const Vec3& to, int moment) {
  return from + (to - from) * (static_cast<double>(moment) / kMoments);
}

MovingStar resting_star(const std::vector<Vec3>& ring, const Vec3& center = Vec3::Zero()) {
  return {center, center, ring, ring};
}

/// A ring of n points that goes `turns` times around the z axis.
std::vector<Vec3> flat_ring(int n, int turns = 1) {
  std::vector<Vec3> ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * turns * i / n;
    ring.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  return ring;
}

class RandomStars {
 public:
  explicit RandomStars(std::uint32_t seed) : random_(seed) {}

  /// A star of valence 3 to 8 whose points are anywhere within `roughness` of a flat one; one point moves, the centre or one of the ring.
  MovingStar operator()(double roughness) {
    std::vector<Vec3> ring = flat_ring(3 + static_cast<int>(random_() % 6));
    for (Vec3& p : ring) p = rounded(p + roughness * vector());
    MovingStar star = resting_star(ring, rounded(roughness * vector()));
    Vec3& moved = random_() % 2 == 0 ? star.center_to : star.ring_to[random_() % ring.size()];
    moved = rounded(moved + 0.7 * vector());
    return star;
  }

 private:
  Vec3 vector() { return {uniform_(random_), uniform_(random_), uniform_(random_)}; }

  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// Whether two triangles of the star at rest meet beyond the corners they share.
bool meets_itself(const Vec3& center, const std::vector<Vec3>& ring) {
  const std::size_t n = ring.size();
  const auto triangle = [&](std::size_t i) { return std::array{center, ring[i], ring[(i + 1) % n]}; };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      std::vector<Vec3> shared{center};
      if (j == i + 1) shared.push_back(ring[j]);
      if ((j + 1) % n == i) shared.push_back(ring[i]);
      if (hulls_meet_beyond(triangle(i), triangle(j), shared)) return true;
    }
  }
  return false;
}

bool meets_itself(const MovingStar& star, int moment) {
  std::vector<Vec3> ring;
  for (std::size_t i = 0; i < star.ring_from.size(); ++i) ring.push_back(at_moment(star.ring_from[i], star.ring_to[i], moment));
  return meets_itself(at_moment(star.center_from, star.center_to, moment), ring);
}

TEST(NormalCone, AnAxisProvesThatTheStarNeverMeetsItselfOnTheWay) {
  RandomStars next_star(3);
  int with_axis = 0, without = 0;
  for (int i = 0; i < 250 / kThinning; ++i) {
    const MovingStar star = next_star(0.2 + 0.1 * (i % 6));
    if (!is_known(find_cone(star))) {
      ++without;
      continue;
    }
    ++with_axis;
    for (int moment = 0; moment <= kMoments; moment += 2) ASSERT_FALSE(meets_itself(star, moment)) << "star " << i << ", moment " << moment;
  }
  EXPECT_GT(with_axis, 50 / kThinning);
  EXPECT_GT(without, 50 / kThinning);
}

TEST(NormalCone, StarsThatMeetThemselvesHaveNoAxis) {
  RandomStars next_star(4);
  int meeting = 0;
  for (int i = 0; i < 800 / kThinning; ++i) {
    const MovingStar star = next_star(0.9);
    if (!meets_itself(star, kMoments) && !meets_itself(star, kMoments / 2)) continue;
    ++meeting;
    ASSERT_FALSE(is_known(find_cone(star))) << "star " << i;
  }
  EXPECT_GT(meeting, 100 / kThinning);
}

TEST(NormalCone, GentleStarsHaveAnAxisAlongTheirNormal) {
  RandomStars next_star(5);
  for (int i = 0; i < 500; ++i) {
    MovingStar star = next_star(0.1);
    star.center_to = star.center_from;
    star.ring_to = star.ring_from;
    const NormalCone cone = find_cone(star);
    ASSERT_TRUE(is_known(cone)) << "star " << i;
    EXPECT_GT(cone.axis[2], 0);
  }
}

TEST(NormalCone, AFlatStarHasAnAxisOfAtMostUnitLength) {
  for (const int n : {3, 4, 7, 100, 10000}) {
    const NormalCone cone = find_cone(resting_star(flat_ring(n)));
    ASSERT_TRUE(is_known(cone)) << n;
    EXPECT_LE(axis_of(cone).norm(), 1 + 1e-6) << "the rounding margin is for |axis| ≤ 1";
    EXPECT_GT(axis_of(cone).z(), 0.99);
  }
}

TEST(NormalCone, AStarThatTurnsTwiceAroundItsCentreIsRefused) {
  for (const int n : {5, 7, 9, 101, 10001})
    EXPECT_FALSE(is_known(find_cone(resting_star(flat_ring(n, 2))))) << n << " points, all normals along z";
  EXPECT_FALSE(is_known(find_cone(resting_star(flat_ring(10, 3)))));
}

TEST(NormalCone, AStarThatTurnsTwiceAsASpiralRampIsRefused) {
  std::vector<Vec3> ring = flat_ring(13, 2);
  for (std::size_t i = 0; i < ring.size(); ++i) ring[i].z() = 0.05 * static_cast<double>(i);
  EXPECT_FALSE(is_known(find_cone(resting_star(ring))));
}

TEST(NormalCone, ATriangleTurnedOverOrDegenerateAtTheEndIsRefused) {
  MovingStar star = resting_star(flat_ring(6));
  star.center_to = {2, 0, 0};
  EXPECT_FALSE(is_known(find_cone(star))) << "outside the ring";
  star.center_to = star.ring_to[0];
  EXPECT_FALSE(is_known(find_cone(star))) << "on the ring";
  star.center_to = 0.5 * (star.ring_to[0] + star.ring_to[1]);
  EXPECT_FALSE(is_known(find_cone(star))) << "between two points of the ring";
}

TEST(NormalCone, AShortCutThroughAFlippedStartIsRefused) {
  // Well shaped at the end, but the centre starts outside the ring: the star is folded on the way.
  MovingStar star = resting_star(flat_ring(6), {2, 0, 0});
  star.center_to = Vec3::Zero();
  EXPECT_FALSE(is_known(find_cone(star)));
}

TEST(NormalCone, TurnsWithTheStar) {
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(2.1, Vec3(3, -1, 2).normalized()).toRotationMatrix();
  std::vector<Vec3> ring = flat_ring(6);
  for (Vec3& p : ring) p = rotation * p + Vec3(1e4, -1e4, 3e4);
  const NormalCone cone = find_cone(resting_star(ring, Vec3(1e4, -1e4, 3e4)));
  ASSERT_TRUE(is_known(cone));
  EXPECT_GT(axis_of(cone).normalized().dot(rotation.col(2)), 0.999);
}

TEST(NormalCone, AStarOfNoSizeHasNoAxis) {
  EXPECT_FALSE(is_known(find_cone(resting_star(std::vector<Vec3>(5, Vec3::Zero())))));
}

}  // namespace
}  // namespace smopt
