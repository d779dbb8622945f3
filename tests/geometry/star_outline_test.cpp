#include "smopt/geometry/star_outline.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/geometry/exact_hulls.h"
#include "tests/geometry/random_points.h"

namespace smopt {
namespace {

using namespace testing;

using Corners = std::array<Vec3, 3>;
using Entry = TriangleBatch::Entry;

/// Asked of every unit normal of the star, before and after the move.
constexpr double kLeastComponent = 2e-5;

/// A star, its move and the axis; absolute coordinates, so that nothing is rounded but what the outline is told.
struct Scene {
  std::vector<Vec3> ring;
  Vec3 vertex, target, batch_center;
  Eigen::Vector3f up;

  [[nodiscard]] std::size_t valence() const { return ring.size(); }
  [[nodiscard]] std::size_t next(std::size_t k) const { return (k + 1) % ring.size(); }
  [[nodiscard]] std::size_t previous(std::size_t k) const { return (k + ring.size() - 1) % ring.size(); }
  [[nodiscard]] std::array<Vec3, 4> swept(std::size_t k) const { return {ring[k], ring[next(k)], vertex, target}; }
  [[nodiscard]] double size() const {
    double size = 0;
    for (const Vec3& p : ring) size = std::max(size, (p - vertex).norm());
    return size;
  }
};

/// Twice the area of the triangle as seen along the axis.
double area_along(const Eigen::Vector3f& up, const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a).dot(up.cast<double>());
}

/// Two unit vectors that make a right-handed frame with the axis.
std::array<Vec3, 2> across(const Eigen::Vector3f& up) {
  const Vec3 axis = up.cast<double>();
  const Vec3 x = axis.cross(std::abs(axis[0]) < 0.5 ? Vec3::UnitX() : Vec3::UnitY()).normalized();
  return {x, axis.cross(x).normalized()};
}

/// The angle at the corner `at`, from `a` anticlockwise to `b`, as seen along the axis; in [0, 2π).
double angle_along(const Eigen::Vector3f& up, const Vec3& at, const Vec3& a, const Vec3& b) {
  const auto [x, y] = across(up);
  const double from = std::atan2((a - at).dot(y), (a - at).dot(x)), to = std::atan2((b - at).dot(y), (b - at).dot(x));
  return to < from ? to - from + 2 * std::numbers::pi : to - from;
}

/// Whether a star is seen one-to-one along the axis, with the least component that is asked for.
bool is_seen_one_to_one(const Scene& scene, const Vec3& center) {
  double turn = 0;
  for (std::size_t k = 0; k < scene.valence(); ++k) {
    const Vec3 &a = scene.ring[k], &b = scene.ring[scene.next(k)];
    const double area = area_along(scene.up, center, a, b);
    if (!(area > kLeastComponent * (a - center).cross(b - center).norm())) return false;
    turn += angle_along(scene.up, center, a, b);
  }
  return std::abs(turn - 2 * std::numbers::pi) < 1;
}

Eigen::Vector3f unit(const Vec3& v) {
  return v.cast<float>().normalized();
}

/// The triangle as a batch around the scene's centre would have it.
Entry entry_of(const Scene& scene, const Corners& t) {
  const Eigen::Vector3f a = (t[0] - scene.batch_center).cast<float>(), b = (t[1] - scene.batch_center).cast<float>(),
                        c = (t[2] - scene.batch_center).cast<float>();
  const auto lanes = [&](int axis) { return Floats{a[axis], b[axis], c[axis], c[axis]}; };
  return {lanes(0), lanes(1), lanes(2), 0, {0, 1, 2}};
}

/// No coordinate of the triangles is larger.
float radius_of(const Scene& scene, const std::vector<Corners>& triangles) {
  float radius = 0;
  for (const Corners& t : triangles)
    for (const Vec3& p : t) radius = std::max(radius, (p - scene.batch_center).cast<float>().cwiseAbs().maxCoeff());
  return radius;
}

void draw(StarOutline& outline, const Scene& scene, float radius) {
  std::vector<Vec3> spokes;
  for (const Vec3& p : scene.ring) spokes.push_back(p - scene.vertex);
  outline.set(spokes, scene.target - scene.vertex, scene.up, scene.vertex - scene.batch_center, radius);
}

StarOutline outline_of(const Scene& scene, const std::vector<Corners>& triangles) {
  StarOutline outline;
  draw(outline, scene, radius_of(scene, triangles));
  return outline;
}

/// Whether the triangle meets what the star's triangles sweep, those with a ring vertex in `own` left out.
bool meets_sweep_of_others(const Scene& scene, const Corners& triangle, unsigned own) {
  for (std::size_t k = 0; k < scene.valence(); ++k)
    if ((own >> k & 1) == 0 && (own >> scene.next(k) & 1) == 0 && hulls_meet_beyond(triangle, scene.swept(k), {})) return true;
  return false;
}

enum class Shape { flat, rough, needles, reflex, off_center, straight };
constexpr std::array kShapes = {Shape::flat, Shape::rough, Shape::needles, Shape::reflex, Shape::off_center, Shape::straight};

class RandomScenes {
 public:
  explicit RandomScenes(std::uint32_t seed) : random_(seed) {}

