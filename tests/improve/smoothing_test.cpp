#include "smopt/improve/smoothing.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <numeric>

#include "baselines/laplacian.h"
#include "smopt/error.h"
#include "smopt/improve/sweep_schedule.h"
#include "smopt/mesh/rings.h"
#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace smopt::testing;
using ::testing::AnyOf;
using ::testing::IsEmpty;
using ::testing::Not;

TriangleMesh smoothed(TriangleMesh mesh, const SmoothingOptions& options = {}) {
  smooth(mesh, options);
  return mesh;
}

/// Thresholds that keep nearly every vertex active, so that many moves are made.
SmoothingOptions eager(StepRule step, int rounds = 12) {
  SmoothingOptions options;
  options.rounds = rounds;
  options.thresholds = {0.9, 50};
  options.step = step;
  options.keeps_angles = false;
  return options;
}

std::vector<SmoothingOptions> all_kinds_of_options() {
  SmoothingOptions classic;
  SmoothingOptions no_halving = eager(StepRule::umbrella);
  no_halving.halvings = 0;
  return {classic, eager(StepRule::umbrella), eager(StepRule::volume_preserving), eager(StepRule::tangential), no_halving};
}

// ---- The guarantee ----

struct HardMesh {
  std::string name;
  TriangleMesh mesh;
};

/// Every kind of trouble, with the noise of one seed. Some have intersecting pairs to begin with.
std::vector<HardMesh> hard_meshes(std::uint32_t seed) {
  const TriangleMesh sphere = icosphere(2);
  return {
      {"noisy sphere", noisy(sphere, 0.1, seed)},
      {"sphere with intersections", noisy(sphere, 0.25, seed)},
      {"noisy torus", noisy(torus(1, 0.35, 30, 12), 0.05, seed)},
      {"outer sphere 1e-9 above an inner one", joined(scaled(noisy(sphere, 0.08, seed), 1 + 1e-9), noisy(sphere, 0.08, seed))},
      {"inner sphere 1e-9 below an outer one", joined(noisy(sphere, 0.08, seed), scaled(noisy(sphere, 0.08, seed), 1 + 1e-9))},
      {"fast shell around a slow sphere", joined(noisy(icosphere(1), 0.03, seed), noisy(icosphere(3, 0.8), 0.02, seed))},
      {"thin plate", noisy(plate(8, 0.05), 0.02, seed)},
      {"two plates on a sheet", plates_on_a_noisy_sheet(1e-9, seed)},
      {"linked rings", noisy(linked_rings(), 0.03, seed)},
      {"knotted tube", noisy(knotted_tube(), 0.03, seed)},
      {"needles with a speck in one", needles_with_a_speck_in_one()},
      {"dents with things in one", dents_with_things_in_one()},
      {"surface of a random molecule", random_molecule_surface(40, seed)},
      {"sphere with needles", noisy(spiky(sphere, 5, 4), 0.03, seed)},
      {"sphere with dents that nearly meet", noisy(spiky(sphere, 7, 0.05), 0.02, seed)},
      {"nested components",
       joined(joined(noisy(sphere, 0.05, seed), noisy(icosphere(1, 0.7), 0.05, seed)), noisy(torus(0.3, 0.1, 12, 6), 0.03, seed))},
      {"redundant points", with_points_in_faces(noisy(icosphere(1), 0.1, seed), seed)},
      {"flat stars and points on edges", with_points_on_edges(plate(4, 1), seed)},
      {"pyramids of valence 3", noisy(with_points_in_faces(icosphere(1), seed), 0.15, seed)},
  };
}

class ManySeeds : public ::testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Smoothing, ManySeeds, ::testing::Range(1U, 4U));

TEST_P(ManySeeds, NeverCreateAnIntersectingPairOnAnyMeshWithAnyOptions) {
  for (const auto& [name, mesh] : hard_meshes(GetParam())) {
    const std::vector<FacePair> pairs_before = intersecting_pairs(mesh);
    for (const SmoothingOptions& options : all_kinds_of_options()) {
      SCOPED_TRACE(fmt::format("{}, seed {}, step {}, {} halvings", name, GetParam(), static_cast<int>(options.step), options.halvings));
      const TriangleMesh after = smoothed(mesh, options);
      EXPECT_EQ(after.triangles, mesh.triangles);
      EXPECT_THAT(new_pairs(pairs_before, after), IsEmpty());
      EXPECT_TRUE(std::all_of(after.points.begin(), after.points.end(), [](const Vec3& p) { return p.allFinite(); }));
    }
  }
}

