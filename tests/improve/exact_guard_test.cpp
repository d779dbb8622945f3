#include "smopt/improve/exact_guard.h"

#include <cmath>
#include <random>

#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace smopt::testing;
using ::testing::IsEmpty;
using ::testing::Not;

/// A mesh whose vertices are moved one by one under the guard.
class GuardedMesh {
 public:
  explicit GuardedMesh(const TriangleMesh& mesh)
      : mesh_(mesh), rings_(build_rings(mesh).value()), surface_(mesh_, rings_), move_(mesh_, rings_), guard_(surface_) {}

  void select(VertexId v, const Vec3& reach) {
    guard_.enter({&v, 1}, nullptr);
    move_.select(v);
    guard_.select(move_, reach);
  }
  bool is_move_ok(const Vec3& target) {
    move_.aim(target);
    return guard_.is_ok();
  }
  void apply() { guard_.apply(); }
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }

 private:
  TriangleMesh mesh_;
  VertexRings rings_;
  GuardedSurface surface_;
  StarMove move_;
  ExactGuard guard_;
};

/// The guard's answer about one move of a fresh mesh.
bool is_ok(const TriangleMesh& mesh, VertexId v, const Vec3& target) {
  GuardedMesh guarded(mesh);
  guarded.select(v, target);
  return guarded.is_move_ok(target);
}

TriangleMesh moved(TriangleMesh mesh, VertexId v, const Vec3& target) {
  mesh.points[v] = target;
  return mesh;
}

/// Whether CGAL sees a new pair at one of the sampled moments of the move; the end is one of them.
bool meets_at_some_moment(const TriangleMesh& mesh, VertexId v, const Vec3& target, int samples) {
  const std::vector<FacePair> pairs_before = intersecting_pairs(mesh);
  for (int i = samples; i > 0; --i) {
    const Vec3 at = i == samples ? target : Vec3(mesh.points[v] + (target - mesh.points[v]) * i / samples);
    if (!new_pairs(pairs_before, moved(mesh, v, at)).empty()) return true;
  }
  return false;
}

/// Plate of 4 × 4 squares, 1 thick; its middle point on top is at (2, 2, 0.5), with neighbours 1 or √2 away.
constexpr VertexId kMiddle = 2 * 5 + 2;
const Vec3 kMiddlePosition(2, 2, 0.5);

/// A tip of valence 3 over the first face of a sphere of radius 1 (80 faces), `height` above the face.
TriangleMesh sphere_with_tip(double height) {
  TriangleMesh mesh = icosphere(1);
  const auto [a, b, c] = mesh.triangles.front();
  const Vec3 normal = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).normalized();
  const auto tip = static_cast<VertexId>(mesh.points.size());
  mesh.points.emplace_back((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3 + height * normal);
  mesh.triangles.front() = {a, b, tip};
  mesh.triangles.insert(mesh.triangles.end(), {{b, c, tip}, {c, a, tip}});
  return mesh;
}

TEST(ExactGuard, LetsAFlatStarSlideInItsPlane) {
  const TriangleMesh mesh = plate(4, 1);
  EXPECT_TRUE(is_ok(mesh, kMiddle, {2.3, 2.2, 0.5}));
  EXPECT_TRUE(is_ok(mesh, kMiddle, {1.7, 2.1, 0.5}));
}

TEST(ExactGuard, RefusesAStarThatFoldsOverInItsPlane) {
  const TriangleMesh mesh = plate(4, 1);
  ASSERT_FALSE(new_pairs(mesh, moved(mesh, kMiddle, {3.2, 2.1, 0.5})).empty());
  EXPECT_FALSE(is_ok(mesh, kMiddle, {3.2, 2.1, 0.5}));
}

TEST(ExactGuard, RefusesATargetThatMakesATriangleDegenerate) {
  const TriangleMesh mesh = plate(4, 1);
  EXPECT_FALSE(is_ok(mesh, kMiddle, {3, 2, 0.5})) << "onto a neighbour";
  EXPECT_FALSE(is_ok(mesh, kMiddle, {2.5, 3, 0.5})) << "onto the edge between two neighbours";
  EXPECT_TRUE(is_ok(mesh, kMiddle, {2.5, 2.75, 0.5})) << "short of it";
}