  double number() { return uniform_(random_); }
  double part() { return 0.5 * (number() + 1); }
  Vec3 vector() { return {number(), number(), number()}; }
  std::size_t index(std::size_t count) { return random_() % count; }
  /// Any order of magnitude in between, any one as likely.
  double log_number(double low, double high) { return std::exp(std::log(low) + part() * (std::log(high) - std::log(low))); }

  /// A star that is seen one-to-one along its axis before and after its move; of any size, anywhere, turned anyhow.
  Scene scene(Shape shape) {
    for (;;) {
      Scene scene = upright(shape, 3 + index(StarOutline::kMaxValence - 2));
      place_anywhere(scene);
      if (is_seen_one_to_one(scene, scene.vertex) && is_seen_one_to_one(scene, scene.target)) return scene;
    }
  }

  /// A triangle anywhere near the star, of any size up to a few times that of the star.
  Corners anywhere(const Scene& scene) {
    const double size = scene.size(), reach = size * log_number(0.01, 4);
    const Vec3 corner = scene.vertex + 2 * size * vector();
    return {corner, corner + reach * vector(), corner + reach * vector()};
  }

  /// A triangle with one corner just inside, on or just outside what a triangle of the star sweeps, mostly outside.
  Corners touching_a_sweep(const Scene& scene) {
    const auto hull = scene.swept(index(scene.valence()));
    Vec3 weights = (vector() + Vec3::Ones()) / 2;
    weights /= std::max(1.0, weights.sum());
    if (index(2) == 0) weights[static_cast<int>(index(3))] = 0;
    const Vec3 middle = 0.25 * (hull[0] + hull[1] + hull[2] + hull[3]);
    const Vec3 p = hull[3] + weights[0] * (hull[0] - hull[3]) + weights[1] * (hull[1] - hull[3]) + weights[2] * (hull[2] - hull[3]);
    return beginning_at(scene, p, p - middle);
  }

  /// A triangle with one corner just inside, on or just outside the prism's wall over an edge of the ring, at its middle or one of its ends.
  Corners touching_the_outline(const Scene& scene) {
    const std::size_t k = index(scene.valence());
    const Vec3 edge = scene.ring[scene.next(k)] - scene.ring[k];
    const double along = std::array{0.0, 0.5, 1.0, part()}[index(4)];
    return beginning_at(scene, scene.ring[k] + along * edge, edge.cross(scene.up.cast<double>()));
  }

