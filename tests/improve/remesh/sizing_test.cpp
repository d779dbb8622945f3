#include "smopt/improve/remesh/sizing.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/improve/hard_shapes.h"
#include "tests/improve/remesh/shape_judge.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;

std::vector<double> sizes_of(const TriangleMesh& mesh, const RemeshOptions& options = {}) {
  return find_sizes(mesh, build_rings(mesh).value(), options).edges;
}

RemeshOptions with(Sizing sizing, std::size_t vertices = 0) {
  RemeshOptions options;
  options.sizing = sizing;
  options.vertices = vertices;
  return options;
}

double smallest(const std::vector<double>& sizes) {
  return *std::min_element(sizes.begin(), sizes.end());
}

double largest(const std::vector<double>& sizes) {
  return *std::max_element(sizes.begin(), sizes.end());
}

/// How many equilateral triangles of these sizes the surface would have.
double equilateral_triangles(const TriangleMesh& mesh, const std::vector<double>& sizes) {
  double count = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const double area = 0.5 * (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm();
    const double size = (sizes[a] + sizes[b] + sizes[c]) / 3;
    count += area / (std::sqrt(3) / 4 * size * size);
  }
  return count;
}

TEST(Sizing, ByDensityIsTheEdgeLengthOfARegularMesh) {
  const TriangleMesh mesh = icosphere(4);
  const double edge = mean_edge_length(mesh);
  const std::vector<double> sizes = sizes_of(mesh);
  ASSERT_EQ(sizes.size(), mesh.vertex_count());
  EXPECT_GT(smallest(sizes), 0.85 * edge);
  EXPECT_LT(largest(sizes), 1.15 * edge);
}

/// Remeshing leaves edges between 0.75 and 1.4 of their size alone, and ends with some more triangles than equilateral ones would be: up to a
/// tenth less is asked for than wanted.
void expect_asks_for(double triangles, double wanted) {
  EXPECT_LT(triangles, 1.01 * wanted);
  EXPECT_GT(triangles, 0.9 * wanted);
}

TEST(Sizing, ByDensityAsksForAsManyTrianglesAsThereAre) {
  for (const TriangleMesh& mesh : {icosphere(3), noisy(torus(3, 1, 60, 20), 0.03, 1), noisy(icosphere(3), 0.03, 2)})
    expect_asks_for(equilateral_triangles(mesh, sizes_of(mesh)), static_cast<double>(mesh.triangle_count()));
}

TEST(Sizing, ByDensityFollowsTheInput) {
  const TriangleMesh mesh = joined(icosphere(4), translated(icosphere(2), {3, 0, 0}));
  const std::vector<double> sizes = sizes_of(mesh);
  const std::size_t first = icosphere(4).vertex_count();
  EXPECT_NEAR(sizes[first + 5] / sizes[5], 4, 0.5);
}

TEST(Sizing, UniformIsAboutWhatIsAskedForAndTheSameEverywhere) {
  RemeshOptions options = with(Sizing::uniform);
  options.edge_length = 0.123;
  const std::vector<double> sizes = sizes_of(noisy(torus(3, 1, 60, 20), 0.03, 1), options);
  EXPECT_NEAR(sizes[0] / 0.123, 1, 0.05) << "but for the surplus above";
  for (const double size : sizes) EXPECT_DOUBLE_EQ(size, sizes[0]);
}

TEST(Sizing, OfANumberOfVerticesAsksForAsManyTriangles) {
  for (const TriangleMesh& mesh : {icosphere(3), torus(3, 1, 60, 20)}) {
    for (const Sizing sizing : {Sizing::density, Sizing::uniform, Sizing::curvature}) {
      for (const std::size_t vertices : {std::size_t{200}, mesh.vertex_count(), 4 * mesh.vertex_count()}) {
        expect_asks_for(equilateral_triangles(mesh, sizes_of(mesh, with(sizing, vertices))), 2 * static_cast<double>(vertices));
      }
    }
  }
}

