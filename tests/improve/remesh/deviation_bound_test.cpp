#include "smopt/improve/remesh/deviation_bound.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "smopt/error.h"
#include "smopt/improve/remesh/two_sided_distance.h"
#include "tests/improve/remesh/flat_lattice.h"
#include "tests/improve/remesh/sampled_distance.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Triangles that take the place of others.
struct Operation {
  std::vector<FaceId> old_faces;
  std::vector<Corners> new_triangles;
};

/// A surface that operations are applied to, as the engine does: the grid follows, and triangles that are left over go.
class Surface {
 public:
  explicit Surface(const TriangleMesh& mesh) : mesh_(mesh), grid_(mesh.points, mesh.triangles), is_gone_(mesh.triangles.size(), false) {}

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  TriangleMesh& mesh() { return mesh_; }
  [[nodiscard]] const TriangleGrid& grid() const { return grid_; }
  [[nodiscard]] TriangleMesh without_gone_triangles() const {
    TriangleMesh result{mesh_.points, {}};
    for (FaceId f = 0; f < is_gone_.size(); ++f)
      if (!is_gone_[f]) result.triangles.push_back(mesh_.triangles[f]);
    return result;
  }
  [[nodiscard]] bool has(FaceId f) const { return !is_gone_[f]; }
  [[nodiscard]] Corners corners(FaceId f) const {
    const Triangle& t = mesh_.triangles[f];
    return {mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]};
  }

  void apply(const Operation& operation) {
    for (std::size_t i = 0; i < operation.old_faces.size(); ++i) {
      const FaceId f = operation.old_faces[i];
      if (i < operation.new_triangles.size()) {
        put(f, operation.new_triangles[i]);
      } else {
        grid_.remove(f);
        is_gone_[f] = true;
      }
    }
  }

 private:
  void put(FaceId f, const Corners& t) {
    const auto first = static_cast<VertexId>(mesh_.points.size());
    mesh_.points.insert(mesh_.points.end(), t.begin(), t.end());
    mesh_.triangles[f] = {first, first + 1, first + 2};
    grid_.move(f, grid_.box_of(t[0], t[1], t[2]));
  }

  TriangleMesh mesh_;
  TriangleGrid grid_;
  std::vector<bool> is_gone_;
};

bool allows(const DeviationBound& bound, const Surface& surface, const Operation& operation) {
  return bound.allows(surface.mesh(), surface.grid(), operation.old_faces, operation.new_triangles);
}

/// Vertex v of the mesh as it was is moved; triangles are found by where their corners are.
Operation move_of(const Surface& surface, const Vec3& from, const Vec3& to) {
  Operation operation;
  for (FaceId f = 0; f < surface.mesh().triangles.size(); ++f) {
    Corners t = surface.corners(f);
    const auto corner = std::find(t.begin(), t.end(), from);
    if (corner == t.end() || !surface.has(f)) continue;
    *corner = to;
    operation.old_faces.push_back(f);
    operation.new_triangles.push_back(t);
  }
  return operation;
}

/// The edge's end is moved to its start: what has both goes.
Operation collapse_of(const Surface& surface, const Vec3& start, const Vec3& end) {
  Operation operation = move_of(surface, end, start);
  std::erase_if(operation.new_triangles, [&](const Corners& t) { return std::count(t.begin(), t.end(), start) > 1; });
  return operation;
}

/// The two triangles of an edge get the other diagonal; nothing where the edge has not two that are triangles.
std::optional<Operation> flip_of(const Surface& surface, const Vec3& p, const Vec3& q) {
  Operation operation;
  std::vector<Vec3> opposite;
  for (FaceId f = 0; f < surface.mesh().triangles.size(); ++f) {
    const Corners t = surface.corners(f);
    const auto is_corner = [&](const Vec3& x) { return std::find(t.begin(), t.end(), x) != t.end(); };
    if (!surface.has(f) || !is_corner(p) || !is_corner(q)) continue;
    const auto other = std::find_if(t.begin(), t.end(), [&](const Vec3& x) { return x != p && x != q; });
    if (other == t.end()) return std::nullopt;
    operation.old_faces.push_back(f);
    opposite.push_back(*other);
  }
  if (opposite.size() != 2) return std::nullopt;
  operation.new_triangles = {{opposite[0], opposite[1], p}, {opposite[0], opposite[1], q}};
  return operation;
}