  /// A triangle with an edge that just touches or just misses the top or the bottom of the prism.
  Corners touching_top_or_bottom(const Scene& scene) {
    const Vec3 up = scene.up.cast<double>();
    const auto height = [&](const Vec3& p) { return p.dot(up); };
    std::vector<Vec3> points = scene.ring;
    points.insert(points.end(), {scene.vertex, scene.target});
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) { return height(a) < height(b); });
    const bool is_top = index(2) == 0;
    const Vec3 touched = (is_top ? *high : *low) + (is_top ? 1 : -1) * gap(scene) * up;
    const auto [x, y] = across(scene.up);
    const Vec3 aside = scene.size() * (number() * x + number() * y);
    return {touched + aside, touched - aside, touched + scene.size() * ((is_top ? 1 : -1) * part() * up + number() * x)};
  }

  /// The triangles of the ring vertex k that are not the star's, so that its star is seen one-to-one; edges anything from edge-on to flat.
  std::vector<Corners> fan_of(const Scene& scene, std::size_t k) {
    const Vec3 &w = scene.ring[k], &first = scene.ring[scene.previous(k)], &last = scene.ring[scene.next(k)];
    const double opening = angle_along(scene.up, w, first, last);
    std::vector<double> angles{0, opening};
    for (std::size_t extra = 2 + index(4); extra > 0; --extra) angles.push_back(opening * (index(3) == 0 ? near_an_end() : part()));
    std::sort(angles.begin(), angles.end());
    std::vector<Vec3> points{first};
    for (std::size_t i = 1; i + 1 < angles.size(); ++i) points.push_back(spoke_end(scene, w, first, angles[i]));
    points.push_back(last);
    std::vector<Corners> fan;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      fan.push_back({w, points[i], points[i + 1]});
      if (!is_clearly_anticlockwise(scene, fan.back())) return {};
    }
    return fan;
  }

  /// Triangles that the ring vertex k may have and that pass right over or under the other ring vertices, or through them.
  std::vector<Corners> triangles_towards_others(const Scene& scene, std::size_t k) {
    const Vec3 &w = scene.ring[k], &first = scene.ring[scene.previous(k)], &last = scene.ring[scene.next(k)];
    std::vector<Corners> triangles;
    for (const Vec3& p : scene.ring) {
      if (p == w || p == first || p == last) continue;
      const Vec3 q = w + (1 + part()) * (p - w);
      for (const Corners& t : {Corners{w, q, last}, Corners{w, first, q}})
        if (is_clearly_anticlockwise(scene, t)) triangles.push_back(t);
    }
    return triangles;
  }

  /// Turned round where it is clockwise as seen along the axis.
  static Corners anticlockwise(const Scene& scene, const Corners& t) {
    return area_along(scene.up, t[0], t[1], t[2]) > 0 ? t : Corners{t[0], t[2], t[1]};
  }

 private:
  /// With its vertex at the origin, of about unit size, along the z axis.
  Scene upright(Shape shape, std::size_t valence) {
    Scene scene;
    const double roughness = shape == Shape::flat ? 1e-3 * part() : part();
    for (std::size_t k = 0; k < valence; ++k) {
      const double angle = 2 * std::numbers::pi * (static_cast<double>(k) + 0.4 * number()) / static_cast<double>(valence);
      scene.ring.emplace_back(radius(shape, k) * Vec3(std::cos(angle), std::sin(angle), roughness * number()));
    }
    if (shape == Shape::straight) straighten(scene.ring);
    scene.vertex = shape == Shape::off_center ? inside(scene.ring) : Vec3(0, 0, roughness * number());
    // The target may be anywhere over the kernel of the ring, also far above it.
    scene.target = scene.vertex + log_number(1e-3, 1) * Vec3(number(), number(), (index(4) == 0 ? 5 : 1) * number());
    if (index(20) == 0) scene.target = scene.vertex;
    scene.up = unit(Vec3::UnitZ() + (index(2) == 0 ? 0.0 : 0.3) * vector());
    return scene;
  }

  double radius(Shape shape, std::size_t k) {
    switch (shape) {
      case Shape::needles:
        return log_number(1e-4, 1);
      case Shape::reflex:
        return k % 2 == 0 ? 1 : 0.2 + 0.4 * part();
      case Shape::rough:
        return 0.3 + 1.2 * part();
      default:
        return 0.9 + 0.2 * part();
    }
  }

  /// Puts all points but every second or third next to the straight line between those.
  void straighten(std::vector<Vec3>& ring) {
    const std::size_t step = 2 + index(2);
    for (std::size_t k = 0; k + step <= ring.size(); k += step) {
      const Vec3 &from = ring[k], &to = ring[(k + step) % ring.size()];
      for (std::size_t i = 1; i < step; ++i)
        ring[k + i] = from + static_cast<double>(i) / static_cast<double>(step) * (to - from) + log_number(1e-9, 1e-4) * vector();
    }
  }

  /// A point near the middle of an edge of the ring, a little inside.
  Vec3 inside(const std::vector<Vec3>& ring) {
    const std::size_t k = index(ring.size());
    return (1 - log_number(1e-4, 0.5)) * (ring[k] + part() * (ring[(k + 1) % ring.size()] - ring[k]));
  }

  void place_anywhere(Scene& scene) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(3 * number(), (vector() + Vec3(1.1, 0, 0)).normalized()).toRotationMatrix();
    const double scale = log_number(1e-6, 1e6);
    const Vec3 place = index(2) == 0 ? Vec3::Zero().eval() : Vec3(scale * log_number(1, 1e6) * vector());
    const auto put = [&](Vec3& p) { p = place + scale * (turn * p); };
    for (Vec3& p : scene.ring) put(p);
    put(scene.vertex);
    put(scene.target);
    scene.up = unit(turn * scene.up.cast<double>());
    // In use the centre is some edges away; single precision gets the coarser the farther it is.
    scene.batch_center = scene.vertex + scale * log_number(0.1, 1e4) * vector();
  }

  /// A relative distance from contact: none, a few units of double or single precision, or more; now and then to the inside.
  double gap(const Scene& scene) { return index(8) == 0 ? 0 : scene.size() * log_number(1e-16, 0.1) * (index(6) == 0 ? -1 : 1); }

  Corners beginning_at(const Scene& scene, const Vec3& p, const Vec3& outwards) {
    const Vec3 out = outwards.norm() > 0 ? Vec3(outwards.normalized()) : vector();
    const Vec3 corner = p + gap(scene) * out;
    const double reach = scene.size() * log_number(0.01, 3);
    // Half of them reach along the wall rather than away from it.
    const double away = index(2) == 0 ? 1 : log_number(1e-9, 0.1);
    const auto other = [&] {
      const Vec3 any = vector();
      return Vec3(corner + reach * (any - any.dot(out) * out + away * part() * out));
    };
    return {corner, other(), other()};
  }

  /// As seen along the axis, by far more than the rounding of the test's own arithmetic.
  static bool is_clearly_anticlockwise(const Scene& scene, const Corners& t) {
    return area_along(scene.up, t[0], t[1], t[2]) > 1e-12 * (t[1] - t[0]).norm() * (t[2] - t[0]).norm();
  }

  /// A part of a whole next to zero or one.
  double near_an_end() {
    const double x = log_number(1e-7, 0.1);
    return index(2) == 0 ? x : 1 - x;
  }

  Vec3 spoke_end(const Scene& scene, const Vec3& w, const Vec3& first, double angle) {
    const Vec3 up = scene.up.cast<double>();
    const auto [x, y] = across(scene.up);
    const double from = std::atan2((first - w).dot(y), (first - w).dot(x));
    const double length = scene.size() * log_number(0.01, 5);
    return w + length * (std::cos(from + angle) * x + std::sin(from + angle) * y + log_number(1e-6, 5) * number() * up);
  }

  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

