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

// ---- Bounds of the cone ----

/// Sign of the component of the triangle's area vector along the axis, exact for coordinates that are multiples of kStep.
int sign_along(const std::array<float, 3>& axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  return rational_orient3d(Vec3::Zero(), b - a, c - a, {axis[0], axis[1], axis[2]});
}

std::array<float, 3> array_of(const Eigen::Vector3f& v) {
  return {v[0], v[1], v[2]};
}

/// The unit normal in extended precision, from coordinates whose differences are exact.
Eigen::Matrix<long double, 3, 1> normal_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  using Long = Eigen::Matrix<long double, 3, 1>;
  return Long((b - a).cast<long double>()).cross(Long((c - a).cast<long double>())).normalized();
}

long double squared_sine_between(const Eigen::Matrix<long double, 3, 1>& normal, const std::array<float, 3>& axis) {
  const Eigen::Matrix<long double, 3, 1> u(axis[0], axis[1], axis[2]);
  return normal.cross(u).squaredNorm() / u.squaredNorm();
}

double longest2_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
}

Eigen::Vector3f direction_of(const Vec3& a, const Vec3& b, const Vec3& c, double longest2) {
  return reliable_direction((b - a).cross(c - a), longest2);
}

/// A triangle with coordinates that are multiples of kStep, down to one step high.
class RandomTriangles {
 public:
  explicit RandomTriangles(std::uint32_t seed) : random_(seed) {}

  double number() { return uniform_(random_); }
  Vec3 vector() { return {number(), number(), number()}; }
  std::array<Vec3, 3> operator()() {
    const Vec3 a = vector(), b = vector();
    const double height = std::pow(10.0, -3.5 - 3.5 * number());
    return {rounded(a), rounded(b), rounded(a + 0.5 * (number() + 1) * (b - a) + height * vector())};
  }
  Eigen::Vector3f axis() {
    Vec3 v = vector();
    while (v.norm() < 0.1) v = vector();
    return v.cast<float>().normalized();
  }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

TEST(ReliableDirection, IsAUnitVectorAlongTheNormalOrNone) {
  RandomTriangles next_triangle(41);
  int reliable = 0, unreliable = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto [a, b, c] = next_triangle();
    const Eigen::Vector3f direction = direction_of(a, b, c, longest2_of(a, b, c));
    if (direction == Eigen::Vector3f::Zero()) {
      ++unreliable;
      EXPECT_LE((b - a).cross(c - a).norm(), 1.01 * kDirectionMarginRel * longest2_of(a, b, c)) << "case " << i;
      continue;
    }
    ++reliable;
    EXPECT_NEAR(direction.norm(), 1, 3e-7F);
    const Eigen::Matrix<long double, 3, 1> normal = normal_of(a, b, c);
    EXPECT_GT(normal.dot(direction.cast<long double>()), 0);
    // 1e-6 rad from the rounding of the area vector, and single precision.
    EXPECT_LT(std::sqrt(static_cast<double>(squared_sine_between(normal, array_of(direction)))), 1.2e-6) << "case " << i;
  }
  EXPECT_GT(reliable, 1000);
  EXPECT_EQ(reliable + unreliable, 5000);
}

TEST(ReliableDirection, ADegenerateTriangleHasNone) {
  const std::vector<std::array<Vec3, 3>> degenerate = {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)},
                                                       {Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(4, 4, 4)},
                                                       {Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)},
                                                       {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1e-10, 0)},
                                                       {Vec3(0.1, 0.2, 0.3), Vec3(0.2, 0.4, 0.6), Vec3(0.3, 0.6, 0.9)}};
  for (const auto& [a, b, c] : degenerate) EXPECT_EQ(direction_of(a, b, c, longest2_of(a, b, c)), Eigen::Vector3f(0, 0, 0));
}

TEST(ReliableDirection, DoesNotDependOnTheScale) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Vec3 a(0, 0, 0), b(scale, 0, 0), c(0.5 * scale, 1e-3 * scale, 0);
    EXPECT_EQ(direction_of(a, b, c, longest2_of(a, b, c)), Eigen::Vector3f(0, 0, 1)) << scale;
  }
}