TEST(Sizing, SaysHowManyVerticesTheSizesTake) {
  const TriangleMesh mesh = noisy(icosphere(4), 0.01, 2);
  const VertexRings rings = build_rings(mesh).value();
  EXPECT_NEAR(find_sizes(mesh, rings, {}).vertices, static_cast<double>(mesh.vertex_count()), 5);
  EXPECT_NEAR(find_sizes(mesh, rings, with(Sizing::curvature, 1234)).vertices, 1234, 5);
  RemeshOptions options = with(Sizing::uniform);
  options.edge_length = 0.1;
  const double triangle = std::sqrt(3) / 4 * 0.1 * 0.1;
  EXPECT_NEAR(find_sizes(mesh, rings, options).vertices / (0.5 * surface_area(mesh) / triangle), 1, 0.1);
}

TEST(Sizing, ByCurvatureIsTheChordsLengthOnASphere) {
  for (const double radius : {1.0, 3.0}) {
    RemeshOptions options = with(Sizing::curvature);
    options.chord_error = 0.004 * radius;
    const double expected = std::sqrt(6 * options.chord_error * radius - 3 * options.chord_error * options.chord_error);
    const std::vector<double> sizes = sizes_of(icosphere(4, radius), options);
    EXPECT_NEAR(smallest(sizes) / expected, 1, 0.1);
    EXPECT_NEAR(largest(sizes) / expected, 1, 0.1);
  }
}

TEST(Sizing, ByCurvatureIsSmallerWhereTheSurfaceIsCurvedMore) {
  const TriangleMesh mesh = torus(3, 0.5, 120, 30);
  RemeshOptions options = with(Sizing::curvature);
  options.chord_error = 0.01;
  const TriangleMesh thick = torus(3, 1.5, 120, 60);
  EXPECT_LT(smallest(sizes_of(mesh, options)), 0.8 * smallest(sizes_of(thick, options)));
}

TEST(Sizing, ByCurvatureStaysBetweenAQuarterAndFourTimesTheMeanDensity) {
  const TriangleMesh mesh = noisy(icosphere(4), 0.01, 1);
  const double mean = std::sqrt(surface_area(mesh) / static_cast<double>(mesh.triangle_count()) * 4 / std::sqrt(3));
  for (const double error : {1e-9, 10.0}) {
    RemeshOptions options = with(Sizing::curvature);
    options.chord_error = error;
    const std::vector<double> sizes = sizes_of(mesh, options);
    EXPECT_GT(smallest(sizes), 0.25 * mean * 0.9);
    EXPECT_LT(largest(sizes), 4 * mean * 1.1);
  }
}

TEST(Sizing, GrowsByNoMoreThanThreeTenthsOfTheDistance) {
  TriangleMesh mesh = icosphere(4);
  for (Vec3& p : mesh.points) p.z() *= 4;
  RemeshOptions options = with(Sizing::curvature);
  options.chord_error = 0.005;
  const std::vector<double> sizes = sizes_of(mesh, options);
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const VertexId v = t[i], w = t[(i + 1) % 3];
      EXPECT_LE(std::abs(sizes[v] - sizes[w]), 0.31 * (mesh.points[v] - mesh.points[w]).norm());
    }
}

TEST(Sizing, IsZeroForAVertexWithoutTriangles) {
  TriangleMesh mesh = icosphere(2);
  mesh.points.emplace_back(5, 5, 5);
  for (const Sizing sizing : {Sizing::density, Sizing::curvature}) {
    const std::vector<double> sizes = sizes_of(mesh, with(sizing));
    ASSERT_EQ(sizes.size(), mesh.vertex_count());
    EXPECT_EQ(sizes.back(), 0);
    EXPECT_GT(smallest({sizes.begin(), sizes.end() - 1}), 0);
  }
}

TEST(Sizing, GrowsWithTheMesh) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.02, 1);
  const std::vector<double> sizes = sizes_of(mesh), doubled = sizes_of(scaled(mesh, 2));
  for (std::size_t v = 0; v < sizes.size(); ++v) EXPECT_NEAR(doubled[v], 2 * sizes[v], 1e-9);
}

}  // namespace
}  // namespace smopt