std::vector<Corners> candidates_near(const Scene& scene, RandomScenes& random) {
  std::vector<Corners> triangles;
  for (int i = 0; i < 4; ++i) {
    triangles.push_back(random.anywhere(scene));
    triangles.push_back(random.touching_a_sweep(scene));
    triangles.push_back(random.touching_the_outline(scene));
    triangles.push_back(random.touching_top_or_bottom(scene));
  }
  return triangles;
}

class StarShapes : public ::testing::TestWithParam<Shape> {};
std::string name_of(const ::testing::TestParamInfo<Shape>& shape) {
  constexpr std::array kNames = {"flat", "rough", "needles", "reflex", "off_center", "straight"};
  return kNames[static_cast<std::size_t>(shape.param)];
}
INSTANTIATE_TEST_SUITE_P(StarOutline, StarShapes, ::testing::ValuesIn(kShapes), name_of);

constexpr int kScenes = 400;

TEST_P(StarShapes, ATriangleThatIsClearMeetsNothingThatIsSwept) {
  RandomScenes random(11 + static_cast<std::uint32_t>(GetParam()));
  int clear = 0;
  for (int i = 0; i < kScenes / kThinning; ++i) {
    const Scene scene = random.scene(GetParam());
    const std::vector<Corners> triangles = candidates_near(scene, random);
    const StarOutline outline = outline_of(scene, triangles);
    for (std::size_t j = 0; j < triangles.size(); ++j) {
      if (!outline.is_clear_of(entry_of(scene, triangles[j]))) continue;
      ++clear;
      ASSERT_FALSE(meets_sweep_of_others(scene, triangles[j], 0)) << "scene " << i << ", triangle " << j;
    }
  }
  EXPECT_GT(clear, kScenes / kThinning);
}

/// Whether the triangle is anticlockwise (1), edge-on (0) or clockwise (−1) as seen along the axis: exact but for the rounding of its edges.
int orientation_along(const Eigen::Vector3f& up, const Corners& t) {
  return rational_orient3d(Vec3::Zero(), t[1] - t[0], t[2] - t[0], up.cast<double>());
}

