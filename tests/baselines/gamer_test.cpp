#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "baselines/gamer/angle_weighted_smoothing.h"
#include "baselines/gamer/angle_weighted_step.h"
#include "baselines/gamer/edge_flips.h"
#include "baselines/laplacian.h"
#include "smopt/error.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"
#include "tests/support/threads.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;

TriangleMesh smoothed(TriangleMesh mesh, const AngleWeightedOptions& options = {}) {
  smooth_angle_weighted(mesh, options);
  return mesh;
}

TriangleMesh laplacian(TriangleMesh mesh, int rounds) {
  smooth_laplacian(mesh, {rounds, 1, smopt::baselines::SweepOrder::jacobi});
  return mesh;
}

std::vector<Vec3> stepped(const TriangleMesh& mesh, int tensor_rings = 2) {
  std::vector<Vec3> next(mesh.points.size());
  angle_weighted_step(mesh, *build_rings(mesh), tensor_rings, next);
  return next;
}

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t v = 0; v < std::min(a.size(), b.size()); ++v) largest = std::max(largest, (a[v] - b[v]).norm());
  return largest;
}

/// A closed block [0, n] × [0, n] × [0, 1] with vertices `place(i, j)` on its top, in a regular pattern of triangles, and a fan below.
template <class Place>
TriangleMesh block_with_top(std::uint32_t n, const Place& place) {
  TriangleMesh mesh;
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i * (n + 1) + j; };
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) mesh.points.push_back(place(i, j));
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  const auto below = static_cast<VertexId>(mesh.points.size());
  mesh.points.emplace_back(n / 2.0, n / 2.0, -1.0 * n);
  for (std::uint32_t k = 0; k < n; ++k) {
    mesh.triangles.push_back({at(k + 1, 0), at(k, 0), below});
    mesh.triangles.push_back({at(n, k + 1), at(n, k), below});
    mesh.triangles.push_back({at(k, n), at(k + 1, n), below});
    mesh.triangles.push_back({at(0, k), at(0, k + 1), below});
  }
  return mesh;
}

/// The cube [0, 1]³ with n × n squares on each face, cut in two triangles each.
TriangleMesh fine_cube(int n) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, VertexId> ids;
  const auto id = [&](const std::array<int, 3>& p) {
    const auto [it, is_new] = ids.emplace(p, static_cast<VertexId>(mesh.points.size()));
    if (is_new) mesh.points.emplace_back(p[0] / double(n), p[1] / double(n), p[2] / double(n));
    return it->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {0, n}) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int a, int b) {
            std::array<int, 3> p{};
            p[axis] = side;
            p[(axis + 1) % 3] = side == n ? a : b;
            p[(axis + 2) % 3] = side == n ? b : a;
            return id(p);
          };
          mesh.triangles.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
          mesh.triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
        }
      }
    }
  }
  return mesh;
}

/// The step as the papers write it: explicit projections, eigenvectors of the tensor, sets for the rings.
Vec3 step_as_published(const TriangleMesh& mesh, VertexId v, int tensor_rings) {
  std::map<VertexId, std::map<VertexId, VertexId>> after;  // by vertex: from each neighbour to the one after it in the ring
  std::map<VertexId, Vec3> normals;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      after[t[k]][t[(k + 1) % 3]] = t[(k + 2) % 3];
      const Vec3 area = (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
      normals.try_emplace(t[k], Vec3::Zero()).first->second += area;
    }
  }
  const Vec3 x = mesh.points[v];
  Vec3 sum = Vec3::Zero();
  double weights = 0;
  for (const auto& [p_id, s_id] : after[v]) {
    const Vec3 s = mesh.points[s_id];
    const Vec3 p = (mesh.points[p_id] - s).normalized(), q = (mesh.points[after[v][s_id]] - s).normalized();
    const Vec3 bisector = (p + q).normalized(), plane = p.cross(q).normalized();
    const Vec3 projected = s + bisector.dot(x - s) * bisector + plane.dot(x - s) * plane;
    const double weight = p.dot(q) + 1;
    sum += weight * projected;
    weights += weight;
  }
  std::set<VertexId> near = {v};
  for (int ring = 0; ring < tensor_rings; ++ring)
    for (const VertexId u : std::set<VertexId>(near))
      for (const auto& [w, ignored] : after[u]) near.insert(w);
  near.erase(v);
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  for (const VertexId w : near) tensor += normals[w].normalized() * normals[w].normalized().transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(tensor);
  Vec3 result = x;
  for (int k = 0; k < 3; ++k) {
    const Vec3 e = eigen.eigenvectors().col(k);
    result += (sum / weights - x).dot(e) / (1 + eigen.eigenvalues()[k]) * e;
  }
  return result;
}

