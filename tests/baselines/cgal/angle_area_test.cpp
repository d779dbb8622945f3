#include "baselines/cgal/angle_area_smoothing.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "baselines/cgal/angle_method.h"
#include "baselines/cgal/area_method.h"
#include "smopt/error.h"
#include "tests/baselines/cgal/shapes.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TriangleMesh smoothed(TriangleMesh mesh, const AngleAreaOptions& options) {
  smooth_angles_and_areas(mesh, options);
  return mesh;
}

AngleAreaOptions angles(int rounds, bool projects) {
  AngleAreaOptions options;
  options.rounds = rounds;
  options.projects = projects;
  return options;
}

double smallest_angle(const TriangleMesh& mesh) {
  double smallest = std::numbers::pi;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]], q = mesh.points[t[(k + 2) % 3]] - mesh.points[t[k]];
      smallest = std::min(smallest, std::atan2(p.cross(q).norm(), p.dot(q)));
    }
  }
  return smallest;
}

/// A torus whose rings are drawn towards one side, so that its triangles are long and thin there.
TriangleMesh uneven_torus() {
  TriangleMesh mesh = torus(3, 1, 30, 15);
  for (int i = 0; i < 30; ++i) {
    const double u = 2 * std::numbers::pi * i / 30;
    for (int j = 0; j < 15; ++j) {
      const Vec3 p = mesh.points[static_cast<std::size_t>(i * 15 + j)];
      mesh.points[static_cast<std::size_t>(i * 15 + j)] = Eigen::AngleAxisd(0.8 * std::sin(u), Vec3::UnitZ()) * p;
    }
  }
  return mesh;
}

TEST(AngleSmoothing, StepOfAVertexInAFlatSquareByHand) {
  // At each corner the neighbours on either side are a right angle apart, so the weights are the same, and the bisector is the diagonal: the
  // vertex wants to be on it, as far from the corner as it is. It goes to the mean of the four places.
  const double x = 0.2, y = 0.1;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& corner : {Vec3(1, 1, 0), Vec3(-1, 1, 0), Vec3(-1, -1, 0), Vec3(1, -1, 0)})
    mean += (corner - (corner - Vec3(x, y, 0)).norm() * corner.normalized()) / 4;
  const TriangleMesh after = smoothed(roofed_pyramid(x, y), angles(1, false));
  EXPECT_LT((after.points[0] - mean).norm(), 1e-12);
}

TEST(AngleSmoothing, LeavesTheTrianglesAndRaisesTheSmallestAngle) {
  const TriangleMesh mesh = uneven_torus();
  for (const bool projects : {true, false}) {
    const TriangleMesh after = smoothed(mesh, angles(10, projects));
    EXPECT_EQ(after.triangles, mesh.triangles);
    EXPECT_GT(smallest_angle(after), 1.1 * smallest_angle(mesh));
  }
}

TEST(AngleSmoothing, ProjectsOntoTheInitialSurface) {
  // A box of flat sides: a point is on it when one coordinate is at its bound and the others are within.
  TriangleMesh mesh = cube();
  mesh.points.emplace_back(0.3, 0.4, 1);  // in a side's triangle, which becomes three
  const auto above = std::find_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    const auto holds = [&](VertexId v, VertexId w) {
      return (mesh.points[w] - mesh.points[v]).cross(mesh.points[8] - mesh.points[v]).z() > 0;
    };
    return mesh.points[t[0]].z() + mesh.points[t[1]].z() + mesh.points[t[2]].z() == 3 && holds(t[0], t[1]) && holds(t[1], t[2]) &&
           holds(t[2], t[0]);
  });
  ASSERT_NE(above, mesh.triangles.end());
  const auto [a, b, c] = *above;
  *above = {a, b, 8};
  mesh.triangles.push_back({b, c, 8});
  mesh.triangles.push_back({c, a, 8});
  ASSERT_THAT(mesh, IsClosedManifold());
  const auto off_box = [](const TriangleMesh& m) {
    double off = 0;
    for (const Vec3& p : m.points) off = std::max(off, std::abs((p - Vec3(0.5, 0.5, 0.5)).cwiseAbs().maxCoeff() - 0.5));
    return off;
  };
  EXPECT_LT(off_box(smoothed(mesh, angles(5, true))), 1e-12);
  EXPECT_GT(off_box(smoothed(mesh, angles(5, false))), 1e-3);
}

TEST(AngleSmoothing, OneCallIsNotOneCallARoundAsItProjectsToWhereItBegan) {
  const auto one_by_one = [](bool projects) {
    TriangleMesh mesh = uneven_torus();
    for (int round = 0; round < 4; ++round) mesh = smoothed(mesh, angles(1, projects));
    return mesh.points;
  };
  EXPECT_EQ(one_by_one(false), smoothed(uneven_torus(), angles(4, false)).points);
  EXPECT_NE(one_by_one(true), smoothed(uneven_torus(), angles(4, true)).points);
}

TEST(AngleSmoothing, SafetyRefusesSomeMovesAndNotAll) {
  AngleAreaOptions options = angles(1, false);
  const TriangleMesh mesh = noisy(icosphere(3), 0.02, 3);
  const auto unmoved = [&] {
    const TriangleMesh after = smoothed(mesh, options);
    std::size_t count = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) count += after.points[v] == mesh.points[v] ? 1 : 0;
    return count;
  };
  EXPECT_EQ(unmoved(), 0U);
  options.has_safety_constraints = true;
  EXPECT_GT(unmoved(), 0U);
  EXPECT_LT(unmoved(), mesh.points.size());
}