TEST(NormalConeBound, HoldsForEveryNormalThatItWasWidenedBy) {
  RandomTriangles next_triangle(42);
  int bounded = 0, unbounded = 0;
  for (int i = 0; i < 1500; ++i) {
    NormalCone cone{array_of(next_triangle.axis()), 0};
    std::vector<std::array<Vec3, 3>> triangles;
    for (int j = 0; j < 3; ++j) {
      auto [a, b, c] = next_triangle();
      if (sign_along(cone.axis, a, b, c) < 0 && i % 10 != 0) std::swap(b, c);
      triangles.push_back({a, b, c});
      const float before = cone.squared_sine;
      widen(cone, direction_of(a, b, c, longest2_of(a, b, c)));
      ASSERT_GE(cone.squared_sine, before) << "a bound must not shrink";
    }
    if (cone.squared_sine >= NormalCone::kNoBound) {
      ++unbounded;
      continue;
    }
    ++bounded;
    for (const auto& [a, b, c] : triangles) {
      ASSERT_GT(sign_along(cone.axis, a, b, c), 0) << "case " << i;
      ASSERT_LT(squared_sine_between(normal_of(a, b, c), cone.axis), cone.squared_sine) << "case " << i;
    }
  }
  EXPECT_GT(bounded, 300);
  EXPECT_GT(unbounded, 100);
}

TEST(NormalConeBound, IsNoneForANormalThatIsSquareToTheAxisOrBeyondOrUnknown) {
  for (const Eigen::Vector3f& normal : {Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 0, -1), Eigen::Vector3f(0, 0, 0),
                                        Eigen::Vector3f(1, 0, 1e-5F), Eigen::Vector3f(0.6F, 0, -0.8F)}) {
    NormalCone cone{{0, 0, 1}, 0};
    widen(cone, normal);
    EXPECT_EQ(cone.squared_sine, NormalCone::kNoBound);
    EXPECT_FALSE(is_seen_along(cone, Eigen::Vector3f(0, 0, 1)));
    widen(cone, {0, 0, 1});
    EXPECT_EQ(cone.squared_sine, NormalCone::kNoBound) << "once lost it does not come back";
  }
}

/// The axis of length 1 that is farthest from the cone's own towards `aside`, of those the star is seen along.
Eigen::Vector3f last_axis_seen_along(const NormalCone& cone, const Eigen::Vector3f& aside) {
  const Vec3 axis = axis_of(cone).normalized();
  const Vec3 across = (aside.cast<double>() - aside.cast<double>().dot(axis) * axis).normalized();
  const auto turned = [&](double angle) {
    return Eigen::Vector3f((std::cos(angle) * axis + std::sin(angle) * across).cast<float>().normalized());
  };
  double low = 0, high = 2;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (is_seen_along(cone, turned(middle)) ? low : high) = middle;
  }
  return turned(low);
}

std::vector<Eigen::Vector3f> directions_of(const Vec3& center, const std::vector<Vec3>& ring) {
  std::vector<Eigen::Vector3f> normals;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    normals.push_back(direction_of(center, a, b, longest2_of(center, a, b)));
  }
  return normals;
}

int triangles_not_seen_along(const std::array<float, 3>& axis, const Vec3& center, const std::vector<Vec3>& ring) {
  int count = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    count += static_cast<int>(sign_along(axis, center, ring[i], ring[(i + 1) % ring.size()]) <= 0);
  return count;
}

TEST(NormalConeBound, AStarIsSeenAlongEveryAxisThatIsSaidToBeOne) {
  RandomStars next_star(43);
  RandomTriangles random(44);
  int axes = 0, far_axes = 0;
  for (int i = 0; i < 400 / kThinning; ++i) {
    const MovingStar star = next_star(0.05 + 0.1 * (i % 6));
    const NormalCone cone = find_resting_cone(star.center_to, star.ring_to, directions_of(star.center_to, star.ring_to));
    if (!is_known(cone) || cone.squared_sine >= NormalCone::kNoBound) continue;
    for (int j = 0; j < 8; ++j) {
      const Eigen::Vector3f axis = j % 2 == 0 ? last_axis_seen_along(cone, random.axis()) : random.axis();
      if (!is_seen_along(cone, axis)) continue;
      ++axes;
      far_axes += static_cast<int>(axis.cast<double>().dot(axis_of(cone)) < 0.9);
      ASSERT_EQ(triangles_not_seen_along(array_of(axis), star.center_to, star.ring_to), 0) << "star " << i;
    }
  }
  EXPECT_GT(axes, 400 / kThinning);
  EXPECT_GT(far_axes, 100 / kThinning);
}

