#include "baselines/laplacian.h"

#include <algorithm>

#include "smopt/error.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;

TriangleMesh smoothed(TriangleMesh mesh, const LaplacianOptions& options) {
  smooth_laplacian(mesh, options);
  return mesh;
}

void expect_points_near(const TriangleMesh& a, const std::vector<Vec3>& points, double tolerance) {
  ASSERT_EQ(a.points.size(), points.size());
  for (std::size_t v = 0; v < points.size(); ++v) EXPECT_LE((a.points[v] - points[v]).norm(), tolerance) << "vertex " << v;
}

constexpr SweepOrder kOrders[] = {SweepOrder::jacobi, SweepOrder::gauss_seidel};

TEST(Laplacian, JacobiStepOfATetrahedronByHand) {
  // Each vertex goes to the mean of the other three, which is −1/3 of itself as the four sum to zero.
  const TriangleMesh mesh = tetrahedron();
  std::vector<Vec3> whole, half;
  for (const Vec3& p : mesh.points) {
    whole.emplace_back(-p / 3);
    half.emplace_back(p / 3);  // half of the way from p to −p / 3
  }
  expect_points_near(smoothed(mesh, {1, 1, SweepOrder::jacobi}), whole, 1e-15);
  expect_points_near(smoothed(mesh, {1, 0.5, SweepOrder::jacobi}), half, 1e-15);
}

TEST(Laplacian, GaussSeidelStepOfATetrahedronByHand) {
  // From (1,1,1), (1,−1,−1), (−1,1,−1), (−1,−1,1), each in turn to the mean of the others as they are then.
  expect_points_near(smoothed(tetrahedron(), {1, 1, SweepOrder::gauss_seidel}),
                     {{-1.0 / 3, -1.0 / 3, -1.0 / 3},
                      {-7.0 / 9, -1.0 / 9, -1.0 / 9},
                      {-19.0 / 27, -13.0 / 27, 5.0 / 27},
                      {-49.0 / 81, -25.0 / 81, -7.0 / 81}},
                     1e-15);
}

TEST(Laplacian, TheOrdersDiffer) {
  const TriangleMesh mesh = noisy(icosphere(1), 0.1, 1);
  EXPECT_NE(smoothed(mesh, {3, 1, SweepOrder::jacobi}).points, smoothed(mesh, {3, 1, SweepOrder::gauss_seidel}).points);
}

TEST(Laplacian, MovesNothingInZeroRoundsOrWithBetaZero) {
  const TriangleMesh mesh = noisy(icosphere(1), 0.1, 1);
  for (const SweepOrder order : kOrders) {
    EXPECT_EQ(smoothed(mesh, {0, 1, order}).points, mesh.points);
    EXPECT_EQ(smoothed(mesh, {5, 0, order}).points, mesh.points);
  }
}

TEST(Laplacian, LeavesAFixedPointWhereItIs) {
  TriangleMesh mesh = icosphere(1);
  for (Vec3& p : mesh.points) p = Vec3(1, 2, 4);  // every vertex is the mean of its neighbours
  for (const SweepOrder order : kOrders) expect_points_near(smoothed(mesh, {10, 1, order}), mesh.points, 1e-14);
}

TEST(Laplacian, LeavesIsolatedVerticesWhereTheyAre) {
  TriangleMesh mesh = icosphere(0);
  mesh.points.emplace_back(7, 8, 9);
  for (const SweepOrder order : kOrders) EXPECT_EQ(smoothed(mesh, {3, 1, order}).points.back(), Vec3(7, 8, 9));
}

TEST(Laplacian, GoesWithAffineMaps) {
  Eigen::Matrix3d linear;
  linear << 2, 1, 0, -1, 3, 0.5, 0, 0.25, -1;
  const auto mapped = [&](TriangleMesh mesh) {
    for (Vec3& p : mesh.points) p = linear * p + Vec3(5, -6, 7);
    return mesh;
  };
  const TriangleMesh mesh = noisy(torus(2, 0.7, 16, 8), 0.1, 4);
  for (const SweepOrder order : kOrders) {
    const LaplacianOptions options{10, 0.7, order};
    expect_points_near(smoothed(mapped(mesh), options), mapped(smoothed(mesh, options)).points, 1e-12);
  }
}