TEST(AngleSmoothing, SaysWhenCgalStopsAtASelfIntersection) {
  const TriangleMesh overlapping = joined(icosphere(2), translated(icosphere(2), Vec3(0.5, 0.1, 0.2)));
  AngleAreaOptions options = angles(3, true);
  options.has_safety_constraints = true;
  TriangleMesh mesh = overlapping;
  AngleAreaReport report = smooth_angles_and_areas(mesh, options);
  EXPECT_TRUE(report.met_itself);
  EXPECT_EQ(report.complete_rounds, 0);

  mesh = icosphere(2);  // does not intersect itself
  report = smooth_angles_and_areas(mesh, options);
  EXPECT_FALSE(report.met_itself);
  EXPECT_EQ(report.complete_rounds, 3);

  mesh = overlapping;
  report = smooth_angles_and_areas(mesh, angles(3, true));
  EXPECT_FALSE(report.met_itself);
  EXPECT_EQ(report.complete_rounds, 3);
}

TEST(AngleSmoothing, TheMethodReportsWhereCgalStopped) {
  TriangleMesh mesh = joined(icosphere(2), translated(icosphere(2), Vec3(0.5, 0.1, 0.2)));
  const Method method = angle_method();
  const MethodReport report = method.run(mesh, OptionValues(method.options, {{"safety", "on"}, {"rounds", "3"}}), {});
  EXPECT_EQ(report.stopped_because, "self-intersection in round 1");
  EXPECT_EQ(report.rounds_run, 0U);
  EXPECT_THAT(report.notes, ::testing::Contains(HasSubstr("round 1 of 3")));
}

TEST(AngleSmoothing, NamesATriangleWithoutArea) {
  TriangleMesh mesh = tetrahedron();
  mesh.points[2] = (mesh.points[0] + mesh.points[1]) / 2;
  EXPECT_THAT([&] { smooth_angles_and_areas(mesh, {}); }, ThrowsMessage<MethodFailed>(HasSubstr("face ")));
}

TEST(AngleSmoothing, ReportsProgressThatEndsNearOne) {
  double last = 0;
  TriangleMesh mesh = icosphere(4);
  smooth_angles_and_areas(mesh, angles(4, true), [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return true;
  });
  EXPECT_GT(last, 0.8);
}

TEST(AngleMethod, PassesItsOptionsOn) {
  const Method method = angle_method();
  const auto by_method = [&](const std::map<std::string, std::string>& given) {
    TriangleMesh mesh = uneven_torus();
    method.run(mesh, OptionValues(method.options, given), {});
    return mesh.points;
  };
  EXPECT_EQ(by_method({}), smoothed(uneven_torus(), {}).points);
  EXPECT_EQ(by_method({{"rounds", "2"}, {"project", "off"}}), smoothed(uneven_torus(), angles(2, false)).points);
  AngleAreaOptions safe = angles(2, false);
  safe.has_safety_constraints = true;
  EXPECT_EQ(by_method({{"rounds", "2"}, {"project", "off"}, {"safety", "on"}}), smoothed(uneven_torus(), safe).points);
}

TEST(AreaMethod, SaysThatItIsNotBuiltWhereCeresIsMissing) {
  const Method method = area_method(false);
  EXPECT_EQ(method.name, "cgal_area");
  EXPECT_THAT(method.note, HasSubstr("not built: Ceres was not found (libceres-dev)"));
  TriangleMesh mesh = icosphere(1);
  EXPECT_THAT([&] { method.run(mesh, OptionValues(method.options, {}), {}); }, ThrowsMessage<NotInstalled>(HasSubstr("libceres-dev")));
  EXPECT_EQ(mesh.points, icosphere(1).points);
}

/// Largest over smallest area of the triangles around a vertex, the mean over the vertices.
double unevenness_of_areas(const TriangleMesh& mesh) {
  std::vector<double> largest(mesh.points.size(), 0), smallest(mesh.points.size(), HUGE_VAL);
  for (const auto& [a, b, c] : mesh.triangles) {
    const double area = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm();
    for (const VertexId v : {a, b, c}) {
      largest[v] = std::max(largest[v], area);
      smallest[v] = std::min(smallest[v], area);
    }
  }
  double sum = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) sum += largest[v] / smallest[v];
  return sum / static_cast<double>(mesh.points.size());
}

TEST(AreaMethod, MakesAreasAroundAVertexMoreAlike) {
  if (!has_area_smoothing()) GTEST_SKIP() << "Ceres is not built in";
  const TriangleMesh mesh = noisy(uneven_torus(), 0.08, 2);
  AngleAreaOptions options = angles(2, true);
  options.smooths_areas = true;
  options.smooths_angles = false;
  options.flips_edges = false;
  const TriangleMesh after = smoothed(mesh, options);
  EXPECT_EQ(after.triangles, mesh.triangles);
  EXPECT_LT(unevenness_of_areas(after), 0.8 * unevenness_of_areas(mesh));
}

TEST(AreaMethod, FlipsEdgesUnlessToldNotTo) {
  if (!has_area_smoothing()) GTEST_SKIP() << "Ceres is not built in";
  const Method method = area_method();
  const auto triangles = [&](const char* flips) {
    TriangleMesh mesh = uneven_torus();
    method.run(mesh, OptionValues(method.options, {{"rounds", "1"}, {"flips", flips}}), {});
    return mesh.triangles;
  };
  EXPECT_EQ(triangles("off"), uneven_torus().triangles);
  EXPECT_NE(triangles("on"), uneven_torus().triangles);
}

}  // namespace
}  // namespace smopt::baselines