TEST(NormalConeBound, AnAxisBeyondASquareIsNeverSaidToBeOne) {
  NormalCone cone{{0, 0, 1}, 0};
  widen(cone, {0, 0, 1});
  EXPECT_TRUE(is_seen_along(cone, {0, 0, 1}));
  EXPECT_TRUE(is_seen_along(cone, Eigen::Vector3f(0.9F, 0, 0.1F).normalized())) << "a flat star is seen from nearly everywhere above";
  for (const Eigen::Vector3f& axis : {Eigen::Vector3f(0, 0, -1), Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0.6F, 0, -0.8F)})
    EXPECT_FALSE(is_seen_along(cone, axis));
}

TEST(ConeAround, HasAllTrianglesOnItsPositiveSideWithinItsBound) {
  RandomStars next_star(45);
  int known = 0, unknown = 0;
  for (int i = 0; i < 500 / kThinning; ++i) {
    const MovingStar star = next_star(0.05 + 0.1 * (i % 8));
    const std::vector<Vec3>& ring = star.ring_to;
    // What the function asks for: a star seen one-to-one along some axis.
    if (!is_known(find_cone(resting_star(ring, star.center_to)))) continue;
    const NormalCone cone = cone_around(directions_of(star.center_to, ring));
    if (!is_known(cone)) {
      ++unknown;
      continue;
    }
    ++known;
    EXPECT_NEAR(axis_of(cone).norm(), 1, 1e-6);
    ASSERT_EQ(triangles_not_seen_along(cone.axis, star.center_to, ring), 0) << "star " << i;
    ASSERT_FALSE(meets_itself(star.center_to, ring)) << "star " << i;
    if (cone.squared_sine >= NormalCone::kNoBound) continue;
    for (std::size_t k = 0; k < ring.size(); ++k)
      ASSERT_LT(squared_sine_between(normal_of(star.center_to, ring[k], ring[(k + 1) % ring.size()]), cone.axis), cone.squared_sine);
  }
  EXPECT_GT(known, 150 / kThinning);
  EXPECT_LT(unknown, known / 4) << "the mean of the normals is nearly always such an axis";
}

TEST(ConeAround, IsUnknownWhereTheMeanOfTheNormalsIsNoSuchAxis) {
  // All are positive along z, but the many that lean to +x draw the mean away from the one that leans to −x.
  std::vector<Eigen::Vector3f> normals(9, Eigen::Vector3f(1, 0, 0.1F).normalized());
  normals.push_back(Eigen::Vector3f(-1, 0, 0.1F).normalized());
  EXPECT_FALSE(is_known(cone_around(normals)));
  normals.assign(4, Eigen::Vector3f(0, 0, 1));
  EXPECT_TRUE(is_known(cone_around(normals)));
  normals.push_back(Eigen::Vector3f(0, 0, 0));
  EXPECT_FALSE(is_known(cone_around(normals)) && cone_around(normals).squared_sine < NormalCone::kNoBound) << "one has no direction";
}

TEST(RestingCone, IsKnownOnlyForStarsThatDoNotMeetThemselves) {
  RandomStars next_star(46);
  int known = 0, meeting = 0;
  for (int i = 0; i < 800 / kThinning; ++i) {
    const MovingStar star = next_star(0.1 + 0.1 * (i % 9));
    const std::vector<Vec3>& ring = star.ring_to;
    const NormalCone cone = find_resting_cone(star.center_to, ring, directions_of(star.center_to, ring));
    const bool meets = meets_itself(star.center_to, ring);
    meeting += static_cast<int>(meets);
    if (!is_known(cone)) continue;
    ++known;
    ASSERT_FALSE(meets) << "star " << i;
    ASSERT_EQ(triangles_not_seen_along(cone.axis, star.center_to, ring), 0) << "star " << i;
  }
  EXPECT_GT(known, 200 / kThinning);
  EXPECT_GT(meeting, 50 / kThinning);
}

TEST(RestingCone, AStarThatTurnsTwiceHasNone) {
  for (const int n : {5, 7, 9, 101}) {
    const std::vector<Vec3> twice = flat_ring(n, 2), once = flat_ring(n);
    EXPECT_FALSE(is_known(find_resting_cone(Vec3::Zero(), twice, directions_of(Vec3::Zero(), twice)))) << n;
    EXPECT_TRUE(is_known(find_resting_cone(Vec3::Zero(), once, directions_of(Vec3::Zero(), once)))) << n;
  }
}

TEST(RestingCone, ACentreOutsideOrOnTheRingHasNone) {
  const std::vector<Vec3> ring = flat_ring(6);
  for (const Vec3& center : {Vec3(2, 0, 0), ring[1], Vec3(0.5 * (ring[0] + ring[1]))})
    EXPECT_FALSE(is_known(find_resting_cone(center, ring, directions_of(center, ring))));
}

}  // namespace
}  // namespace smopt