TEST(Laplacian, JacobiDoesNotDependOnTheOrderOfTheVertices) {
  const TriangleMesh mesh = noisy(icosphere(2), 0.1, 9);
  TriangleMesh by_order = mesh;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) by_order.points[mesh.points.size() - 1 - v] = mesh.points[v];
  for (Triangle& t : by_order.triangles)
    for (VertexId& v : t) v = static_cast<VertexId>(mesh.points.size()) - 1 - v;
  std::vector<Vec3> backwards = smoothed(by_order, {10, 1, SweepOrder::jacobi}).points;
  std::reverse(backwards.begin(), backwards.end());
  expect_points_near(smoothed(mesh, {10, 1, SweepOrder::jacobi}), backwards, 1e-13);
}

TEST(Laplacian, JacobiKeepsTheCentroidWhereAllValencesAreTheSame) {
  const TriangleMesh mesh = noisy(torus(2, 0.7, 16, 8), 0.2, 4);
  const auto centroid = [](const TriangleMesh& m) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : m.points) sum += p;
    return Vec3(sum / static_cast<double>(m.points.size()));
  };
  EXPECT_LT((centroid(smoothed(mesh, {50, 1, SweepOrder::jacobi})) - centroid(mesh)).norm(), 1e-13);
}

TEST(Laplacian, ShrinksASphereAndKeepsItsTopology) {
  for (const SweepOrder order : kOrders) {
    const TriangleMesh after = smoothed(icosphere(2), {20, 1, order});
    EXPECT_LT(enclosed_volume(after), 0.9 * enclosed_volume(icosphere(2)));
    EXPECT_GT(enclosed_volume(after), 0);
    EXPECT_EQ(after.triangles, icosphere(2).triangles);
  }
}

TEST(Laplacian, HasNoRuleForBorders) {
  // A pyramid without its base: a corner's neighbours are two opposite corners, whose mean is (0, 0, 0), and the tip.
  const TriangleMesh square{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 3}},
                            {{{0, 1, 4}}, {{1, 2, 4}}, {{2, 3, 4}}, {{3, 0, 4}}}};
  expect_points_near(smoothed(square, {1, 1, SweepOrder::jacobi}), {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 0}}, 1e-15);
}

TEST(Laplacian, SaysWhenItDiverges) {
  // Beta 3 multiplies each edge of a tetrahedron, whose vertices sum to zero, by 1 − 3 · 4/3 = −3 a round: beyond ten diagonals of the box
  // (10 · 2√3 = 34.6) when √3 · 3^k is, for k = 3.
  TriangleMesh mesh = tetrahedron();
  EXPECT_EQ(smooth_laplacian(mesh, {5, 3, SweepOrder::jacobi}), 3);
  EXPECT_EQ(smooth_laplacian(mesh = tetrahedron(), {2, 3, SweepOrder::jacobi}), std::nullopt);
}

TEST(Laplacian, StopsWithCancelledWhenTheCallbackSaysSo) {
  TriangleMesh mesh = icosphere(1);
  int calls = 0;
  EXPECT_THROW(smooth_laplacian(mesh, {}, [&](std::string_view, double) { return ++calls < 3; }), Cancelled);
  EXPECT_EQ(calls, 3);
}

TEST(LaplacianMethod, PassesItsOptionsOn) {
  const Method method = laplacian_method();
  const TriangleMesh mesh = noisy(icosphere(1), 0.1, 1);
  const auto by_method = [&](const std::map<std::string, std::string>& given) {
    TriangleMesh copy = mesh;
    method.run(copy, OptionValues(method.options, given), {});
    return copy.points;
  };
  EXPECT_EQ(by_method({}), smoothed(mesh, {100, 1, SweepOrder::jacobi}).points);
  EXPECT_EQ(by_method({{"rounds", "3"}, {"beta", "0.25"}, {"order", "gauss-seidel"}}),
            smoothed(mesh, {3, 0.25, SweepOrder::gauss_seidel}).points);
}

TEST(LaplacianMethod, CountsEveryVertexInEveryRound) {
  const Method method = laplacian_method();
  TriangleMesh mesh = icosphere(1);
  const MethodReport report = method.run(mesh, OptionValues(method.options, {{"rounds", "7"}}), {});
  EXPECT_EQ(report.rounds_run, 7U);
  EXPECT_EQ(report.moves.accepted, 7U * 42U);
  EXPECT_EQ(report.moves.refused, 0U);
  EXPECT_EQ(report.stopped_because, "rounds");
}

}  // namespace
}  // namespace smopt::baselines
