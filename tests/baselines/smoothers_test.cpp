// What all smoothers that keep the connectivity promise.

#include <functional>

#include "baselines/cotangent.h"
#include "baselines/hc.h"
#include "baselines/laplacian.h"
#include "baselines/meshlab.h"
#include "baselines/taubin.h"
#include "smopt/error.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"
#include "tests/support/threads.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;

/// What a smoother's weights depend on, and so which maps of the mesh it goes with.
enum class Maps { affine, similar };

struct Smoother {
  const char* name;
  std::function<void(TriangleMesh&, int rounds, const ProgressCallback&)> smooth;
  Maps maps;
  double tolerance;  ///< of coordinates around 1: rounding of some rounds
};

constexpr double kDouble = 1e-12;
constexpr double kFloat = 2e-5;

const Smoother kSmoothers[] = {
    {"laplacian",
     [](TriangleMesh& m, int n, const ProgressCallback& p) {
       smooth_laplacian(m, {n, 0.7, SweepOrder::jacobi}, p);
     },
     Maps::affine, kDouble},
    {"taubin",
     [](TriangleMesh& m, int n, const ProgressCallback& p) {
       smooth_taubin(m, {n, 0.5, -0.53}, p);
     },
     Maps::affine, kDouble},
    {"hc",
     [](TriangleMesh& m, int n, const ProgressCallback& p) {
       smooth_hc(m, {n, 0.3, 0.6}, p);
     },
     Maps::affine, kDouble},
    {"cotangent",
     [](TriangleMesh& m, int n, const ProgressCallback& p) {
       smooth_cotangent(m, {n, 0.5}, p);
     },
     Maps::similar, 1e-10},
    {"meshlab_uniform",
     [](TriangleMesh& m, int n, const ProgressCallback& p) {
       smooth_meshlab(m, {n, MeshlabWeights::uniform}, p);
     },
     Maps::affine, kFloat},
    {"meshlab_cotangent",
     [](TriangleMesh& m, int n, const ProgressCallback& p) {
       smooth_meshlab(m, {n, MeshlabWeights::cotangent}, p);
     },
     Maps::similar, kFloat},
};

class Smoothers : public ::testing::TestWithParam<Smoother> {
 protected:
  static TriangleMesh smoothed(TriangleMesh mesh, int rounds = 5) {
    GetParam().smooth(mesh, rounds, {});
    return mesh;
  }
  static void expect_near(const TriangleMesh& a, const TriangleMesh& b, double scale = 1) {
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t v = 0; v < a.points.size(); ++v)
      ASSERT_LE((a.points[v] - b.points[v]).norm(), scale * GetParam().tolerance) << "vertex " << v;
  }
};

/// Torus vertices all have valence 6; the sphere's have 5 and 6.
TriangleMesh rough_mesh() {
  return joined(noisy(icosphere(2), 0.03, 7), translated(noisy(torus(2, 0.7, 16, 8), 0.05, 8), {1, -2, 0.5}));
}

TEST_P(Smoothers, KeepTheTriangles) {
  EXPECT_EQ(smoothed(rough_mesh()).triangles, rough_mesh().triangles);
}

TEST_P(Smoothers, DoNothingInZeroRounds) {
  const TriangleMesh before = rough_mesh(), after = smoothed(before, 0);
  for (std::size_t v = 0; v < before.points.size(); ++v)  // MeshLab's take the coordinates as float32
    EXPECT_LE((after.points[v] - before.points[v]).norm(), GetParam().tolerance == kFloat ? 3e-7 : 0);
}

TEST_P(Smoothers, MakeARoughMeshSmoother) {
  const TriangleMesh rough = noisy(icosphere(3), 0.03, 7);
  const auto roughness = [](const TriangleMesh& mesh) {  // variance of the radii: 0 on a sphere
    double sum = 0, squares = 0;
    for (const Vec3& p : mesh.points) {
      sum += p.norm();
      squares += p.squaredNorm();
    }
    const double n = static_cast<double>(mesh.points.size());
    return (squares / n - sum * sum / (n * n)) * n * n / (sum * sum);
  };
  EXPECT_LT(roughness(smoothed(rough)), 0.6 * roughness(rough));
}

