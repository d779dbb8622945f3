#include "smopt/geometry/triangle_intersection.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tests/geometry/exact_hulls.h"
#include "tests/geometry/random_points.h"

namespace smopt {
namespace {

using namespace testing;

constexpr std::uint32_t kSeed = 41;
/// Cases of each kind of lattice: some of every degenerate position among them.
constexpr int kCases = 1200 / kThinning;

TrianglePoints random_triangle(LatticePoints& point) {
  TrianglePoints t;
  for (Vec3& p : t) p = point();
  return t;
}

bool is_degenerate(const TrianglePoints& t) {
  return are_rationally_collinear(t[0], t[1], t[2]);
}

std::string describe(std::span<const Vec3> points) {
  std::string text;
  for (const Vec3& p : points) text += fmt::format(" ({}, {}, {})", p.x(), p.y(), p.z());
  return text;
}

/// Calls check(point source) `kCases` times for every kind of lattice; check returns the answer, and both answers have to occur.
template <class Check>
void for_random_cases(const Check& check) {
  std::map<bool, int> seen;
  for (const LatticePoints::Kind& kind : lattice_kinds()) {
    SCOPED_TRACE(kind.name);
    LatticePoints point(kind, kSeed);
    for (int i = 0; i < kCases; ++i) {
      ++seen[check(point)];
      ASSERT_FALSE(::testing::Test::HasFailure()) << "case " << i;
    }
  }
  EXPECT_GT(seen[true], 300 / kThinning) << "hardly any case meets";
  EXPECT_GT(seen[false], 300 / kThinning) << "hardly any case stays apart";
}

TEST(ExactHulls, AgreeWithCgalOnTriangles) {
  for_random_cases([](LatticePoints& point) {
    const TrianglePoints p = random_triangle(point), q = random_triangle(point);
    if (is_degenerate(p) || is_degenerate(q)) return false;
    const bool expected = cgal_triangles_meet(p, q);
    EXPECT_EQ(hulls_meet_beyond(p, q, {}), expected);
    return expected;
  });
}

TEST(TriangleIntersection, SegmentsMeetWhereTheirHullsDo) {
  for_random_cases([](LatticePoints& point) {
    const std::array<Vec3, 2> s{point(), point()}, t{point(), point()};
    const bool expected = hulls_meet_beyond(s, t, {});
    EXPECT_EQ(segments_meet(s[0], s[1], t[0], t[1]), expected);
    EXPECT_EQ(segments_meet(t[1], t[0], s[0], s[1]), expected);
    return expected;
  });
}

TEST(TriangleIntersection, SegmentMeetsTriangleWhereTheirHullsDo) {
  for_random_cases([](LatticePoints& point) {
    const std::array<Vec3, 2> s{point(), point()};
    const TrianglePoints t = random_triangle(point);
    const bool expected = hulls_meet_beyond(s, t, {});
    EXPECT_EQ(segment_meets_triangle(s[0], s[1], t), expected);
    EXPECT_EQ(segment_meets_triangle(s[1], s[0], {t[1], t[0], t[2]}), expected);
    return expected;
  });
}

TEST(TriangleIntersection, TrianglesMeetWhereTheirHullsDo) {
  for_random_cases([](LatticePoints& point) {
    const TrianglePoints p = random_triangle(point), q = random_triangle(point);
    const bool expected = hulls_meet_beyond(p, q, {});
    EXPECT_EQ(triangles_meet(p, q), expected) << describe(p) << " and" << describe(q);
    EXPECT_EQ(triangles_meet({q[2], q[1], q[0]}, {p[1], p[2], p[0]}), expected);
    return expected;
  });
}

TEST(TriangleIntersection, BeyondASharedVertexIsWhatTheHullsShareElsewhere) {
  for_random_cases([](LatticePoints& point) {
    const TrianglePoints p = random_triangle(point);
    TrianglePoints q = random_triangle(point);
    q[0] = p[0];
    const bool expected = hulls_meet_beyond(p, q, std::span(p).first(1));
    EXPECT_EQ(triangles_meet_beyond_vertex(p, q), expected) << describe(p) << " and" << describe(q);
    EXPECT_EQ(triangles_meet_beyond_vertex({q[0], q[2], q[1]}, p), expected);
    return expected;
  });
}

TEST(TriangleIntersection, BeyondASharedEdgeIsWhatTheHullsShareElsewhere) {
  for_random_cases([](LatticePoints& point) {
    const TrianglePoints p = random_triangle(point);
    TrianglePoints q = random_triangle(point);
    q[0] = p[0];
    q[1] = p[1];
    const bool expected = hulls_meet_beyond(p, q, std::span(p).first(2));
    EXPECT_EQ(triangles_meet_beyond_edge(p, q), expected) << describe(p) << " and" << describe(q);
    EXPECT_EQ(triangles_meet_beyond_edge({q[1], q[0], q[2]}, {p[1], p[0], p[2]}), expected);
    return expected;
  });
}

/// Two triangles with random vertex numbers out of a small pool, so that they share none, one, two or all three, in any order. Vertices
/// with different numbers may stand in the same place.
TEST(TriangleIntersection, SharingIsByIndexAndNotByPlace) {
  for_random_cases([](LatticePoints& point) {
    std::array<std::uint32_t, 6> pool{0, 1, 2, 3, 4, 5};
    std::array<Vec3, 6> places;
    for (Vec3& p : places) p = point();
    std::array<std::array<std::uint32_t, 3>, 2> ids;
    std::array<TrianglePoints, 2> triangles;
    for (std::size_t k = 0; k < 2; ++k) {
      std::shuffle(pool.begin(), pool.end(), point.random());
      for (std::size_t i = 0; i < 3; ++i) {
        ids[k][i] = pool[i];
        triangles[k][i] = places[pool[i]];
      }
    }
    std::vector<Vec3> shared;
    for (const std::uint32_t id : ids[0])
      if (std::find(ids[1].begin(), ids[1].end(), id) != ids[1].end()) shared.push_back(places[id]);
    const bool expected = shared.size() == 3 || hulls_meet_beyond(triangles[0], triangles[1], shared);
    EXPECT_EQ(triangles_meet_beyond_shared(triangles[0], ids[0], triangles[1], ids[1]), expected)
        << shared.size() << " shared:" << describe(triangles[0]) << " and" << describe(triangles[1]);
    return expected;
  });
}

TEST(TriangleIntersection, StrictlyInsideATetrahedronOfEitherOrientation) {
  for_random_cases([](LatticePoints& point) {
    std::array<Vec3, 4> t;
    for (Vec3& p : t) p = point();
    // Near the middle, so that the inside is not rare.
    const Vec3 p = point.random()() % 2 == 0 ? point() : Vec3(0.25 * (t[0] + t[1] + t[2] + t[3]));
    const int volume = rational_orient3d(t[0], t[1], t[2], t[3]);
    const bool expected = volume != 0 && rational_orient3d(p, t[1], t[2], t[3]) == volume &&
                          rational_orient3d(t[0], p, t[2], t[3]) == volume && rational_orient3d(t[0], t[1], p, t[3]) == volume &&
                          rational_orient3d(t[0], t[1], t[2], p) == volume;
    EXPECT_EQ(strictly_inside_tetrahedron(p, t[0], t[1], t[2], t[3]), expected);
    EXPECT_EQ(strictly_inside_tetrahedron(p, t[1], t[0], t[2], t[3]), expected);
    return expected;
  });
}

TEST(TriangleIntersection, StartingAtTurnsWithoutReversing) {
  const TrianglePoints t{Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0)};
  for (int first = 0; first < 3; ++first) {
    const TrianglePoints turned = starting_at(t, first);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(turned[i], t[(first + i) % 3]);
  }
}

const TrianglePoints kFlat{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

TEST(TriangleIntersection, ContactOfEveryKindCounts) {
  EXPECT_TRUE(triangles_meet(kFlat, {Vec3(1, 1, 0), Vec3(1, 1, 3), Vec3(2, 1, 3)})) << "a corner on the inside";
  EXPECT_TRUE(triangles_meet(kFlat, {Vec3(2, 2, 0), Vec3(3, 3, 3), Vec3(4, 2, 3)})) << "a corner on an edge";
  EXPECT_TRUE(triangles_meet(kFlat, {Vec3(4, 0, 0), Vec3(5, 0, 3), Vec3(6, 1, 3)})) << "corner on corner";
  EXPECT_TRUE(triangles_meet(kFlat, {Vec3(3, 1, 1), Vec3(1, 3, -1), Vec3(9, 9, 0)})) << "edge across edge";
  EXPECT_TRUE(triangles_meet(kFlat, {Vec3(1, 1, 0), Vec3(1.5, 1, 0), Vec3(1, 1.5, 0)})) << "coplanar, inside";
  EXPECT_TRUE(triangles_meet(kFlat, {Vec3(4, 0, 0), Vec3(8, 0, 0), Vec3(4, -4, 0)})) << "coplanar, corner on corner";
  EXPECT_TRUE(triangles_meet(kFlat, kFlat));
}

TEST(TriangleIntersection, AGapOfOneRoundingIsAGap) {
  const double above = std::nextafter(0.0, 1.0);
  EXPECT_FALSE(triangles_meet(kFlat, {Vec3(1, 1, above), Vec3(1, 1, 3), Vec3(2, 1, 3)}));
  const double beyond = std::nextafter(4.0, 5.0);
  EXPECT_FALSE(triangles_meet(kFlat, {Vec3(beyond, 0, 0), Vec3(5, 0, 3), Vec3(6, 1, 3)}));
  EXPECT_FALSE(triangles_meet(kFlat, {Vec3(beyond, 0, 0), Vec3(8, 0, 0), Vec3(8, 4, 0)})) << "coplanar";
}

TEST(TriangleIntersection, NeighboursInOnePlaneMeetOnlyWhereTheyFoldOver) {
  EXPECT_FALSE(triangles_meet_beyond_edge(kFlat, {kFlat[0], kFlat[1], Vec3(1, -1, 0)}));
  EXPECT_TRUE(triangles_meet_beyond_edge(kFlat, {kFlat[0], kFlat[1], Vec3(1, 5, 0)}));
  EXPECT_FALSE(triangles_meet_beyond_edge(kFlat, {kFlat[0], kFlat[1], Vec3(1, 5, 1e-300)}));
  EXPECT_FALSE(triangles_meet_beyond_vertex(kFlat, {kFlat[0], Vec3(-1, 0, 0), Vec3(0, -1, 0)}));
  EXPECT_TRUE(triangles_meet_beyond_vertex(kFlat, {kFlat[0], Vec3(1, 0, 0), Vec3(0, -1, 0)})) << "along an edge";
}

}  // namespace
}  // namespace smopt