/// Random operations: moves, flips and collapses.
class RandomOperations {
 public:
  RandomOperations(std::uint32_t seed, double step) : random_(seed), step_(step) {}

  Operation operator()(const Surface& surface) {
    for (;;) {
      const auto f = static_cast<FaceId>(random_() % surface.mesh().triangles.size());
      if (!surface.has(f)) continue;
      const Corners t = surface.corners(f);
      switch (random_() % 4) {
        case 0: {
          const std::optional<Operation> flip = flip_of(surface, t[0], t[1]);
          if (flip) return *flip;
          break;
        }
        case 1:
          return collapse_of(surface, t[0], t[1]);
        default:
          return move_of(surface, t[0], t[0] + step_ * Vec3(uniform_(random_), uniform_(random_), uniform_(random_)));
      }
    }
  }

 private:
  std::mt19937 random_;
  double step_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

Operation rebuilt(const Surface& surface, std::vector<FaceId> faces) {
  Operation operation{std::move(faces), {}};
  for (const FaceId f : operation.old_faces) operation.new_triangles.push_back(surface.corners(f));
  return operation;
}

TEST(DeviationBound, AllowsWhatChangesNothingHoweverSmallTheBound) {
  for (const TriangleMesh& mesh : {icosphere(2), noisy(icosphere(2), 0.2, 1), cube()}) {
    const Surface surface(mesh);
    const DeviationBound bound(mesh, 1e-9);
    for (FaceId f = 0; f + 1 < mesh.triangles.size(); ++f) EXPECT_TRUE(allows(bound, surface, rebuilt(surface, {f, f + 1}))) << f;
  }
}

TEST(DeviationBound, AllowsAnyFlipMoveAndCollapseInAFlatRegionHoweverSmallTheBound) {
  for (const double angle : {0.0, 1.0}) {
    const TriangleMesh mesh = rotated(flat_lattice(6), Vec3(1, 2, 3), angle);
    const Surface surface(mesh);
    const DeviationBound bound(mesh, 1e-9);
    const VertexId middle = 3 * 7 + 3;
    const Vec3 p = mesh.points[middle], q = mesh.points[middle + 1], x = mesh.points[middle + 7] - p;
    EXPECT_TRUE(allows(bound, surface, *flip_of(surface, p, q)));
    EXPECT_TRUE(allows(bound, surface, move_of(surface, p, p + 0.3 * (q - p) + 0.2 * x)));
    EXPECT_TRUE(allows(bound, surface, collapse_of(surface, p, q)));
  }
}

TEST(DeviationBound, AllowsAFlatMoveOnceMoreAfterOthers) {
  const TriangleMesh mesh = rotated(flat_lattice(6), Vec3(1, 2, 3), 1);
  Surface surface(mesh);
  const DeviationBound bound(mesh, 1e-9);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.02, 0.02);
  std::vector<Vec3> points = mesh.points;
  for (int round = 0; round < 10; ++round) {
    for (VertexId v = 0; v < points.size(); ++v) {
      if (v / 7 % 6 == 0 || v % 7 % 6 == 0) continue;  // the border stays
      const Vec3 to = points[v] + uniform(random) * (mesh.points[1] - mesh.points[0]) + uniform(random) * (mesh.points[7] - mesh.points[0]);
      const Operation move = move_of(surface, points[v], to);
      ASSERT_TRUE(allows(bound, surface, move)) << "vertex " << v << ", round " << round;
      surface.apply(move);
      points[v] = to;
    }
  }
}

TEST(DeviationBound, RefusesAVertexLiftedAboveTheBoundAndNoLower) {
  const TriangleMesh mesh = flat_lattice(6);
  const Surface surface(mesh);
  const Vec3 p = mesh.points[3 * 7 + 3];
  for (const double epsilon : {1e-6, 0.01, 0.3, 1.0, 4.0}) {
    const DeviationBound bound(mesh, epsilon);
    EXPECT_TRUE(allows(bound, surface, move_of(surface, p, p + Vec3(0, 0, 0.999 * epsilon)))) << epsilon;
    EXPECT_FALSE(allows(bound, surface, move_of(surface, p, p + Vec3(0, 0, 1.001 * epsilon)))) << epsilon;
  }
}