TEST_P(ManySeeds, KeepTheGuaranteeUnderRigidMotionScaleAndRelabelling) {
  const std::uint32_t seed = GetParam();
  const TriangleMesh base = joined(noisy(spiky(icosphere(2), 7, 0.1), 0.02, seed), noisy(icosphere(1, 0.08), 0.01, seed));
  ASSERT_THAT(base, HasNoIntersections());
  const std::vector<HardMesh> variants = {
      {"rotated", rotated(base, {1, 2, 3}, seed)},
      {"scaled by 1e-6", scaled(base, 1e-6)},
      {"scaled by 1e6", scaled(base, 1e6)},
      {"1e6 from the origin", translated(base, {1e6, -1e6, 1e6})},
      {"relabelled", relabelled(base, seed)},
      {"all of it", relabelled(translated(rotated(scaled(base, 30), {0, 1, 1}, seed), {1e6, 0, -1e5}), seed)},
  };
  for (const auto& [name, mesh] : variants) {
    SCOPED_TRACE(fmt::format("{}, seed {}", name, seed));
    // Rounding to coarser coordinates may itself make pairs; they must not become more.
    EXPECT_THAT(new_pairs(mesh, smoothed(mesh)), IsEmpty());
    EXPECT_THAT(new_pairs(mesh, smoothed(mesh, eager(StepRule::umbrella))), IsEmpty());
  }
}

TEST_P(ManySeeds, NeverAddToThePairsOfAMeshThatHasSome) {
  const TriangleMesh mesh = noisy(icosphere(2), 0.3, GetParam());
  ASSERT_THAT(mesh, Not(HasNoIntersections()));
  EXPECT_THAT(new_pairs(mesh, smoothed(mesh)), IsEmpty()) << "seed " << GetParam();
}

TEST(Smoothing, IsPutToTheTestByMeshesOnWhichUnguardedStepsIntersect) {
  int with_pairs = 0;
  for (const auto& [name, mesh] : hard_meshes(1)) {
    bool has_pairs = false;
    for (const int rounds : {1, 5, 20}) {
      TriangleMesh unguarded = mesh;
      baselines::smooth_laplacian(unguarded, {rounds, 1, baselines::SweepOrder::gauss_seidel});
      has_pairs |= !new_pairs(mesh, unguarded).empty();
    }
    with_pairs += has_pairs ? 1 : 0;
  }
  EXPECT_GE(with_pairs, 6);
}

/// Smooths a sphere in whose needle or dent other components float: their vertices stay inside (1) or outside (0) of it, though the
/// vertex that makes the needle or dent would be free at rest once it had passed over them.
void expect_to_keep_floating_things(const TriangleMesh& mesh, int winding) {
  ASSERT_THAT(mesh, HasNoIntersections());
  const std::size_t sphere_triangles = icosphere(2).triangle_count(), sphere_points = icosphere(2).vertex_count();
  const TriangleMesh alone = part_of(mesh, 0, sphere_triangles);
  const Vec3 place = mesh.points[sphere_points];
  ASSERT_NEAR(winding_number(alone, place), winding, 1e-6);
  ASSERT_NEAR(winding_number(smoothed(alone), place), 1 - winding, 1e-6) << "without them the vertex passes over the place";
  for (const SmoothingOptions& options : all_kinds_of_options()) {
    const TriangleMesh after = smoothed(mesh, options), sphere = part_of(after, 0, sphere_triangles);
    for (std::size_t v = sphere_points; v < after.vertex_count(); ++v)
      EXPECT_NEAR(winding_number(sphere, after.points[v]), winding, 1e-6) << "vertex " << v << ", step " << static_cast<int>(options.step);
    EXPECT_THAT(after, HasNoIntersections());
  }
}

TEST(Smoothing, DoesNotPassThroughASmallComponentThatWouldBeFreeAtRest) {
  expect_to_keep_floating_things(needles_with_a_speck_in_one(), 1);
}

TEST(Smoothing, DoesNotSwallowASmallComponentOrAThinSheet) {
  expect_to_keep_floating_things(dents_with_things_in_one(), 0);
}