TEST_P(Smoothers, LeaveAMeshThatIsOnePointWhereItIs) {
  TriangleMesh mesh = icosphere(1);
  for (Vec3& p : mesh.points) p = Vec3(1, 2, 4);
  expect_near(smoothed(mesh), mesh);
}

TEST_P(Smoothers, KeepTheShapeOfRegularPolyhedra) {
  for (const TriangleMesh& mesh : {tetrahedron(), icosphere(0)}) {
    const TriangleMesh after = smoothed(mesh, 1);
    const double factor = after.points[0].dot(mesh.points[0]) / mesh.points[0].squaredNorm();
    expect_near(after, scaled(mesh, factor));
  }
}

TEST_P(Smoothers, GoWithRotationsTranslationsAndScales) {
  const auto mapped = [](const TriangleMesh& mesh) {
    return translated(scaled(rotated(mesh, Vec3(1, 2, -1).normalized(), 0.8), 2.5), {0.5, -1, 2});
  };
  expect_near(smoothed(mapped(rough_mesh())), mapped(smoothed(rough_mesh())), 10);
}

TEST_P(Smoothers, WithWeightsOfTheConnectivityGoWithAffineMaps) {
  if (GetParam().maps == Maps::similar) GTEST_SKIP() << "its weights are angles'";
  Eigen::Matrix3d linear;
  linear << 2, 1, 0, -1, 3, 0.5, 0, 0.25, -1;
  const auto mapped = [&](TriangleMesh mesh) {
    for (Vec3& p : mesh.points) p = linear * p + Vec3(0.5, -1, 2);
    return mesh;
  };
  expect_near(smoothed(mapped(rough_mesh())), mapped(smoothed(rough_mesh())), 10);
}

TEST_P(Smoothers, DoNotDependOnTheOrderOfTheVertices) {
  const TriangleMesh mesh = noisy(icosphere(2), 0.03, 7);
  const std::size_t last = mesh.points.size() - 1;
  TriangleMesh backwards = mesh;
  for (std::size_t v = 0; v <= last; ++v) backwards.points[last - v] = mesh.points[v];
  for (Triangle& t : backwards.triangles)
    for (VertexId& v : t) v = static_cast<VertexId>(last) - v;
  TriangleMesh after = smoothed(backwards);
  std::reverse(after.points.begin(), after.points.end());
  expect_near(after, smoothed(mesh));
}

TEST_P(Smoothers, LeaveIsolatedVerticesWhereTheyAre) {
  TriangleMesh mesh = icosphere(0);
  mesh.points.emplace_back(7, 8, 9);
  EXPECT_EQ(smoothed(mesh).points.back(), Vec3(7, 8, 9));
}

TEST_P(Smoothers, TakeAnEmptyMesh) {
  EXPECT_TRUE(smoothed({}).points.empty());
}

TEST_P(Smoothers, GiveTheSameBytesForAnyNumberOfThreads) {
  const TriangleMesh mesh = noisy(icosphere(5), 0.003, 3);  // 10 242 vertices: more than one task
  expect_same_for_any_threads([&] { return smoothed(mesh, 3).points; });
}

TEST_P(Smoothers, StopWithCancelledWhenTheCallbackSaysSo) {
  TriangleMesh mesh = icosphere(1);
  int calls = 0;
  EXPECT_THROW(GetParam().smooth(mesh, 10, [&](std::string_view, double) { return ++calls < 3; }), Cancelled);
  EXPECT_EQ(calls, 3);
}

INSTANTIATE_TEST_SUITE_P(All, Smoothers, ::testing::ValuesIn(kSmoothers),
                         [](const ::testing::TestParamInfo<Smoother>& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace smopt::baselines