TEST(AngleWeightedStep, IsWhatThePapersWrite) {
  for (const int rings : {1, 2, 3}) {
    const TriangleMesh mesh = noisy(torus(2, 0.7, 16, 8), 0.15, 3);
    const std::vector<Vec3> next = stepped(mesh, rings);
    for (VertexId v = 0; v < next.size(); ++v)
      EXPECT_LT((next[v] - step_as_published(mesh, v, rings)).norm(), 1e-13) << "vertex " << v << ", " << rings << " rings";
  }
}

TEST(AngleWeightedStep, MovesATetrahedronByHand) {
  // Each neighbour s of x sees the other two under 60°: weight 3/2. Its plane of bisection holds x by symmetry, so nothing moves.
  EXPECT_LT(largest_distance(stepped(tetrahedron()), tetrahedron().points), 1e-15);
  // Now x = (1, 1, 1) + t·(1, −1, 0), to first order in t. The neighbour s = (−1, −1, 1) bisects between the other two, p = (1, −1, −1) and
  // q = (−1, 1, −1), by a plane with the normal (1, −1, 0)/√2, along which x − s is t√2: it proposes the move −t·(1, −1, 0). The neighbour p,
  // by (0, −1, 1)/√2 and x − p = (t, 2 − t, 2), which is t/√2 along it: −t/2·(0, −1, 1). The neighbour q, by (1, 0, −1)/√2: −t/2·(1, 0, −1).
  // The mean is −t/3·(3/2)·(1, −1, 0). The normals of all four are s/√3 at first, so that Σ n nᵀ = 4/3·I; without x's own, 4/3 is still the
  // eigenvalue across x. What is left is −t/2·(1, −1, 0)/(1 + 4/3).
  const double t = 1e-7;
  TriangleMesh mesh = tetrahedron();
  ASSERT_EQ(mesh.points[0], Vec3(1, 1, 1));
  mesh.points[0] += t * Vec3(1, -1, 0);
  EXPECT_LT((stepped(mesh)[0] - (Vec3(1, 1, 1) + t * (1 - 0.5 / (1 + 4.0 / 3)) * Vec3(1, -1, 0))).norm(), 10 * t * t);
}

TEST(AngleWeightedStep, LeavesRegularPolyhedraAsTheyAreUpToScale) {
  TriangleMesh octahedron;
  octahedron.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  octahedron.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (const TriangleMesh& mesh : {tetrahedron(), octahedron, icosphere(0)}) {
    const std::vector<Vec3> next = stepped(mesh);
    const double scale = next[0].norm() / mesh.points[0].norm();
    for (std::size_t v = 0; v < next.size(); ++v) EXPECT_LT((next[v] - scale * mesh.points[v]).norm(), 1e-14);
  }
}

TEST(AngleWeightedStep, LeavesTheInsideOfARegularFlatPatchWhereItIs) {
  const std::uint32_t n = 6;
  const TriangleMesh mesh = block_with_top(n, [](std::uint32_t i, std::uint32_t j) { return Vec3(i + 0.5 * j, std::sqrt(0.75) * j, 0); });
  const std::vector<Vec3> next = stepped(mesh);
  for (std::uint32_t i = 1; i < n; ++i)
    for (std::uint32_t j = 1; j < n; ++j) EXPECT_LT((next[i * (n + 1) + j] - mesh.points[i * (n + 1) + j]).norm(), 1e-14);
}

TEST(AngleWeightedStep, KeepsFlatRegionsFlatAndEvensThemOut) {
  const std::uint32_t n = 10;
  const std::uint32_t border = 3;  // rings in which a normal of the side is near
  const auto uneven = [](std::uint32_t i, std::uint32_t j) {
    return Vec3(i + 0.2 * std::sin(7.0 * i + j), j + 0.2 * std::cos(3.0 * i * j), 0);
  };
  const TriangleMesh mesh = block_with_top(n, uneven);
  const std::vector<Vec3> next = stepped(mesh);
  double moved = 0;
  for (std::uint32_t i = border; i <= n - border; ++i) {
    for (std::uint32_t j = border; j <= n - border; ++j) {
      const std::size_t v = i * (n + 1) + j;
      EXPECT_LT(std::abs(next[v].z()), 1e-15);
      moved = std::max(moved, (next[v] - mesh.points[v]).norm());
    }
  }
  EXPECT_GT(moved, 0.05);
}