TEST(ExactGuard, RefusesATargetOnTheLineOfARingEdgeWhereverItIs) {
  // Small whole multiples of 1/64, so that the target is collinear with the edge exactly.
  TriangleMesh mesh = noisy(spiky(icosphere(1), 5, 2), 0.1, 5);
  for (Vec3& p : mesh.points) p = (64 * p).array().round() / 64;
  const VertexRings rings = build_rings(mesh).value();
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    for (std::size_t i = 0; i < rings.valence(v); ++i) {
      const Vec3 a = mesh.points[rings.vertices(v)[i]], b = mesh.points[rings.vertices(v)[(i + 1) % rings.valence(v)]];
      for (const double t : {-2.0, -1.0, -0.25, 0.25, 0.5, 1.25, 2.0, 3.0}) {
        const Vec3 target = a + t * (b - a);
        EXPECT_FALSE(is_ok(mesh, v, target)) << "vertex " << v << ", edge " << i << ", t " << t;
      }
    }
  }
}

TEST(ExactGuard, RefusesToTouchACornerOfAnotherComponentWithAFaceOfTheStar) {
  // At the target the star's face is in the plane z = 2.5 − 2 (x − 2); the component's corner lies on it, the rest of it beyond.
  const Vec3 target(2, 2, 2.5);
  const TriangleMesh diamond = translated(scaled(octahedron(), 0.125), {2.625, 2.25, 1.5});
  EXPECT_FALSE(is_ok(joined(plate(4, 1), diamond), kMiddle, target));
  EXPECT_TRUE(is_ok(joined(plate(4, 1), translated(diamond, {std::ldexp(1, -40), 0, 0})), kMiddle, target));
}

TEST(ExactGuard, RefusesToTouchAnotherSheetButAllowsTheLastDoubleBeforeIt) {
  const TriangleMesh mesh = plate(4, 1);
  EXPECT_FALSE(is_ok(mesh, kMiddle, {2.1, 2.2, -0.5})) << "touching counts";
  EXPECT_FALSE(is_ok(mesh, kMiddle, {2.1, 2.2, -0.6}));
  EXPECT_TRUE(is_ok(mesh, kMiddle, {2.1, 2.2, std::nextafter(-0.5, 0.0)}));
  EXPECT_FALSE(is_ok(mesh, kMiddle, {2, 2, -0.5})) << "onto a vertex of it";
}

TEST(ExactGuard, RefusesToTouchASheetOfAnotherComponentButAllowsTheLastDoubleBeforeIt) {
  const TriangleMesh mesh = joined(plate(4, 1), translated(plate(3, 1), {0.3, 0.4, 2}));
  EXPECT_FALSE(is_ok(mesh, kMiddle, {2, 2, 1.5}));
  EXPECT_TRUE(is_ok(mesh, kMiddle, {2, 2, std::nextafter(1.5, 0.0)}));
}

TEST(ExactGuard, RefusesASpikeThroughASheetEvenWhenItsTipIsBeyond) {
  const TriangleMesh mesh = joined(plate(4, 1), translated(plate(4, 0.01), {0, 0, 2}));
  EXPECT_FALSE(is_ok(mesh, kMiddle, {2, 2, 10}));
}

TEST(ExactGuard, AllowsATipOfValenceThreeToGoThroughItsBasePlaneWhenNothingIsThere) {
  for (const double height : {0.3, 1.0, 30.0}) {
    const TriangleMesh mesh = sphere_with_tip(height);
    const auto tip = static_cast<VertexId>(mesh.points.size() - 1);
    const Vec3 inside = -0.1 * mesh.points[tip].normalized();
    ASSERT_THAT(new_pairs(mesh, moved(mesh, tip, inside)), IsEmpty());
    EXPECT_TRUE(is_ok(mesh, tip, inside)) << "height " << height;
  }
}

TEST(ExactGuard, RefusesATipThatWouldSweepOverAComponentThatIsFreeAtBothEnds) {
  const double height = 3;
  const TriangleMesh sphere = sphere_with_tip(height);
  const auto tip = static_cast<VertexId>(sphere.points.size() - 1);
  const Vec3 direction = sphere.points[tip].normalized();
  const Vec3 inside = -0.1 * direction;
  // Within the tip's cone: inside the surface before the move, outside after it, and clear of it both times.
  const TriangleMesh speck = icosphere(0, 0.02, 1.5 * direction);
  const TriangleMesh mesh = joined(sphere, speck);
  ASSERT_THAT(mesh, HasNoIntersections());
  ASSERT_THAT(moved(mesh, tip, inside), HasNoIntersections());
  ASSERT_NEAR(winding_number(sphere, 1.5 * direction), 1, 1e-9);
  ASSERT_NEAR(winding_number(moved(sphere, tip, inside), 1.5 * direction), 0, 1e-9);
  EXPECT_FALSE(is_ok(mesh, tip, inside));
  EXPECT_TRUE(is_ok(joined(sphere, translated(speck, 3 * direction)), tip, inside)) << "the same speck beyond the tip";
}