/// Cutting a spike off leaves nothing new far from the input; what is far is the spike's tip from all that is left.
TEST(DeviationBound, RefusesToLeaveASpikeOfTheInputBehind) {
  const VertexId middle = 3 * 7 + 3;
  TriangleMesh mesh = flat_lattice(6);
  const Vec3 base = mesh.points[middle];
  mesh.points[middle][2] = 1;
  const Surface surface(mesh);
  const Operation cut = move_of(surface, mesh.points[middle], base);
  EXPECT_LT(distance_from_surface(base, mesh), 0.75);
  EXPECT_FALSE(allows(DeviationBound(mesh, 0.99), surface, cut));
  EXPECT_TRUE(allows(DeviationBound(mesh, 1.01), surface, cut));
}

TEST(DeviationBound, RefusesToOpenAHole) {
  const TriangleMesh mesh = icosphere(3);
  const Surface surface(mesh);
  const DeviationBound bound(mesh, 0.01);
  EXPECT_FALSE(allows(bound, surface, {{17}, {}}));
  EXPECT_FALSE(allows(bound, surface, {{17, 18}, {surface.corners(17)}}));
}

/// The input's two triangles are far larger than the hole, and their middles far from it.
TEST(DeviationBound, RefusesToOpenAHoleSmallBesideTheInputsTriangles) {
  const Surface surface(flat_lattice(60));
  const TriangleMesh input = scaled(flat_lattice(1), 60);
  const Vec3 corner = surface.mesh().points[3 * 61 + 3];
  Operation hole = move_of(surface, corner, corner);
  hole.new_triangles.clear();
  EXPECT_FALSE(allows(DeviationBound(input, 0.5), surface, hole));
  EXPECT_TRUE(allows(DeviationBound(input, 0.8), surface, hole));  // its rim is √½ from the middle
}

/// Of a fine lattice, so that whole groups of the input's triangles are looked at at once.
TEST(DeviationBound, RefusesAHoleOfManyTrianglesThatIsWiderThanTheBoundAndNoNarrower) {
  const TriangleMesh input = rotated(flat_lattice(40), Vec3(1, 2, 3), 0.4);
  const Surface surface(input);
  const Vec3 middle = input.points[20 * 41 + 20] + Vec3(0.1, 0.03, 0);
  for (const double epsilon : {4.0, 6.0, 9.0}) {
    Operation wide, narrow;
    for (FaceId f = 0; f < input.triangles.size(); ++f) {
      const Corners t = surface.corners(f);
      const auto is_closer = [&](double distance) { return [&, distance](const Vec3& p) { return (p - middle).norm() < distance; }; };
      if (distance_from_surface(middle, {{t[0], t[1], t[2]}, {{0, 1, 2}}}) < 1.01 * epsilon) wide.old_faces.push_back(f);
      if (std::all_of(t.begin(), t.end(), is_closer(0.95 * epsilon))) narrow.old_faces.push_back(f);
    }
    EXPECT_FALSE(allows(DeviationBound(input, epsilon), surface, wide)) << epsilon;
    EXPECT_TRUE(allows(DeviationBound(input, epsilon), surface, narrow)) << epsilon;
  }
}