TEST(Smoothing, KeepsTwoSheetsInTheirOrder) {
  const TriangleMesh mesh = plates_on_a_noisy_sheet(1e-9, 3);
  ASSERT_THAT(mesh, HasNoIntersections());
  const TriangleMesh after = smoothed(mesh, eager(StepRule::umbrella, 50));
  EXPECT_THAT(after, HasNoIntersections());
  const TriangleMesh lower = part_of(after, 0, mesh.triangle_count() / 2);
  for (std::size_t v = mesh.vertex_count() / 2; v < mesh.vertex_count(); ++v) EXPECT_LT(winding_number(lower, after.points[v]), 0.99);
}

TEST(Smoothing, KeepsLinkedRingsLinked) {
  const TriangleMesh mesh = linked_rings();
  ASSERT_THAT(mesh, HasNoIntersections());
  TriangleMesh unguarded = mesh;
  baselines::smooth_laplacian(unguarded, {100, 1, baselines::SweepOrder::gauss_seidel});
  ASSERT_THAT(unguarded, Not(HasNoIntersections()));
  EXPECT_THAT(smoothed(mesh, eager(StepRule::umbrella, 100)), HasNoIntersections());
}

// ---- What it does ----

TEST(Smoothing, KeepsConnectivityAndTopology) {
  const TriangleMesh mesh = joined(noisy(torus(1, 0.35, 30, 12), 0.06, 5), translated(noisy(icosphere(2), 0.1, 5), {3, 0, 0}));
  const TriangleMesh after = smoothed(mesh);
  EXPECT_THAT(after, IsClosedManifold());
  EXPECT_EQ(after.triangles, mesh.triangles);
  EXPECT_EQ(euler_characteristic(after), 0 + 2);
}

TEST(Smoothing, MakesANoisySphereBetter) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.08, 11);
  ASSERT_LT(smallest_angle_deg(mesh), 10);
  const TriangleMesh after = smoothed(mesh);
  EXPECT_GE(smallest_angle_deg(after), 10);
}

TEST(Smoothing, MovesTheFirstVertexOfTheScheduleToTheMeanOfItsNeighboursWhenNothingIsInTheWay) {
  TriangleMesh mesh = icosphere(1);
  const VertexRings rings = build_rings(mesh).value();
  std::vector<VertexId> all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), 0U);
  const SweepSchedule schedule(TriangleGrid(mesh.points, mesh.triangles), mesh, all);
  const VertexId first = schedule.vertices().front();
  Vec3 mean = Vec3::Zero();
  for (const VertexId w : rings.vertices(first)) mean += mesh.points[w] / rings.valence(first);
  SmoothingOptions options;
  options.rounds = 1;
  smooth(mesh, options);
  EXPECT_LT((mesh.points[first] - mean).norm(), 1e-15);
}

TEST(Smoothing, HalvesTheStepUntilItFits) {
  // The needle of a plate's middle goes home at once unless a second plate is pierced by nothing but its shadow: half the way is free.
  TriangleMesh mesh = joined(plate(4, 1), translated(scaled(translated(plate(2, 0.01), {-1, -1, 0}), 0.02), {2, 2, 2}));
  mesh.points[12][2] = 5.5;
  SmoothingOptions options;
  options.rounds = 1;
  options.keeps_angles = false;
  const SmoothingReport report = smooth(mesh, options);
  EXPECT_GT(report.moves.shortened, 0U);
  EXPECT_GT(mesh.points[12][2], 2);
  EXPECT_LT(mesh.points[12][2], 5.5);
  EXPECT_THAT(mesh, HasNoIntersections());
}

TEST(Smoothing, GivesTheSameBytesTwice) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.06, 2);
  EXPECT_TRUE(is_same(smoothed(mesh), smoothed(mesh)));
}

TEST(Smoothing, GivesTheSameBytesForAnyNumberOfThreads) {
  const TriangleMesh mesh = joined(noisy(icosphere(5), 0.012, 2), translated(random_molecule_surface(60, 1), {3, 0, 0}));
  for (const SmoothingOptions& options : {SmoothingOptions{}, eager(StepRule::volume_preserving)}) {
    const auto smoothed_by = [&](std::size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return tbb::task_arena(static_cast<int>(threads)).execute([&] { return smoothed(mesh, options); });
    };
    const TriangleMesh by_one = smoothed_by(1);
    for (const std::size_t threads : {2, 3, 7}) EXPECT_TRUE(is_same(smoothed_by(threads), by_one)) << threads << " threads";
  }
}