TEST(ExactGuard, RefusesToSwallowAComponentWithoutTouchingIt) {
  const TriangleMesh speck = icosphere(0, 0.02, {2, 2, 1});
  const TriangleMesh mesh = joined(plate(4, 1), speck);
  ASSERT_THAT(moved(mesh, kMiddle, {2, 2, 3}), HasNoIntersections());
  EXPECT_FALSE(is_ok(mesh, kMiddle, {2, 2, 3}));
  EXPECT_TRUE(is_ok(plate(4, 1), kMiddle, {2, 2, 3}));
}

TEST(ExactGuard, RefusesToSwallowAComponentWithAllItsCornersOnTheWallsBetweenSweptTetrahedra) {
  const TriangleMesh mesh = joined(octahedron(), translated(scaled(octahedron(), 0.125), {0, 0, 2}));
  ASSERT_THAT(moved(mesh, 4, {0, 0, 8}), HasNoIntersections());
  EXPECT_FALSE(is_ok(mesh, 4, {0, 0, 8}));
  EXPECT_TRUE(is_ok(octahedron(), 4, {0, 0, 8}));
}

TEST(ExactGuard, RefusesToJumpPastAThinPlateInTheWay) {
  // The plate fits into the tetrahedra that the star sweeps; at the end it lies inside the spike.
  const TriangleMesh thin = translated(scaled(plate(2, 1e-6), 0.05), {1.95, 1.95, 1});
  const TriangleMesh mesh = joined(plate(4, 1), thin);
  ASSERT_THAT(moved(mesh, kMiddle, {2, 2, 5}), HasNoIntersections());
  EXPECT_FALSE(is_ok(mesh, kMiddle, {2, 2, 5}));
}

TEST(ExactGuard, AcceptsATargetThatIsAHalvedStepAfterTheWholeOneWasRefused) {
  TriangleMesh mesh = plate(4, 1);
  GuardedMesh guard(mesh);
  const Vec3 step(0.1, 0.1, -2);
  guard.select(kMiddle, kMiddlePosition + step);
  EXPECT_FALSE(guard.is_move_ok(kMiddlePosition + step));
  EXPECT_FALSE(guard.is_move_ok(kMiddlePosition + 0.5 * step));
  ASSERT_TRUE(guard.is_move_ok(kMiddlePosition + 0.25 * step));
  guard.apply();
  EXPECT_EQ(guard.mesh().points[kMiddle], kMiddlePosition + 0.25 * step);
  EXPECT_THAT(guard.mesh(), HasNoIntersections());
}

TEST(ExactGuard, KnowsWhereTrianglesHaveMovedTo) {
  TriangleMesh mesh = joined(plate(4, 1), translated(plate(4, 1), {0, 0, 3}));
  GuardedMesh guard(mesh);
  const auto other = static_cast<VertexId>(50 + 25 + kMiddle);  // middle of the upper plate's bottom, at z = 2.5
  guard.select(kMiddle, {2, 2, 2});
  ASSERT_TRUE(guard.is_move_ok({2, 2, 2}));
  guard.apply();
  guard.select(other, {2, 2, 1.5});
  EXPECT_FALSE(guard.is_move_ok({2, 2, 1.5})) << "the first spike is there now";
  guard.select(kMiddle, kMiddlePosition);
  ASSERT_TRUE(guard.is_move_ok(kMiddlePosition));
  guard.apply();
  guard.select(other, {2, 2, 1.5});
  EXPECT_TRUE(guard.is_move_ok({2, 2, 1.5})) << "and now it is not";
}

