#include "metrics/solvation/charges_outside.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

#include "smopt/surface/gaussian_surface.h"
#include "tests/support/molecules.h"
#include "tests/support/shapes.h"
#include "tests/support/threads.h"

namespace smopt::testing {
namespace {

using metrics::count_charges_outside;

/// Charges of either sign at these places.
Molecule charges_at(const std::vector<Vec3>& places) {
  Molecule molecule = molecule_of(places, std::vector<double>(places.size(), 1.0));
  for (std::size_t i = 0; i < places.size(); ++i) molecule.charges[i] = i % 2 == 0 ? 0.5 : -0.25;
  return molecule;
}

bool is_outside(const TriangleMesh& surface, const Vec3& place) {
  return count_charges_outside(surface, charges_at({place})) == 1;
}

/// Charges at random places in the cube [-half, half]³.
Molecule random_charges(std::size_t count, double half, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-half, half);
  std::vector<Vec3> places(count);
  for (Vec3& p : places) p = {coordinate(random), coordinate(random), coordinate(random)};
  return charges_at(places);
}

/// How often the surface winds around a point: the sum of the triangles' solid angles (Van Oosterom & Strackee 1983) over 4π.
double winding_number(const TriangleMesh& mesh, const Vec3& p) {
  double sum = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a = mesh.points[i] - p, b = mesh.points[j] - p, c = mesh.points[k] - p;
    const double denominator = a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() + b.dot(c) * a.norm() + c.dot(a) * b.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), denominator);
  }
  return sum / (4 * std::numbers::pi);
}

std::size_t count_by_winding(const TriangleMesh& mesh, const Molecule& molecule) {
  std::size_t outside = 0;
  for (const Vec3& p : molecule.centers) outside += std::lround(std::abs(winding_number(mesh, p))) % 2 == 0 ? 1 : 0;
  return outside;
}

TEST(ChargesOutside, ASphereEnclosesWhatIsInIt) {
  const TriangleMesh sphere = icosphere(3, 2.0, {1, 2, 3});
  EXPECT_FALSE(is_outside(sphere, {1, 2, 3}));
  EXPECT_FALSE(is_outside(sphere, {1, 2, 4.9}));
  EXPECT_TRUE(is_outside(sphere, {1, 2, 5.1}));
  EXPECT_TRUE(is_outside(sphere, {1, 2, 0.9}));
  EXPECT_TRUE(is_outside(sphere, {3.1, 2, 3}));
  EXPECT_TRUE(is_outside(sphere, {1e6, 0, 0}));
}

TEST(ChargesOutside, EveryComponentEncloses) {
  const TriangleMesh spheres = joined(icosphere(2), translated(icosphere(2), {0, 0, 3}));
  EXPECT_EQ(count_charges_outside(spheres, charges_at({{0, 0, 0}, {0, 0, 3}, {0.1, 0.2, -0.3}})), 0U);
  EXPECT_EQ(count_charges_outside(spheres, charges_at({{0, 0, 1.5}, {0, 0, -2}, {0, 0, 5}, {0, 0, 3}})), 3U);
}

TEST(ChargesOutside, ACavityIsOutsideAndAnIslandInItIsNot) {
  const TriangleMesh hollow = joined(icosphere(3, 3.0), reversed(icosphere(3, 2.0)));
  EXPECT_TRUE(is_outside(hollow, {0, 0, 0}));
  EXPECT_FALSE(is_outside(hollow, {0, 0, 2.5}));
  EXPECT_FALSE(is_outside(hollow, {0, 0, -2.5}));
  EXPECT_FALSE(is_outside(joined(hollow, icosphere(2, 0.5)), {0, 0, 0}));
}

TEST(ChargesOutside, OnTheSurfaceIsOutside) {
  const TriangleMesh box = cube();
  for (const Vec3& corner : box.points) EXPECT_TRUE(is_outside(box, corner));
  EXPECT_TRUE(is_outside(box, {0.5, 0.5, 1})) << "on the diagonal of the lid";
  EXPECT_TRUE(is_outside(box, {0.25, 0.125, 0})) << "in a triangle of the floor";
  EXPECT_TRUE(is_outside(box, {0, 0.25, 0.125})) << "in an upright triangle";
  EXPECT_TRUE(is_outside(box, {1, 0, 0.375})) << "on an upright edge";
}

TEST(ChargesOutside, ARayThroughEdgesAndVerticesCountsRight) {
  const TriangleMesh box = cube();
  EXPECT_FALSE(is_outside(box, {0.5, 0.5, 0.5})) << "the ray meets a diagonal";
  for (const Vec3& corner : box.points) EXPECT_TRUE(is_outside(box, corner - Vec3(0, 0, 2))) << "along an upright edge";
  EXPECT_TRUE(is_outside(box, {0, 0.25, -1})) << "in the plane of a wall";
  EXPECT_TRUE(is_outside(box, {1, 0.25, -1})) << "in the plane of a wall";
  EXPECT_TRUE(is_outside(box, {0.5, 0.5, -1}));
  for (const TriangleMesh& ball : {icosphere(2), tetrahedron()})
    for (const Vec3& vertex : ball.points) {
      EXPECT_FALSE(is_outside(ball, {vertex.x() / 2, vertex.y() / 2, vertex.z() / 2}));
      EXPECT_TRUE(is_outside(ball, {vertex.x(), vertex.y(), -3})) << "below a vertex";
    }
}