TEST_P(StarShapes, ATriangleThatIsPartedIsAnticlockwiseAndMeetsNothingThatIsSwept) {
  RandomScenes random(31 + static_cast<std::uint32_t>(GetParam()));
  int parted = 0;
  for (int i = 0; i < kScenes / kThinning; ++i) {
    const Scene scene = random.scene(GetParam());
    const std::vector<Corners> triangles = candidates_near(scene, random);
    const StarOutline outline = outline_of(scene, triangles);
    for (std::size_t j = 0; j < triangles.size(); ++j) {
      for (const Corners& t : {triangles[j], Corners{triangles[j][1], triangles[j][0], triangles[j][2]}}) {
        if (!outline.is_parted_from_others(entry_of(scene, t), 0)) continue;
        ++parted;
        ASSERT_GT(orientation_along(scene.up, t), 0) << "scene " << i << ", triangle " << j;
        ASSERT_FALSE(meets_sweep_of_others(scene, t, 0)) << "scene " << i << ", triangle " << j;
      }
    }
  }
  EXPECT_GT(parted, kScenes / kThinning);
}

TEST(StarOutline, ATriangleSeenEdgeOnIsNeverParted) {
  // Steep triangles next to a flat star, their slope down to what single precision cannot tell from upright.
  RandomScenes random(37);
  int parted = 0;
  for (int i = 0; i < 3000; ++i) {
    const Scene scene = random.scene(Shape::flat);
    const Vec3 up = scene.up.cast<double>();
    const auto [x, y] = across(scene.up);
    const double size = scene.size();
    const Vec3 a = scene.vertex + size * (2 * x + random.number() * y), b = a + size * random.number() * y;
    const double lean = random.log_number(1e-9, 1) * (random.index(2) == 0 ? 1 : -1);
    const Corners t{a, b, a + size * (random.number() * up + lean * x)};
    if (!outline_of(scene, {t}).is_parted_from_others(entry_of(scene, t), 0)) continue;
    ++parted;
    ASSERT_GT(orientation_along(scene.up, t), 0) << "case " << i << ", lean " << lean;
  }
  EXPECT_GT(parted, 100);
}

/// A triangle that has one or two of the ring's vertices, and any other corners.
struct Neighbour {
  Corners corners;
  unsigned own = 0;
};

Neighbour random_neighbour(const Scene& scene, RandomScenes& random) {
  const std::size_t k = random.index(scene.valence()), other = random.index(scene.valence());
  const std::size_t kind = random.index(3);
  Corners t = kind == 0 ? random.touching_the_outline(scene) : (kind == 1 ? random.touching_a_sweep(scene) : random.anywhere(scene));
  std::rotate(t.begin(), t.begin() + 2, t.end());  // the corner that touches is the second now
  unsigned own = 1U << k;
  t[0] = scene.ring[k];
  if (other != k && random.index(2) == 0) {
    t[1] = scene.ring[random.index(2) == 0 ? other : scene.next(k)];
    own |= t[1] == scene.ring[other] ? 1U << other : 1U << scene.next(k);
  }
  return {RandomScenes::anticlockwise(scene, t), own};
}

TEST_P(StarShapes, ATriangleWithVerticesOfTheRingThatIsPartedMeetsNothingThatTheOthersSweep) {
  RandomScenes random(51 + static_cast<std::uint32_t>(GetParam()));
  int parted = 0;
  for (int i = 0; i < kScenes / kThinning; ++i) {
    const Scene scene = random.scene(GetParam());
    std::vector<Neighbour> neighbours;
    std::vector<Corners> triangles;
    for (int j = 0; j < 12; ++j) {
      neighbours.push_back(random_neighbour(scene, random));
      triangles.push_back(neighbours.back().corners);
    }
    const StarOutline outline = outline_of(scene, triangles);
    for (std::size_t j = 0; j < neighbours.size(); ++j) {
      const auto& [corners, own] = neighbours[j];
      if (!outline.is_parted_from_others(entry_of(scene, corners), own)) continue;
      ++parted;
      ASSERT_FALSE(meets_sweep_of_others(scene, corners, own)) << "scene " << i << ", triangle " << j;
    }
  }
  EXPECT_GT(parted, kScenes / kThinning);
}

/// What the triangle shares by its indices with triangle k of the star: none, one or two points.
std::vector<Vec3> shared_with(const Scene& scene, const Corners& triangle, std::size_t k) {
  std::vector<Vec3> shared;
  for (const Vec3& p : triangle)
    if (p == scene.ring[k] || p == scene.ring[scene.next(k)]) shared.push_back(p);
  return shared;
}