TEST(ExactGuard, SeesACrossingAtAnyDepthNextToTheMiddleOfTheCoordinates) {
  // The plane of the other sheet is 5e-18 from zero, where boxes in single precision are sharpest; the vertex goes beyond it by 1e-18.
  const TriangleMesh lower = translated(plate(4, 1), {-2, -2, -0.6});  // top at −0.1
  TriangleMesh upper = translated(plate(3, 1), {-1.4, -1.3, 0.6});     // bottom moved to 5e-18
  for (Vec3& p : upper.points)
    if (p[2] < 0.5) p[2] = 5e-18;
  const TriangleMesh mesh = joined(lower, upper);
  ASSERT_THAT(mesh, HasNoIntersections());
  const Vec3 target(0, 0, 6e-18);
  ASSERT_FALSE(new_pairs(mesh, moved(mesh, kMiddle, target)).empty());
  EXPECT_FALSE(is_ok(mesh, kMiddle, target));
}

/// A pyramid over a regular hexagon that lies exactly in the plane x + y + z = 0, and one below it; vertex 0 is the upper tip.
TriangleMesh hexagonal_bipyramid(const Vec3& tip, double s) {
  TriangleMesh mesh{{tip, {-s, -s, -s}, {s, -s, 0}, {s, 0, -s}, {0, s, -s}, {-s, s, 0}, {-s, 0, s}, {0, -s, s}}, {}};
  for (VertexId i = 0; i < 6; ++i) {
    const VertexId a = 2 + i, b = 2 + (i + 1) % 6;
    mesh.triangles.insert(mesh.triangles.end(), {{0, a, b}, {1, b, a}});
  }
  return enclosed_volume(mesh) > 0 ? mesh : reversed(mesh);
}

TEST(ExactGuard, DecidesTheFoldOfAStarExactlyWhenItsTipComesFromFarAway) {
  // The needle's tip comes back to the plane of its base, beyond an edge of the base by less than a unit in the needle's last place.
  constexpr double kSize = 0.7;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 300; ++i) {
    const double length = std::pow(10.0, 2 + 3 * uniform(random));
    TriangleMesh mesh = hexagonal_bipyramid(Vec3::Constant(length), kSize);
    GuardedMesh guard(mesh);
    const Vec3 aside = Vec3::Constant(length) + Vec3(uniform(random), uniform(random), uniform(random));
    guard.select(0, aside);
    ASSERT_TRUE(guard.is_move_ok(aside));
    guard.apply();
    // Beyond the edge x = 0.7, −0.7 < y < 0; multiples of 2⁻⁵³, so that the target lies exactly in the plane.
    const double x = kSize + std::ldexp(std::floor(1 + 30 * uniform(random)), -53);
    const double y = -std::ldexp(std::floor(std::ldexp(kSize * uniform(random), 53)), -53);
    const Vec3 target(x, y, -x - y);
    ASSERT_THAT(moved(mesh, 0, target), Not(HasNoIntersections()));
    guard.select(0, target);
    EXPECT_FALSE(guard.is_move_ok(target)) << "attempt " << i << ", length " << length;
  }
}

/// Random moves of random vertices against CGAL's opinion of sampled moments.
class RandomMoves : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(RandomMoves, AreAcceptedOnlyWhenNothingIsMetOnTheWayAndRefusedHardlyEverElse) {
  SCOPED_TRACE(GetParam());
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> uniform(-1, 1);
  const TriangleMesh mesh = joined(joined(noisy(icosphere(1), 0.1, GetParam()), noisy(icosphere(0, 0.3), 0.1, GetParam() + 1)),
                                   noisy(torus(0.6, 0.1, 12, 6), 0.03, GetParam() + 2));
  const TriangleMesh start = relabelled(mesh, GetParam());
  ASSERT_THAT(start, HasNoIntersections());
  std::uniform_int_distribution<VertexId> any_vertex(0, static_cast<VertexId>(start.vertex_count() - 1));
  int accepted = 0, refused = 0, refused_in_vain = 0;
  for (int i = 0; i < 60; ++i) {
    const VertexId v = any_vertex(random);
    const Vec3 target = start.points[v] + 0.5 * Vec3(uniform(random), uniform(random), uniform(random));
    const bool ok = is_ok(start, v, target);
    const bool meets = meets_at_some_moment(start, v, target, ok ? 12 : 100);
    EXPECT_FALSE(ok && meets) << "move " << i << " of vertex " << v;
    ok ? ++accepted : ++refused;
    refused_in_vain += !ok && !meets ? 1 : 0;
  }
  EXPECT_GT(accepted, 5);
  EXPECT_GT(refused, 5);
  EXPECT_LE(refused_in_vain, 3);  // contacts between two samples
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomMoves, ::testing::Range(0U, 8U));

}  // namespace
}  // namespace smopt