TEST(ChargesOutside, ARayThroughOneEdgeOrVertexOnlyCountsRight) {
  const TriangleMesh octahedron = {{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                                   {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}}};
  for (const Vec3& aside : {Vec3(0, 0, 0), Vec3(0.5, 0, 0), Vec3(-0.5, 0, 0), Vec3(0, 0.5, 0), Vec3(0, -0.5, 0)}) {
    EXPECT_FALSE(is_outside(octahedron, aside)) << aside.transpose();
    EXPECT_TRUE(is_outside(octahedron, aside + Vec3(0, 0, 2))) << aside.transpose();
    EXPECT_TRUE(is_outside(octahedron, aside - Vec3(0, 0, 2))) << aside.transpose();
  }
}

TEST(ChargesOutside, ChargesOfZeroAreNotCounted) {
  Molecule molecule = charges_at({{5, 0, 0}, {6, 0, 0}, {7, 0, 0}});
  EXPECT_EQ(count_charges_outside(icosphere(1), molecule), 3U);
  molecule.charges = {0, 1e-300, -0.0};
  EXPECT_EQ(count_charges_outside(icosphere(1), molecule), 1U);
  EXPECT_EQ(count_charges_outside(icosphere(1), Molecule{}), 0U);
}

TEST(ChargesOutside, OrientationAndOrderDoNotMatter) {
  const TriangleMesh mesh = torus(2, 0.7, 24, 12);
  const Molecule molecule = random_charges(500, 2.8, 3);
  const std::size_t outside = count_charges_outside(mesh, molecule);
  EXPECT_EQ(outside, count_by_winding(mesh, molecule));
  EXPECT_EQ(count_charges_outside(reversed(mesh), molecule), outside);
  EXPECT_EQ(count_charges_outside(relabelled(mesh, 5), molecule), outside);
  TriangleMesh mixed = mesh;
  for (std::size_t f = 0; f < mixed.triangle_count(); f += 3) std::swap(mixed.triangles[f][0], mixed.triangles[f][1]);
  EXPECT_EQ(count_charges_outside(mixed, molecule), outside);
}

TEST(ChargesOutside, AgreesWithTheWindingNumberOfAMoleculesSurface) {
  const Molecule atoms = random_cluster(60, 11);
  GaussianSurfaceOptions options;
  options.spacing = 1.0;
  const TriangleMesh mesh = gaussian_surface(atoms, options);
  double half = 0;
  for (const Vec3& p : mesh.points) half = std::max(half, p.cwiseAbs().maxCoeff());
  const Molecule charges = random_charges(400, half, 12);
  const std::size_t outside = count_charges_outside(mesh, charges);
  EXPECT_EQ(outside, count_by_winding(mesh, charges));
  EXPECT_THAT(outside, ::testing::AllOf(::testing::Gt(20U), ::testing::Lt(395U))) << "the test should have both";
}

TEST(ChargesOutside, SurfacesThatIntersectThemselvesHaveAParity) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const TriangleMesh mesh = noisy(icosphere(3), 0.4, seed);
    const Molecule charges = random_charges(400, 1.3, seed + 10);
    EXPECT_EQ(count_charges_outside(mesh, charges), count_by_winding(mesh, charges)) << "seed " << seed;
  }
}

TEST(ChargesOutside, TrianglesWithoutAreaAndDuplicatePointsDoNoHarm) {
  TriangleMesh mesh = icosphere(2);
  const std::size_t faces = mesh.triangle_count();
  for (std::size_t f = 0; f < faces; ++f) {  // each triangle beside a copy of one of its points, with two flat ones between
    const auto [a, b, c] = mesh.triangles[f];
    const auto copy = static_cast<VertexId>(mesh.points.size());
    mesh.points.push_back(mesh.points[a]);
    mesh.triangles[f] = {copy, b, c};
    mesh.triangles.insert(mesh.triangles.end(), {{a, b, copy}, {copy, c, a}});
  }
  mesh.points.emplace_back(0, 0, 0.5);
  const auto middle = static_cast<VertexId>(mesh.points.size() - 1);
  mesh.triangles.push_back({middle, middle, middle});
  const Molecule charges = random_charges(500, 1.1, 9);
  EXPECT_EQ(count_charges_outside(mesh, charges), count_charges_outside(icosphere(2), charges));
  EXPECT_FALSE(is_outside(mesh, {0, 0, 0.25}));
  EXPECT_TRUE(is_outside(mesh, {0, 0, 0.5})) << "on a triangle that is a point";
}

TEST(ChargesOutside, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = noisy(icosphere(4), 0.05, 2);
  const Molecule charges = random_charges(3000, 1.1, 4);
  expect_same_for_any_threads([&] { return count_charges_outside(mesh, charges); });
}

}  // namespace
}  // namespace smopt::testing
