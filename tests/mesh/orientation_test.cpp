#include "smopt/mesh/orientation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numbers>
#include <regex>

#include "smopt/error.h"
#include "tests/mesh/meshes.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;
using ::testing::DoubleNear;
using ::testing::ElementsAre;

/// The corners in cyclic order from the smallest, so that a triangle is known again however it is turned.
Triangle from_smallest(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

std::size_t count_turned(const TriangleMesh& before, const TriangleMesh& after) {
  std::size_t turned = 0;
  for (std::size_t f = 0; f < before.triangle_count(); ++f)
    turned += static_cast<std::size_t>(from_smallest(before.triangles[f]) != from_smallest(after.triangles[f]));
  return turned;
}

TEST(Orientation, WhatAgreesIsLeftAlone) {
  for (const TriangleMesh& mesh : {cube(), reversed(icosphere(2)), joined(cube(), reversed(tetrahedron())), torus(3, 1, 9, 5)}) {
    TriangleMesh oriented = mesh;
    EXPECT_EQ(orient_consistently(oriented), 0U);
    EXPECT_EQ(oriented.triangles, mesh.triangles);
  }
}

TEST(Orientation, RandomlyFlippedTrianglesAgreeAgain) {
  const TriangleMesh original = joined(joined(icosphere(2), torus(3, 1, 20, 9)), joined(cube(), tetrahedron()));
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const TriangleMesh flipped = relabelled(randomly_flipped(original, seed), seed);
    TriangleMesh mended = flipped;
    const std::size_t turned = orient_consistently(mended);
    EXPECT_THAT(mended, IsClosedManifold()) << "seed " << seed;
    EXPECT_EQ(turned, count_turned(flipped, mended)) << "seed " << seed;
    EXPECT_GT(turned, original.triangle_count() / 4);
  }
}

TEST(Orientation, TheFirstTriangleOfEachComponentDecides) {
  const TriangleMesh outwards = joined(cube(), translated(icosphere(2), {9, 0, 0}));
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    const TriangleMesh flipped = randomly_flipped(outwards, seed);
    TriangleMesh mended = flipped;
    orient_consistently(mended);
    EXPECT_EQ(from_smallest(mended.triangles[0]), from_smallest(flipped.triangles[0]));
    EXPECT_EQ(from_smallest(mended.triangles[12]), from_smallest(flipped.triangles[12]));
    const std::vector<double> volumes = component_volumes(mended, connected_components(mended));
    const auto faces_outwards = [&](std::size_t f) { return from_smallest(flipped.triangles[f]) == from_smallest(outwards.triangles[f]); };
    EXPECT_EQ(volumes[0] > 0, faces_outwards(0)) << "seed " << seed;
    EXPECT_EQ(volumes[1] > 0, faces_outwards(12)) << "seed " << seed;
  }
}

TEST(Orientation, OneSidedSurfacesAreRefusedAndTheEdgeIsNamed) {
  // The projective plane on six vertices: the smallest one-sided closed surface.
  const TriangleMesh projective_plane{
      std::vector<Vec3>(6, Vec3::Zero()),
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}, {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}}};
  for (TriangleMesh mesh : {closed_lattice(6, 5, true), joined(icosphere(1), closed_lattice(4, 7, true)), projective_plane}) {
    try {
      orient_consistently(mesh);
      FAIL() << "no exception";
    } catch (const InvalidMesh& error) {
      EXPECT_TRUE(std::regex_search(error.what(), std::regex("[0-9]+[^0-9]+[0-9]+"))) << error.what();
    }
  }
  TriangleMesh two_sided = closed_lattice(6, 5, false);
  EXPECT_NO_THROW(orient_consistently(two_sided));
}

TEST(Orientation, OfAnEmptyMesh) {
  TriangleMesh none;
  EXPECT_EQ(orient_consistently(none), 0U);
}

TEST(Orientation, AVertexOfTenThousandTrianglesTakesNoTime) {
  TriangleMesh mesh = relabelled(randomly_flipped(bipyramid(10000), 4), 4);
  const auto start = std::chrono::steady_clock::now();
  orient_consistently(mesh);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2)) << "quadratic in the valence";
  EXPECT_THAT(mesh, IsClosedManifold());
}

TEST(ComponentVolumes, AreThoseOfTheSolids) {
  const TriangleMesh mesh = joined(joined(cube(), reversed(translated(tetrahedron(), {5, 5, 5}))), scaled(cube(), 2));
  EXPECT_THAT(component_volumes(mesh, connected_components(mesh)),
              ElementsAre(DoubleNear(1, 1e-12), DoubleNear(-8.0 / 3, 1e-12), DoubleNear(8, 1e-12)));
}

TEST(ComponentVolumes, OfASphereTendToTheBall) {
  const TriangleMesh mesh = icosphere(5, 2);
  EXPECT_NEAR(component_volumes(mesh, connected_components(mesh))[0], 4 * std::numbers::pi / 3 * 8, 0.05);
}

TEST(ComponentVolumes, AreKeptByRigidMotionAndTurnedBySign) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.02, 1);
  const double volume = enclosed_volume(mesh);
  const TriangleMesh moved = translated(rotated(mesh, {1, 2, 3}, 1.1), {30, -20, 10});
  EXPECT_NEAR(component_volumes(moved, connected_components(moved))[0], volume, 1e-10);
  const TriangleMesh far = translated(mesh, {1e6, 1e6, 1e6});
  EXPECT_NEAR(component_volumes(far, connected_components(far))[0], volume, 1e-6) << "a million ångström from the origin";
  TriangleMesh inwards = mesh;
  reverse_orientation(inwards);
  EXPECT_NEAR(component_volumes(inwards, connected_components(inwards))[0], -volume, 1e-12);
  EXPECT_THAT(inwards, IsClosedManifold());
}

TEST(ReverseOrientation, TwiceIsNothingButATurn) {
  TriangleMesh mesh = icosphere(1);
  reverse_orientation(mesh);
  EXPECT_EQ(count_turned(icosphere(1), mesh), mesh.triangle_count());
  reverse_orientation(mesh);
  EXPECT_EQ(count_turned(icosphere(1), mesh), 0U);
}

}  // namespace
}  // namespace smopt
