#include "baselines/cgal/tangential_relaxation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/tangential_relaxation.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include "baselines/cgal/surface_conversion.h"
#include "tests/baselines/cgal/shapes.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;

TriangleMesh relaxed(TriangleMesh mesh, int rounds) {
  relax_tangentially(mesh, {rounds});
  return mesh;
}

TEST(TangentialRelaxation, MovesAVertexInAFlatSquareToItsCentre) {
  EXPECT_LT(relaxed(roofed_pyramid(0.4, -0.3), 1).points[0].norm(), 1e-15);
}

TEST(TangentialRelaxation, IsOneCallOfCgalForAllRounds) {
  using Surface = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;
  const TriangleMesh mesh = noisy(torus(3, 1, 24, 12), 0.1, 7);
  auto surface = to_surface<Surface>(mesh);
  CGAL::Polygon_mesh_processing::tangential_relaxation(surface.vertices(), surface, CGAL::parameters::number_of_iterations(6));
  EXPECT_EQ(relaxed(mesh, 6).points, from_surface(surface).points);
}

TEST(TangentialRelaxation, LeavesTheTriangles) {
  const TriangleMesh mesh = noisy(icosphere(2), 0.05, 7);
  EXPECT_EQ(relaxed(mesh, 6).triangles, mesh.triangles);
}

TEST(TangentialRelaxation, ReportsEveryRound) {
  std::vector<double> fractions;
  TriangleMesh mesh = icosphere(1);
  relax_tangentially(mesh, {4}, [&](std::string_view, double fraction) {
    fractions.push_back(fraction);
    return true;
  });
  EXPECT_EQ(fractions, (std::vector<double>{0, 0.25, 0.5, 0.75}));
}

TEST(TangentialMethod, PassesItsOptionOn) {
  const Method method = tangential_method();
  TriangleMesh by_default = noisy(icosphere(2), 0.05, 7), three = by_default;
  method.run(by_default, OptionValues(method.options, {}), {});
  method.run(three, OptionValues(method.options, {{"rounds", "3"}}), {});
  EXPECT_EQ(by_default.points, relaxed(noisy(icosphere(2), 0.05, 7), 10).points);
  EXPECT_EQ(three.points, relaxed(noisy(icosphere(2), 0.05, 7), 3).points);
}

}  // namespace
}  // namespace smopt::baselines