TEST_P(StarShapes, WhereTheOutlineIsConvexTheTrianglesOfTheRingVertexMeetTheSweepOnlyInWhatTheyShare) {
  RandomScenes random(71 + static_cast<std::uint32_t>(GetParam()));
  int settled = 0;
  for (int i = 0; i < kScenes / kThinning; ++i) {
    const Scene scene = random.scene(GetParam());
    const StarOutline outline = outline_of(scene, {});
    for (std::size_t k = 0; k < scene.valence(); ++k) {
      if (!outline.is_convex_at(k)) continue;
      std::vector<Corners> triangles = random.fan_of(scene, k);
      for (const Corners& t : random.triangles_towards_others(scene, k)) triangles.push_back(t);
      for (const Corners& triangle : triangles) {
        ++settled;
        for (std::size_t j = 0; j < scene.valence(); ++j)
          ASSERT_FALSE(hulls_meet_beyond(triangle, scene.swept(j), shared_with(scene, triangle, j)))
              << fmt::format("scene {}, ring vertex {}, triangle {} of the star", i, k, j);
      }
    }
  }
  EXPECT_GT(settled, kScenes / 2 / kThinning);
}

// ---- Contact ----

/// A star whose coordinates are small multiples of a power of two, so that points of contact are exact.
Scene exact_scene(RandomScenes& random) {
  constexpr double kStep = 0x1p-10;
  for (;;) {
    Scene scene = random.scene(kShapes[random.index(kShapes.size())]);
    const double size = scene.size();
    const Vec3 origin = scene.vertex;
    const auto round = [&](Vec3& p) { p = kStep * ((p - origin) / size / kStep).array().round().matrix(); };
    for (Vec3& p : scene.ring) round(p);
    round(scene.target);
    round(scene.batch_center);
    scene.vertex = Vec3::Zero();
    if (is_seen_one_to_one(scene, scene.vertex) && is_seen_one_to_one(scene, scene.target)) return scene;
  }
}

/// A point of what is swept, exact: a corner, or the middle of an edge or of two opposite edges' middles.
Vec3 point_of_the_sweep(const Scene& scene, RandomScenes& random) {
  const auto hull = scene.swept(random.index(scene.valence()));
  const auto middle = [&] { return Vec3(0.5 * (hull[random.index(4)] + hull[random.index(4)])); };
  return random.index(2) == 0 ? middle() : 0.5 * (middle() + middle());
}

TEST(StarOutline, ATriangleThatTouchesIsNeverClearOrParted) {
  RandomScenes random(91);
  for (int i = 0; i < 4000 / kThinning; ++i) {
    const Scene scene = exact_scene(random);
    const Vec3 p = point_of_the_sweep(scene, random);
    const auto whole = [&](double reach) { return Vec3((reach * 1024 * random.vector()).array().round() / 1024); };
    const Vec3 d = whole(2), e = whole(2);
    // The point is a corner, within an edge, or within the triangle.
    const Corners touching =
        std::array{Corners{p, p + d, p + e}, Corners{p - d, p + d, p + e}, Corners{p + d, p + e, p - d - e}}[random.index(3)];
    ASSERT_TRUE(meets_sweep_of_others(scene, touching, 0)) << "case " << i;
    const Corners seen = RandomScenes::anticlockwise(scene, touching);
    const StarOutline outline = outline_of(scene, {seen});
    ASSERT_FALSE(outline.is_clear_of(entry_of(scene, seen))) << "case " << i;
    ASSERT_FALSE(outline.is_parted_from_others(entry_of(scene, seen), 0)) << "case " << i;
  }
}

TEST(StarOutline, IsNotConvexWhereTheRingIsStraightOrReflex) {
  // Eight points on a square, every second in the middle of a side; then pushed in.
  for (const double inwards : {0.0, 0x1p-30, 0.25}) {
    Scene scene{{}, Vec3::Zero(), {0, 0, 0.25}, Vec3::Zero(), Eigen::Vector3f::UnitZ()};
    const double middle = 1 - inwards;
    scene.ring = {{1, 1, 0}, {0, middle, 0}, {-1, 1, 0}, {-middle, 0, 0}, {-1, -1, 0}, {0, -middle, 0}, {1, -1, 0}, {middle, 0, 0}};
    const StarOutline outline = outline_of(scene, {});
    for (std::size_t k = 1; k < 8; k += 2) EXPECT_FALSE(outline.is_convex_at(k)) << inwards << ", " << k;
  }
}

