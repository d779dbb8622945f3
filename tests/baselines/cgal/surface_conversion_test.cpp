#include "baselines/cgal/surface_conversion.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <gmock/gmock.h>

#include <limits>

#include "smopt/error.h"
#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;
using Surface = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

/// The message of the InvalidMesh, or nothing.
std::string refusal(const TriangleMesh& mesh, Borders borders) {
  try {
    require_surface(mesh, borders);
  } catch (const InvalidMesh& error) {
    return error.what();
  }
  return {};
}

TriangleMesh opened(TriangleMesh mesh) {
  mesh.triangles.pop_back();
  return mesh;
}

TEST(SurfaceConversion, ComesBackWithTheSamePositionsAndTriangles) {
  for (const TriangleMesh& mesh :
       {relabelled(noisy(torus(2, 0.7, 16, 8), 0.1, 1), 5), joined(icosphere(2), tetrahedron()), opened(cube())}) {
    const TriangleMesh back = from_surface(to_surface<Surface>(mesh));
    EXPECT_EQ(back.points, mesh.points);
    EXPECT_EQ(back.triangles, mesh.triangles);
  }
}

TEST(SurfaceConversion, KeepsVerticesWithoutTriangles) {
  TriangleMesh mesh = tetrahedron();
  mesh.points.insert(mesh.points.begin(), Vec3(7, 8, 9));
  for (Triangle& t : mesh.triangles) t = {t[0] + 1, t[1] + 1, t[2] + 1};
  EXPECT_EQ(from_surface(to_surface<Surface>(mesh)).points, mesh.points);
}

TEST(SurfaceConversion, GivesCgalAValidSurface) {
  const auto surface = to_surface<Surface>(torus(2, 0.7, 16, 8));
  EXPECT_TRUE(surface.is_valid());
  EXPECT_TRUE(CGAL::is_closed(surface));
  EXPECT_EQ(surface.number_of_edges(), 3U * 16 * 8);
}

TEST(SurfaceConversion, RefusesWhatIsNoSurfaceAndSaysWhy) {
  EXPECT_EQ(refusal(icosphere(1), Borders::rejected), "");

  EXPECT_EQ(refusal(opened(cube()), Borders::allowed), "");
  EXPECT_THAT(refusal(opened(cube()), Borders::rejected), ::testing::HasSubstr("boundary edges"));

  TriangleMesh turned = cube();
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  EXPECT_THAT(refusal(turned, Borders::allowed), ::testing::HasSubstr("inconsistent orientation"));

  TriangleMesh three_at_an_edge = tetrahedron();
  three_at_an_edge.points.emplace_back(0, 0, 5);
  three_at_an_edge.triangles.push_back({0, 1, 4});
  EXPECT_THAT(refusal(three_at_an_edge, Borders::allowed), ::testing::HasSubstr("non-manifold edges"));

  TriangleMesh pinched = joined(tetrahedron(), translated(tetrahedron(), Vec3(5, 0, 0)));
  for (Triangle& t : pinched.triangles)
    for (VertexId& v : t) v = v == 4 ? 0 : v;
  EXPECT_THAT(refusal(pinched, Borders::allowed), ::testing::HasSubstr("non-manifold vertices"));

  TriangleMesh infinite = cube();
  infinite.points[2].y() = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(infinite, Borders::allowed), ::testing::HasSubstr("not finite"));

  TriangleMesh cornered = cube();
  cornered.triangles[0] = {1, 1, 2};
  EXPECT_THAT(refusal(cornered, Borders::allowed), ::testing::HasSubstr("repeated corner"));

  EXPECT_THAT(refusal({}, Borders::allowed), ::testing::HasSubstr("no triangles"));
}

}  // namespace
}  // namespace smopt::baselines