TEST(AngleWeightedStep, GoesOnWithDegenerateTriangles) {
  TriangleMesh needle = icosphere(2), flat = icosphere(2);
  needle.points[0] = needle.points[needle.triangles[0][1]] + Vec3(1e-14, 0, 0);
  const Triangle t = flat.triangles[5];
  flat.points[t[0]] = flat.points[t[1]];  // an edge without length, two triangles without area
  TriangleMesh point = icosphere(1);
  for (Vec3& p : point.points) p = Vec3(1, 2, 3);
  for (const TriangleMesh& mesh : {needle, flat, point}) {
    const TriangleMesh after = smoothed(mesh, {10, 2, true});
    for (const Vec3& p : after.points) EXPECT_TRUE(p.allFinite());
    EXPECT_THAT(after, IsClosedManifold());
  }
  EXPECT_EQ(smoothed(point).points, point.points);
  // Where two neighbours coincide, the others still propose.
  EXPECT_GT((stepped(flat)[t[2]] - flat.points[t[2]]).norm(), 1e-3);
}

TEST(AngleWeightedSmoothing, LeavesIsolatedVerticesWhereTheyAre) {
  TriangleMesh mesh = icosphere(1);
  mesh.points.emplace_back(7, 8, 9);
  EXPECT_EQ(smoothed(mesh).points.back(), Vec3(7, 8, 9));
}

TEST(AngleWeightedSmoothing, GoesWithRigidMotionAndScale) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.03, 4);
  const auto moved = [](TriangleMesh m) { return translated(rotated(std::move(m), Vec3(1, 2, 3), 0.8), Vec3(4, -5, 6)); };
  const TriangleMesh after = smoothed(mesh);
  EXPECT_LT(largest_distance(smoothed(moved(mesh)).points, moved(after).points), 1e-12);
  EXPECT_EQ(smoothed(moved(mesh)).triangles, after.triangles);
  EXPECT_LT(largest_distance(smoothed(scaled(mesh, 8)).points, scaled(after, 8).points), 1e-12);  // lengths cancel: no part has a unit
}

TEST(AngleWeightedSmoothing, ShrinksMuchLessThanPlainLaplacian) {
  const int rounds = 6;
  for (const TriangleMesh& mesh : {noisy(icosphere(3), 0.03, 1), noisy(torus(2, 0.7, 48, 24), 0.03, 2)}) {
    const double before = enclosed_volume(mesh);
    const double loss = 1 - enclosed_volume(smoothed(mesh, {rounds, 2, true})) / before;
    const double plain = 1 - enclosed_volume(laplacian(mesh, rounds)) / before;
    EXPECT_GT(plain, 0.01);
    EXPECT_LT(std::abs(loss), plain / 5);
  }
}

TEST(AngleWeightedSmoothing, KeepsTheSharpEdgesOfACubeMuchBetterThanPlainLaplacian) {
  const int rounds = 6;
  const TriangleMesh mesh = fine_cube(10);
  ASSERT_THAT(mesh, IsClosedManifold());
  const auto edge_error = [&](const TriangleMesh& after) {  // how far the vertices inside the cube's edges have gone from the edges
    double sum = 0;
    int count = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      const Vec3 p = mesh.points[v], q = after.points[v];
      std::vector<int> across;
      for (int axis = 0; axis < 3; ++axis)
        if (p[axis] == 0 || p[axis] == 1) across.push_back(axis);
      if (across.size() != 2) continue;
      sum += std::hypot(q[across[0]] - p[across[0]], q[across[1]] - p[across[1]]);
      ++count;
    }
    return sum / count;
  };
  const double plain = edge_error(laplacian(mesh, rounds));
  EXPECT_GT(plain, 0.02);
  EXPECT_LT(edge_error(smoothed(mesh, {rounds, 2, false})), plain / 3);
}

TEST(AngleWeightedSmoothing, GivesTheSameBytesForAnyNumberOfThreads) {
  const TriangleMesh mesh = noisy(icosphere(5), 0.01, 6);
  expect_same_for_any_threads([&] {
    const TriangleMesh after = smoothed(mesh);
    return std::make_pair(after.points, after.triangles);
  });
}