TEST(StarOutline, IsNotConvexWhereTheRingReachesOutOfTheAngle) {
  // At the tip (0, −1) the ring turns left; the lines of its edges are y = −1 ± 1.5 x. Two arms reach beyond them, or stay within.
  for (const bool is_beyond : {true, false}) {
    const double reach = is_beyond ? 4 : 1;
    const Scene scene{{{0, -1, 0}, {0.5, -0.25, 0}, {reach, 0.9, 0}, {0, 1, 0}, {-reach, 0.9, 0}, {-0.5, -0.25, 0}},
                      {0, 0.5, 0},
                      {0, 0.5, 0.1},
                      Vec3::Zero(),
                      Eigen::Vector3f::UnitZ()};
    ASSERT_TRUE(is_seen_one_to_one(scene, scene.vertex));
    EXPECT_EQ(outline_of(scene, {}).is_convex_at(0), !is_beyond);
  }
}

TEST(StarOutline, IsConvexAtEveryVertexOfARegularRing) {
  for (int n = 3; n <= static_cast<int>(StarOutline::kMaxValence); ++n) {
    Scene scene{{}, Vec3::Zero(), {0.05, 0.02, 0.1}, Vec3::Zero(), Eigen::Vector3f::UnitZ()};
    for (int k = 0; k < n; ++k) scene.ring.emplace_back(std::cos(2 * std::numbers::pi * k / n), std::sin(2 * std::numbers::pi * k / n), 0);
    const StarOutline outline = outline_of(scene, {});
    for (std::size_t k = 0; k < scene.valence(); ++k) EXPECT_TRUE(outline.is_convex_at(k)) << n << " points, " << k;
  }
}

// ---- Its use ----

/// The neighbourhood of a vertex in a mesh of nearly regular triangles, some edges from the middle of the batch.
struct GentleScene {
  Scene scene;
  std::vector<Neighbour> nearest;  // around the ring, with ring vertices
  std::vector<Corners> farther;    // without
};