TEST(Smoothing, LeavesAFixedPointWhereItIs) {
  // On a regular polyhedron the step to the mean of the neighbours is along the normal, so the other two rules propose none.
  for (const TriangleMesh& mesh : {icosphere(0), octahedron(), tetrahedron()})
    for (const StepRule step : {StepRule::volume_preserving, StepRule::tangential})
      EXPECT_TRUE(is_same(smoothed(mesh, eager(step)), mesh)) << mesh.vertex_count() << " vertices";
}

TEST(Smoothing, KeepsTheVolumeWithVolumePreservingSteps) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.05, 4);
  const TriangleMesh after = smoothed(mesh, eager(StepRule::volume_preserving, 50));
  EXPECT_FALSE(is_same(after, mesh));
  EXPECT_NEAR(enclosed_volume(after) / enclosed_volume(mesh), 1, 1e-12);
}

// ---- Options ----

TEST(Smoothing, MovesNothingInZeroRounds) {
  const TriangleMesh mesh = noisy(icosphere(2), 0.1, 1);
  TriangleMesh copy = mesh;
  SmoothingOptions options;
  options.rounds = 0;
  const SmoothingReport report = smooth(copy, options);
  EXPECT_TRUE(is_same(copy, mesh));
  EXPECT_THAT(report.rounds, IsEmpty());
  EXPECT_EQ(report.moves.accepted + report.moves.refused, 0U);
  EXPECT_EQ(report.stopped_because, "rounds");
}

TEST(Smoothing, ShortensNothingWithZeroHalvings) {
  TriangleMesh mesh = linked_rings();
  SmoothingOptions options = eager(StepRule::umbrella, 100);
  options.halvings = 0;
  const SmoothingReport report = smooth(mesh, options);
  EXPECT_EQ(report.moves.shortened, 0U);
  EXPECT_GT(report.moves.refused, 0U);
  EXPECT_GT(report.moves.accepted, 0U);
}

TEST(Smoothing, StopsAfterTheFirstSweepWhenThresholdsAreZero) {
  TriangleMesh mesh = noisy(icosphere(2), 0.1, 1);
  SmoothingOptions options;
  options.thresholds = {0, 0};
  const SmoothingReport report = smooth(mesh, options);
  EXPECT_EQ(report.rounds.size(), 1U);
  EXPECT_EQ(report.low_quality, 0U);
  EXPECT_EQ(report.stopped_because, "quality reached");
}

TEST(Smoothing, RejectsOptionsOutOfTheirRange) {
  const auto with = [](auto member, auto value) {
    SmoothingOptions options;
    options.*member = value;
    return options;
  };
  SmoothingOptions wide_angle, wide_ratio;
  wide_angle.thresholds.min_angle_deg = 60;
  wide_ratio.thresholds.edge_ratio = 1;
  for (const SmoothingOptions& options : {with(&SmoothingOptions::rounds, -1), with(&SmoothingOptions::rounds_per_screening, 0),
                                          with(&SmoothingOptions::halvings, -1), wide_angle, wide_ratio}) {
    TriangleMesh mesh = icosphere(0);
    EXPECT_THROW(smooth(mesh, options), InvalidOption);
    EXPECT_TRUE(is_same(mesh, icosphere(0)));
  }
}

TEST(Smoothing, RejectsAnOpenMesh) {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.pop_back();
  EXPECT_THROW(smooth(mesh, {}), InvalidMesh);
}

TEST(Smoothing, NeverMakesTheSmallestAngleBelowTheThresholdSmaller) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    for (const auto& [name, mesh] : hard_meshes(seed)) {
      const SmoothingOptions options;
      const double before = smallest_angle_deg(mesh), after = smallest_angle_deg(smoothed(mesh, options));
      EXPECT_GE(after, std::min(before, options.thresholds.min_angle_deg) * (1 - 1e-9)) << name << ", seed " << seed;
    }
  }
}

TEST(Smoothing, MakesTheSmallestAngleSmallerSomewhereWhenBadAnglesAreIgnored) {
  bool is_anything_worse = false;
  for (const auto& [name, mesh] : hard_meshes(1)) {
    SmoothingOptions options;
    options.keeps_angles = false;
    is_anything_worse |= smallest_angle_deg(smoothed(mesh, options)) < std::min(smallest_angle_deg(mesh), 10.0) * (1 - 1e-9);
  }
  EXPECT_TRUE(is_anything_worse);
}