TEST(AngleWeightedSmoothing, RejectsAnOpenMeshAndStopsWhenToldTo) {
  TriangleMesh open = icosphere(1);
  open.triangles.pop_back();
  EXPECT_THROW(smooth_angle_weighted(open, {}), InvalidMesh);
  TriangleMesh mesh = icosphere(1);
  int calls = 0;
  EXPECT_THROW(smooth_angle_weighted(mesh, {}, [&](std::string_view, double) { return ++calls < 3; }), Cancelled);
  EXPECT_EQ(calls, 3);
}

double smallest_angle(const TriangleMesh& mesh) {
  double smallest = std::numbers::pi;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]], b = mesh.points[t[(k + 2) % 3]] - mesh.points[t[k]];
      smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
  }
  return smallest * 180 / std::numbers::pi;
}

std::size_t flip(TriangleMesh& mesh) {
  return flip_edges(mesh, *build_rings(mesh));
}

/// The mesh with a vertex in the middle of every third triangle, and noise: valences from 3 to 12, and small angles.
TriangleMesh speckled(TriangleMesh mesh, double amplitude, std::uint32_t seed) {
  const std::size_t faces = mesh.triangles.size();
  for (std::size_t f = 0; f < faces; f += 3) {
    const auto [a, b, c] = mesh.triangles[f];
    const auto middle = static_cast<VertexId>(mesh.points.size());
    mesh.points.emplace_back((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3);
    mesh.triangles[f] = {a, b, middle};
    mesh.triangles.push_back({b, c, middle});
    mesh.triangles.push_back({c, a, middle});
  }
  return noisy(std::move(mesh), amplitude, seed);
}

/// GAMer's rule for the edge (u, w) between the triangles (u, w, a) and (w, u, b), worked out anew.
bool rule_wants_flip(const TriangleMesh& mesh, VertexId u, VertexId w, VertexId a, VertexId b) {
  const auto area = [&](VertexId i, VertexId j, VertexId k) {
    return (mesh.points[j] - mesh.points[i]).cross(mesh.points[k] - mesh.points[i]).norm() / 2;
  };
  const double growth = (area(u, b, a) + area(b, w, a)) / (area(u, w, a) + area(w, u, b));
  if (growth * growth > 1.001) return false;
  const auto excess = [&](VertexId v) {
    return -6 + static_cast<int>(std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                                               [&](const Triangle& t) { return std::count(t.begin(), t.end(), v) == 1; }));
  };
  const auto squares = [](int i, int j, int k, int l) { return i * i + j * j + k * k + l * l; };
  const int eu = excess(u), ew = excess(w), ea = excess(a), eb = excess(b);
  const int change = squares(eu - 1, ew - 1, ea + 1, eb + 1) - squares(eu, ew, ea, eb);
  if (change < -3) return true;
  if (change > 3) return false;
  const TriangleMesh before{mesh.points, {{u, w, a}, {w, u, b}}}, after{mesh.points, {{u, b, a}, {b, w, a}}};
  return smallest_angle(after) > smallest_angle(before);
}

bool has_edge(const TriangleMesh& mesh, VertexId a, VertexId b) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                     [&](const Triangle& t) { return std::count(t.begin(), t.end(), a) + std::count(t.begin(), t.end(), b) == 2; });
}

/// Calls visit(u, w, a, b) for every edge with its triangles (u, w, a) and (w, u, b).
template <class Visit>
void for_edges(const TriangleMesh& mesh, const Visit& visit) {
  std::map<std::pair<VertexId, VertexId>, VertexId> opposite;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) opposite[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
  for (const auto& [edge, a] : opposite)
    if (edge.first < edge.second) visit(edge.first, edge.second, a, opposite.at({edge.second, edge.first}));
}

TEST(EdgeFlips, FlipOnlyWhatTheRuleWants) {
  const TriangleMesh before = speckled(icosphere(2), 0.05, 4);
  TriangleMesh after = before;
  const std::size_t flips = flip(after);
  EXPECT_GT(flips, 10U);
  std::size_t found = 0;
  for_edges(before, [&](VertexId u, VertexId w, VertexId a, VertexId b) {
    if (has_edge(after, u, w)) return;
    ++found;
    EXPECT_TRUE(rule_wants_flip(before, u, w, a, b)) << u << " " << w;
    EXPECT_TRUE(has_edge(after, a, b));
  });
  EXPECT_EQ(found, flips);
}

TEST(EdgeFlips, LeaveNothingThatTheRuleWants) {
  TriangleMesh mesh = speckled(icosphere(2), 0.02, 4);
  int rounds = 0;
  while (flip(mesh) > 0 && rounds < 200) ++rounds;
  ASSERT_LT(rounds, 200);
  for_edges(mesh, [&](VertexId u, VertexId w, VertexId a, VertexId b) {
    EXPECT_FALSE(!has_edge(mesh, a, b) && rule_wants_flip(mesh, u, w, a, b)) << u << " " << w;
  });
}