/// The promise, against CGAL's distances of dense samples.
TEST(DeviationBound, HoldsThroughHundredsOfRandomOperations) {
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    const TriangleMesh input = noisy(icosphere(2), seed % 2 == 0 ? 0.0 : 0.1, seed);
    const double epsilon = std::array{0.02, 0.05, 0.1, 0.3}[seed % 4];
    const DeviationBound bound(input, epsilon);
    Surface surface(input);
    RandomOperations random(seed, 2 * epsilon);
    int allowed = 0, refused = 0;
    for (int i = 0; i < 500; ++i) {
      const Operation operation = random(surface);
      const bool is_allowed = allows(bound, surface, operation);
      (is_allowed ? allowed : refused)++;
      if (is_allowed) surface.apply(operation);
    }
    const TriangleMesh result = surface.without_gone_triangles();
    EXPECT_LE(sampled_distance(result, input, 5), epsilon) << "seed " << seed;
    EXPECT_LE(sampled_distance(input, result, 5), epsilon) << "seed " << seed;
    const TwoSidedDistance distance = two_sided_distance(result, input, 1e-4);
    EXPECT_LE(distance.lower(), epsilon) << "seed " << seed;
    EXPECT_GT(distance.upper(), 0.9 * epsilon) << "refuses far below the bound; seed " << seed;
    EXPECT_GT(allowed, 40) << "seed " << seed;
    EXPECT_GT(refused, 20) << "seed " << seed;
  }
}