GentleScene gentle_scene(RandomScenes& random) {
  constexpr int kReach = 4;
  constexpr double kNoise = 0.08;
  std::array<std::array<Vec3, 2 * kReach + 1>, 2 * kReach + 1> points;
  const auto at = [&](int i, int j) -> Vec3& { return points[static_cast<std::size_t>(i + kReach)][static_cast<std::size_t>(j + kReach)]; };
  for (int i = -kReach; i <= kReach; ++i)
    for (int j = -kReach; j <= kReach; ++j)
      at(i, j) = Vec3(i + 0.5 * j, std::sqrt(0.75) * j, -0.03 * (i * i + j * j + i * j)) + kNoise * random.vector();
  constexpr std::array<std::array<int, 2>, 6> kRing = {{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};
  GentleScene gentle;
  Scene& scene = gentle.scene;
  for (const auto& [i, j] : kRing) scene.ring.push_back(at(i, j));
  scene.vertex = at(0, 0);
  scene.target = scene.vertex + kNoise * random.vector();
  scene.batch_center = scene.vertex + 5 * random.vector();
  scene.up = unit(Vec3::UnitZ() + 0.1 * random.vector());
  const auto add = [&](const std::array<std::array<int, 2>, 3>& nodes) {
    Neighbour t;
    bool is_of_star = false;
    for (std::size_t c = 0; c < 3; ++c) {
      t.corners[c] = at(nodes[c][0], nodes[c][1]);
      is_of_star |= nodes[c] == std::array{0, 0};
      for (std::size_t k = 0; k < kRing.size(); ++k) t.own |= nodes[c] == kRing[k] ? 1U << k : 0U;
    }
    if (is_of_star) return;
    t.own != 0 ? gentle.nearest.push_back(t) : gentle.farther.push_back(t.corners);
  };
  for (int i = -kReach; i < kReach; ++i) {
    for (int j = -kReach; j < kReach; ++j) {
      add({{{i, j}, {i + 1, j}, {i, j + 1}}});
      add({{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
    }
  }
  return gentle;
}

TEST(StarOutline, SettlesMostTrianglesAroundAGentleStar) {
  RandomScenes random(111);
  int corners = 0, convex = 0, nearest = 0, parted = 0, farther = 0, clear = 0;
  for (int i = 0; i < 200; ++i) {
    const auto [scene, neighbours, others] = gentle_scene(random);
    std::vector<Corners> triangles = others;
    for (const Neighbour& t : neighbours) triangles.push_back(t.corners);
    const StarOutline outline = outline_of(scene, triangles);
    for (std::size_t k = 0; k < scene.valence(); ++k, ++corners) convex += static_cast<int>(outline.is_convex_at(k));
    for (const Neighbour& t : neighbours) {
      ++nearest;
      parted += static_cast<int>(outline.is_parted_from_others(entry_of(scene, t.corners), t.own));
    }
    for (const Corners& t : others) {
      ++farther;
      clear += static_cast<int>(outline.is_clear_of(entry_of(scene, t)));
    }
  }
  EXPECT_EQ(nearest, 200 * 18);
  EXPECT_GE(convex, corners * 98 / 100);
  EXPECT_GE(parted, nearest * 80 / 100);
  EXPECT_GE(clear, farther * 98 / 100);
}

TEST(StarOutline, SettlesTrianglesThatAreClearByAHundredthOfTheStar) {
  constexpr double kGap = 1e-2;
  Scene scene{{}, Vec3::Zero(), {0, 0, 0.1}, {3, 2, -4}, Eigen::Vector3f::UnitZ()};
  for (int k = 0; k < 6; ++k) scene.ring.emplace_back(std::cos(k * std::numbers::pi / 3), std::sin(k * std::numbers::pi / 3), 0);
  const auto level = [](double z) { return Corners{Vec3(-1, -1, z), Vec3(1, -1, z), Vec3(0, 1, z)}; };
  const double wall = std::sqrt(0.75);  // y of the ring's edge from 60° to 120°
  const Corners beside{Vec3(0.3, wall + kGap, 0), Vec3(0.3, wall + 1, 0.2), Vec3(-0.3, wall + kGap, 0)};
  const StarOutline outline = outline_of(scene, {level(0.1 + kGap), level(-kGap), beside});
  EXPECT_TRUE(outline.is_clear_of(entry_of(scene, level(0.1 + kGap))));
  EXPECT_TRUE(outline.is_clear_of(entry_of(scene, level(-kGap))));
  EXPECT_TRUE(outline.is_parted_from_others(entry_of(scene, beside), 0));
  EXPECT_FALSE(outline.is_clear_of(entry_of(scene, level(0.1)))) << "touches the target";
  EXPECT_FALSE(outline.is_clear_of(entry_of(scene, level(0)))) << "touches the star";
}

TEST(StarOutline, ClaimsNothingWhereSinglePrecisionOverflows) {
  for (const double scale : {1e20, 1e30, 1e37}) {
    Scene scene{{}, Vec3::Zero(), {0, 0, 0.1 * scale}, Vec3::Zero(), Eigen::Vector3f::UnitZ()};
    for (int k = 0; k < 6; ++k)
      scene.ring.push_back(scale * Vec3(std::cos(k * std::numbers::pi / 3), std::sin(k * std::numbers::pi / 3), 0));
    const Corners across{scale * Vec3(-3, -3, 0.05), scale * Vec3(3, -3, 0.05), scale * Vec3(0, 3, 0.05)};
    const StarOutline outline = outline_of(scene, {across});
    for (std::size_t k = 0; k < 6; ++k) EXPECT_FALSE(outline.is_convex_at(k)) << scale;
    EXPECT_FALSE(outline.is_clear_of(entry_of(scene, across))) << scale;
    EXPECT_FALSE(outline.is_parted_from_others(entry_of(scene, across), 0)) << scale;
  }
}

TEST(StarOutline, ASecondStarDoesNotRememberTheFirst) {
  RandomScenes random(131);
  StarOutline reused;
  for (int i = 0; i < 500; ++i) {
    const Scene scene = random.scene(kShapes[random.index(kShapes.size())]);
    const std::vector<Corners> triangles = candidates_near(scene, random);
    const StarOutline fresh = outline_of(scene, triangles);
    draw(reused, scene, radius_of(scene, triangles));
    for (std::size_t k = 0; k < scene.valence(); ++k) ASSERT_EQ(reused.is_convex_at(k), fresh.is_convex_at(k)) << "scene " << i;
    for (const Corners& t : triangles) {
      const Entry entry = entry_of(scene, RandomScenes::anticlockwise(scene, t));
      ASSERT_EQ(reused.is_clear_of(entry), fresh.is_clear_of(entry)) << "scene " << i;
      ASSERT_EQ(reused.is_parted_from_others(entry, 0), fresh.is_parted_from_others(entry, 0)) << "scene " << i;
    }
  }
}

}  // namespace
}  // namespace smopt