// ---- The report ----

TEST(Smoothing, ReportsNumbersThatAddUp) {
  for (const auto& [name, mesh] : hard_meshes(2)) {
    SCOPED_TRACE(name);
    TriangleMesh after = mesh;
    const SmoothingOptions options;
    const SmoothingReport report = smooth(after, options);
    MoveCounts sum;
    for (const RoundReport& round : report.rounds) {
      EXPECT_GE(round.moves.accepted, round.moves.shortened);
      EXPECT_LE(round.moves.accepted + round.moves.refused, round.active);
      EXPECT_EQ(round.longest_move > 0, round.moves.accepted > 0);
      sum.accepted += round.moves.accepted;
      sum.shortened += round.moves.shortened;
      sum.refused += round.moves.refused;
    }
    EXPECT_EQ(sum.accepted, report.moves.accepted);
    EXPECT_EQ(sum.shortened, report.moves.shortened);
    EXPECT_EQ(sum.refused, report.moves.refused);
    ASSERT_FALSE(report.rounds.empty());
    EXPECT_EQ(report.rounds.front().active, mesh.vertex_count());
    EXPECT_LE(report.rounds.size(), 100U);
    EXPECT_THAT(report.stopped_because, AnyOf("quality reached", "nothing moved", "rounds"));
    EXPECT_EQ(report.stopped_because == "rounds", report.rounds.size() == 100U);
    EXPECT_EQ(report.stopped_because == "quality reached", report.low_quality == 0);
    EXPECT_LE(report.stuck, report.moves.refused);
    const auto low = std::count_if(after.triangles.begin(), after.triangles.end(), [&](const Triangle& t) {
      const Vec3 &a = after.points[t[0]], &b = after.points[t[1]], &c = after.points[t[2]];
      return smallest_angle_deg(a, b, c) < options.thresholds.min_angle_deg || edge_ratio(a, b, c) < options.thresholds.edge_ratio;
    });
    EXPECT_EQ(report.low_quality, static_cast<std::size_t>(low));
  }
}

TEST(Smoothing, ChoosesTheActiveVerticesAnewEveryFewRounds) {
  TriangleMesh mesh = random_molecule_surface(40, 6);
  SmoothingOptions options;
  options.rounds = 22;
  options.rounds_per_screening = 3;
  options.thresholds.min_angle_deg = 53;  // cannot be reached around vertices of valence 5 and 7: all rounds are used
  const SmoothingReport report = smooth(mesh, options);
  ASSERT_EQ(report.rounds.size(), 22U);
  for (std::size_t i = 1; i < report.rounds.size(); ++i) {
    const bool is_chosen_anew = i % 3 == 1;
    EXPECT_TRUE(is_chosen_anew || report.rounds[i].active == report.rounds[i - 1].active) << "round " << i;
  }
}

TEST(Smoothing, CountsTheVerticesThatAreStuck) {
  // Two plates interpenetrate: the vertices there accept nothing.
  const TriangleMesh both = joined(plate(4, 1), translated(rotated(plate(4, 1), {1, 0, 0}, 0.7), {0.5, 0.3, -1}));
  ASSERT_THAT(both, Not(HasNoIntersections()));
  TriangleMesh mesh = both;
  const SmoothingReport report = smooth(mesh, eager(StepRule::umbrella, 10));
  EXPECT_GT(report.stuck, 0U);
  EXPECT_LT(report.stuck, mesh.vertex_count());
  TriangleMesh free = noisy(icosphere(2), 0.01, 1);
  EXPECT_EQ(smooth(free, {}).stuck, 0U);
}

// ---- Progress ----

TEST(Smoothing, StopsWithCancelledWhenTheCallbackSaysSo) {
  TriangleMesh mesh = noisy(icosphere(2), 0.1, 1);
  int calls = 0;
  EXPECT_THROW(smooth(mesh, eager(StepRule::umbrella), [&](std::string_view, double) { return ++calls < 4; }), Cancelled);
  EXPECT_EQ(calls, 4);
}

TEST(Smoothing, ReportsProgressThatOnlyGrows) {
  TriangleMesh mesh = noisy(icosphere(2), 0.1, 1);
  double last = 0;
  smooth(mesh, eager(StepRule::umbrella), [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "smoothing");
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    return true;
  });
  EXPECT_GT(last, 0);
}

}  // namespace
}  // namespace smopt