/// What is refused really comes close to the bound: the sampled distance after it, on a fresh surface.
TEST(DeviationBound, RefusesNothingThatIsClearlyWithin) {
  const TriangleMesh input = noisy(icosphere(2), 0.05, 9);
  const Surface surface(input);
  RandomOperations random(9, 0.1);
  int refused = 0;
  for (int i = 0; i < 150; ++i) {
    const Operation operation = random(surface);
    Surface after = surface;
    after.apply(operation);
    const double distance = two_sided_distance(after.without_gone_triangles(), input, 1e-4).upper();
    for (const double epsilon : {0.02, 0.05, 0.2}) {
      const bool is_allowed = allows(DeviationBound(input, epsilon), surface, operation);
      const std::string what = "operation " + std::to_string(i) + ", bound " + std::to_string(epsilon);
      if (is_allowed) {
        EXPECT_LE(distance, epsilon + 1e-4) << what;
      } else {
        EXPECT_GT(distance, 0.95 * epsilon) << what;
      }
      refused += is_allowed ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 50);
}

TEST(DeviationBound, ABoundOfManyEdgesAllowsWhatMovesLittleBesideOtherSheets) {
  // Two spheres, one in the other, closer than the bound.
  const TriangleMesh input = joined(icosphere(3), icosphere(3, 0.7));
  const double epsilon = 0.31;
  const DeviationBound bound(input, epsilon);
  Surface surface(input);
  for (VertexId v = 0; v < input.points.size(); v += 5) {
    const Operation move = move_of(surface, input.points[v], 1.03 * input.points[v]);
    ASSERT_TRUE(allows(bound, surface, move)) << v;
    surface.apply(move);
  }
  EXPECT_LE(two_sided_distance(surface.mesh(), input, 1e-4).lower(), epsilon);
}

TEST(DeviationBound, ReadsNothingBeyondItsReach) {
  const TriangleMesh input = noisy(icosphere(3), 0.01, 2);
  RandomOperations random(2, 0.05);
  const Surface surface(input);
  int spoiled = 0;
  for (const double epsilon : {0.01, 0.05, 0.2}) {
    const DeviationBound bound(input, epsilon);
    for (int i = 0; i < 60; ++i) {
      const Operation operation = random(surface);
      Box patch;
      for (const FaceId f : operation.old_faces) patch.unite(surface.grid().box(f));
      const Box reach = bound.reach(patch);
      TriangleMesh without = input;
      for (FaceId f = 0; f < without.triangles.size(); ++f) {
        if (surface.grid().box(f).overlaps(reach)) continue;
        without.triangles[f] = {0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF};  // reading it would be found by the sanitizers, or crash
        ++spoiled;
      }
      EXPECT_EQ(bound.allows(without, surface.grid(), operation.old_faces, operation.new_triangles), allows(bound, surface, operation));
    }
  }
  EXPECT_GT(spoiled, 10000);
}

TEST(DeviationBound, AnswersTheSameAfterARigidMotionAndFarFromTheOrigin) {
  const TriangleMesh input = noisy(icosphere(2), 0.05, 4);
  const auto turned = [](const TriangleMesh& mesh) { return rotated(mesh, Vec3(1, 2, 2), 0.7); };
  const auto shifted = [](const TriangleMesh& mesh) { return translated(mesh, Vec3(1e6, -1e6, 1e6)); };
  const Surface surface(input);
  RandomOperations random(4, 0.06);
  for (int i = 0; i < 300; ++i) {
    const Operation operation = random(surface);
    TriangleMesh as_mesh;
    for (const Corners& t : operation.new_triangles) {
      const auto first = static_cast<VertexId>(as_mesh.points.size());
      as_mesh.points.insert(as_mesh.points.end(), t.begin(), t.end());
      as_mesh.triangles.push_back({first, first + 1, first + 2});
    }
    const bool expected = allows(DeviationBound(input, 0.03), surface, operation);
    for (const auto& motion : {std::function<TriangleMesh(const TriangleMesh&)>(turned), {shifted}}) {
      const Surface moved(motion(input));
      Operation moved_operation{operation.old_faces, {}};
      const TriangleMesh moved_triangles = motion(as_mesh);
      for (const auto& [a, b, c] : moved_triangles.triangles)
        moved_operation.new_triangles.push_back({moved_triangles.points[a], moved_triangles.points[b], moved_triangles.points[c]});
      EXPECT_EQ(allows(DeviationBound(moved.mesh(), 0.03), moved, moved_operation), expected) << i;
    }
  }
}

TEST(DeviationBound, TakesDegenerateTrianglesOnBothSides) {
  TriangleMesh input = flat_lattice(6);
  const auto n = static_cast<VertexId>(input.points.size());
  input.points.insert(input.points.end(), {{2, 2, 0}, {3.5, 2, 0}, {5, 2, 0}, {3, 3, 1e-13}});
  input.triangles.insert(input.triangles.end(), {{n, n + 1, n + 2}, {n, n, n}, {n, n + 2, n + 3}, {n, n + 1, n}});
  const Surface surface(input);
  const DeviationBound bound(input, 1e-6);
  const auto count = static_cast<FaceId>(input.triangles.size());
  EXPECT_TRUE(allows(bound, surface, rebuilt(surface, {count - 1, count - 2, count - 3, count - 4})));
  EXPECT_TRUE(allows(bound, surface, {{count - 4}, {{input.points[n], input.points[n], input.points[n + 1]}}}));
  EXPECT_FALSE(allows(bound, surface, {{count - 4}, {{input.points[n], input.points[n], Vec3(3, 3, 1)}}}));
}

TEST(DeviationBound, RefusesWhatIsNotFinite) {
  const TriangleMesh input = icosphere(2);
  const Surface surface(input);
  const DeviationBound bound(input, 0.5);
  for (const double x : {kNaN, HUGE_VAL}) {
    Operation operation = rebuilt(surface, {3, 4});
    operation.new_triangles[1][2][0] = x;
    EXPECT_FALSE(allows(bound, surface, operation)) << x;
  }
}

TEST(DeviationBound, NothingIsNearAnEmptyInput) {
  const Surface surface(cube());
  EXPECT_FALSE(allows(DeviationBound({}, 10), surface, rebuilt(surface, {0})));
  EXPECT_TRUE(allows(DeviationBound({}, 10), surface, {{0}, {}}));
}

TEST(DeviationBound, MustBeAPositiveLength) {
  for (const double epsilon : {0.0, -1.0, HUGE_VAL, kNaN}) EXPECT_THROW(DeviationBound(cube(), epsilon), InvalidOption) << epsilon;
}

TEST(DeviationBound, AnswersManyThreadsAtOnce) {
  const TriangleMesh input = noisy(icosphere(3), 0.01, 5);
  const Surface surface(input);
  const DeviationBound bound(input, 0.02);
  RandomOperations random(5, 0.05);
  std::vector<Operation> operations;
  std::vector<int> expected;
  for (int i = 0; i < 400; ++i) {
    operations.push_back(random(surface));
    expected.push_back(allows(bound, surface, operations.back()) ? 1 : 0);
  }
  std::vector<int> answers(operations.size());
  tbb::parallel_for(std::size_t{0}, operations.size(), [&](std::size_t i) { answers[i] = allows(bound, surface, operations[i]) ? 1 : 0; });
  EXPECT_EQ(answers, expected);
}

}  // namespace
}  // namespace smopt