TEST(EdgeFlips, KeepTheMeshAClosedManifoldOfTheSameTopology) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    TriangleMesh mesh = speckled(torus(2, 0.7, 40, 20), 0.1, seed);
    const double volume = enclosed_volume(mesh);
    std::size_t flips = 0;
    for (int round = 0; round < 20; ++round) flips += flip(mesh);
    EXPECT_GT(flips, 100U);
    EXPECT_THAT(mesh, IsClosedManifold()) << "seed " << seed;
    EXPECT_EQ(euler_characteristic(mesh), 0);
    EXPECT_NEAR(enclosed_volume(mesh), volume, 0.05 * volume);
  }
}

/// A sphere with two poles, 4 and 5, of valence 6, that lie on both sides of two far edges, (0, 1) and (2, 3), whose ends have valence 8: the rule
/// wants either edge turned into (4, 5). Fans of four triangles, from 1 and 2 and from 3 and 0, close the gaps between the edges.
TriangleMesh mesh_with_two_ways_to_one_edge() {
  TriangleMesh mesh;
  mesh.points = {{1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {0, 0, 0.2}, {0, 0, -0.2}};
  mesh.triangles = {{0, 1, 4}, {1, 0, 5}, {2, 3, 4}, {3, 2, 5}};
  for (const auto& [from, to, y] : {std::tuple<VertexId, VertexId, double>{1, 2, 1.5}, {3, 0, -1.5}}) {
    const auto first = static_cast<VertexId>(mesh.points.size());
    const VertexId last = first + 4;
    for (int k = 0; k <= 4; ++k) mesh.points.emplace_back(0, y, 0.2 - 0.1 * k);
    mesh.triangles.insert(mesh.triangles.end(), {{from, first, 4}, {first, to, 4}, {last, from, 5}, {to, last, 5}});
    for (VertexId v = first; v < last; ++v) mesh.triangles.insert(mesh.triangles.end(), {{from, v + 1, v}, {to, v, v + 1}});
  }
  return mesh;
}

TEST(EdgeFlips, DoNotMakeAnEdgeTwice) {
  TriangleMesh mesh = mesh_with_two_ways_to_one_edge();
  ASSERT_THAT(mesh, IsClosedManifold());
  ASSERT_TRUE(rule_wants_flip(mesh, 0, 1, 4, 5));
  ASSERT_TRUE(rule_wants_flip(mesh, 2, 3, 4, 5));
  flip(mesh);
  EXPECT_THAT(mesh, IsClosedManifold());
  EXPECT_TRUE(has_edge(mesh, 4, 5));
  EXPECT_NE(has_edge(mesh, 0, 1), has_edge(mesh, 2, 3));
}

TEST(EdgeFlips, LeaveATetrahedronAndARegularMeshAlone) {
  for (TriangleMesh mesh : {tetrahedron(), icosphere(2)}) {
    const auto before = mesh.triangles;
    EXPECT_EQ(flip(mesh), 0U);
    EXPECT_EQ(mesh.triangles, before);
  }
}

TEST(EdgeFlips, LeaveTheEdgesOfACubeAlone) {
  // A flip there would cut the edge off: less area, but triangles across it. Only diagonals of squares may turn.
  TriangleMesh mesh = fine_cube(4);
  const double volume = enclosed_volume(mesh);
  flip(mesh);
  EXPECT_NEAR(enclosed_volume(mesh), volume, 1e-12);
}

TEST(GamerMethod, PassesItsOptionsOn) {
  const Method method = gamer_method();
  const TriangleMesh mesh = speckled(icosphere(2), 0.03, 5);
  const auto by_method = [&](const std::map<std::string, std::string>& given) {
    TriangleMesh copy = mesh;
    method.run(copy, OptionValues(method.options, given), {});
    return copy.points;
  };
  EXPECT_EQ(by_method({}), smoothed(mesh, {6, 2, true}).points);
  EXPECT_EQ(by_method({{"rounds", "3"}, {"tensor-rings", "1"}, {"flips", "off"}}), smoothed(mesh, {3, 1, false}).points);
  EXPECT_NE(by_method({}), by_method({{"flips", "off"}}));
  EXPECT_THROW(by_method({{"tensor-rings", "0"}}), InvalidOption);
}

}  // namespace
}  // namespace smopt::baselines
