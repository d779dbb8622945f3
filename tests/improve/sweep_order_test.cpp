#include <fmt/format.h>
#include <gmock/gmock.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <numeric>

#include "smopt/error.h"
#include "smopt/improve/improve.h"
#include "smopt/improve/smoothing.h"
#include "smopt/improve/sweep_schedule.h"
#include "smopt/mesh/rings.h"
#include "smopt/mesh/spatial_order.h"
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

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

/// Several tiles of every colour, needles, sheets, components in each other's way.
std::vector<NamedMesh> hard_meshes(std::uint32_t seed) {
  return {{"torus with needles", joined(spiky(noisy(torus(10, 3, 60, 24), 0.1, seed), 31, 1.3), translated(icosphere(2), {40, 0, 0}))},
          {"two plates on a sheet", plates_on_a_noisy_sheet(1e-9, seed)},
          {"thin plate", noisy(plate(8, 0.05), 0.02, seed)},
          {"sphere with dents that nearly meet", noisy(spiky(icosphere(2), 7, 0.05), 0.02, seed)},
          {"linked rings", noisy(linked_rings(), 0.03, seed)},
          {"knotted tube", noisy(knotted_tube(), 0.03, seed)},
          {"needles with a speck in one", needles_with_a_speck_in_one()},
          {"dents with things in one", dents_with_things_in_one()},
          {"shell around a sphere", joined(noisy(icosphere(1), 0.03, seed), noisy(icosphere(3, 0.8), 0.02, seed))},
          {"surface of a random molecule", random_molecule_surface(40, seed)},
          {"sphere with intersections", noisy(icosphere(2), 0.25, seed)}};
}

SmoothingOptions one_plain_round(SweepOrder order, StepRule step = StepRule::umbrella) {
  SmoothingOptions options;
  options.rounds = 1;
  options.keeps_angles = false;
  options.guard = GuardKind::none;
  options.order = order;
  options.step = step;
  return options;
}

/// Thresholds that keep nearly every vertex active, so that many moves are made.
SmoothingOptions eager(SweepOrder order, StepRule step = StepRule::umbrella, int rounds = 12) {
  SmoothingOptions options = one_plain_round(order, step);
  options.guard = GuardKind::exact;
  options.rounds = rounds;
  options.thresholds = {0.9, 50};
  return options;
}

TriangleMesh smoothed(TriangleMesh mesh, const SmoothingOptions& options) {
  smooth(mesh, options);
  return mesh;
}

/// One sweep as a plain loop, on the numbering of `mesh`; `all` are its vertices in the order in which a block visits its own.
TriangleMesh swept_plainly(const TriangleMesh& mesh, const std::vector<VertexId>& all, SweepOrder order, StepRule step) {
  const VertexRings rings = build_rings(mesh).value();
  const SweepSchedule schedule(TriangleGrid(mesh.points, mesh.triangles), mesh, all);
  TriangleMesh after = mesh;
  for (const VertexId v : schedule.vertices()) {
    const std::vector<Vec3>& from = order == SweepOrder::jacobi ? mesh.points : after.points;
    after.points[v] += proposed_step(step, from[v], rings.vertices(v), from);
  }
  return after;
}

TriangleMesh swept_plainly(const TriangleMesh& mesh, SweepOrder order, StepRule step) {
  std::vector<VertexId> all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), 0U);
  return swept_plainly(mesh, all, order, step);
}

/// The same on the numbering that smoothing uses; the order of the sums in a step differs, and so does their rounding.
TriangleMesh swept_plainly_in_spatial_order(const TriangleMesh& mesh, SweepOrder order, StepRule step) {
  SpatiallyOrderedMesh ordered(mesh);
  ordered.mesh() = swept_plainly(ordered.mesh(), ordered.in_original_order(), order, step);
  TriangleMesh after = mesh;
  ordered.copy_points_to(after);
  return after;
}

double largest_distance(const TriangleMesh& a, const TriangleMesh& b) {
  double largest = 0;
  for (VertexId v = 0; v < a.vertex_count(); ++v) largest = std::max(largest, (a.points[v] - b.points[v]).norm());
  return largest;
}

/// With all vertices where they have somewhere to go: a step of less than about 1e-7 of an edge counts as none and is not made.
std::vector<NamedMesh> irregular_meshes(std::uint32_t seed) {
  std::vector<NamedMesh> meshes = hard_meshes(seed);
  for (NamedMesh& m : meshes) m.mesh = noisy(m.mesh, 1e-3, seed + 100);
  return meshes;
}

constexpr std::array kSteps = {StepRule::umbrella, StepRule::volume_preserving, StepRule::tangential};

void expect_a_plain_sweep(SweepOrder order, std::uint32_t seed) {
  for (const auto& [name, mesh] : irregular_meshes(seed)) {
    for (const StepRule step : kSteps) {
      SCOPED_TRACE(fmt::format("{}, step {}", name, static_cast<int>(step)));
      const TriangleMesh after = smoothed(mesh, one_plain_round(order, step));
      EXPECT_TRUE(is_same(after, swept_plainly_in_spatial_order(mesh, order, step)));
      EXPECT_LT(largest_distance(after, swept_plainly(mesh, order, step)), 1e-9);
      EXPECT_GT(largest_distance(after, mesh), 1e-3);
    }
  }
}

TEST(SweepOrder, WithoutAGuardGaussSeidelIsThePlainLoopInTheOrderOfTheSchedule) {
  expect_a_plain_sweep(SweepOrder::gauss_seidel, 1);
}

TEST(SweepOrder, WithoutAGuardJacobiMovesAllFromWhereTheSweepBegan) {
  expect_a_plain_sweep(SweepOrder::jacobi, 2);
}

TEST(SweepOrder, TheOrdersDiffer) {
  for (const auto& [name, mesh] : irregular_meshes(3)) {
    const TriangleMesh one_by_one = smoothed(mesh, one_plain_round(SweepOrder::gauss_seidel));
    EXPECT_GT(largest_distance(one_by_one, smoothed(mesh, one_plain_round(SweepOrder::jacobi))), 1e-3) << name;
  }
}

TEST(SweepOrder, TheSecondJacobiSweepBeginsWhereTheFirstEnded) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.02, 3);
  SmoothingOptions two = one_plain_round(SweepOrder::jacobi);
  two.thresholds = {0.99, 59.9};
  SmoothingOptions one = two;
  two.rounds = 2;
  TriangleMesh after_two = mesh;
  const SmoothingReport report = smooth(after_two, two);
  ASSERT_EQ(report.rounds.at(1).active, mesh.vertex_count()) << "the case is only of use while all vertices stay active";
  EXPECT_LT(largest_distance(after_two, smoothed(smoothed(mesh, one), one)), 1e-12);
  EXPECT_GT(largest_distance(after_two, smoothed(mesh, one)), 1e-4);
}

TEST(SweepOrder, WithTheExactGuardJacobiCreatesNoIntersectingPair) {
  for (const std::uint32_t seed : {1U, 2U}) {
    for (const auto& [name, mesh] : hard_meshes(seed)) {
      const std::vector<FacePair> pairs_before = intersecting_pairs(mesh);
      SmoothingOptions classic;
      classic.order = SweepOrder::jacobi;
      for (const SmoothingOptions& options : {classic, eager(SweepOrder::jacobi), eager(SweepOrder::jacobi, StepRule::volume_preserving)}) {
        const TriangleMesh after = smoothed(mesh, options);
        EXPECT_THAT(new_pairs(pairs_before, after), IsEmpty()) << name << ", seed " << seed;
        EXPECT_FALSE(is_same(after, mesh)) << name;
      }
    }
  }
}

TEST(SweepOrder, WithoutAGuardJacobiCreatesIntersectingPairsOnSomeOfTheseMeshes) {
  int with_pairs = 0;
  for (const auto& [name, mesh] : hard_meshes(1)) {
    bool has_pairs = false;
    for (const int rounds : {1, 5, 20, 100}) {
      SmoothingOptions options = eager(SweepOrder::jacobi, StepRule::umbrella, rounds);
      options.guard = GuardKind::none;
      has_pairs |= !new_pairs(mesh, smoothed(mesh, options)).empty();
    }
    with_pairs += static_cast<int>(has_pairs);
  }
  EXPECT_GE(with_pairs, 3);
}

TEST(SweepOrder, JacobiGivesTheSameBytesForAnyNumberOfThreadsAndTwice) {
  const TriangleMesh mesh = joined(noisy(icosphere(4), 0.025, 2), translated(random_molecule_surface(60, 1), {3, 0, 0}));
  SmoothingOptions classic;
  classic.order = SweepOrder::jacobi;
  for (const SmoothingOptions& options : {classic, eager(SweepOrder::jacobi), eager(SweepOrder::jacobi, StepRule::volume_preserving)}) {
    const auto smoothed_by = [&](std::size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return tbb::task_arena(static_cast<int>(threads)).execute([&] { return smoothed(mesh, options); });
    };
    const TriangleMesh by_one = smoothed_by(1);
    for (const std::size_t threads : {1, 2, 3, 8}) EXPECT_TRUE(is_same(smoothed_by(threads), by_one)) << threads << " threads";
  }
}

TEST(SweepOrder, GuardsThatUseOneThreadGiveTheSameBytesForAnyNumber) {
  const TriangleMesh mesh = noisy(torus(10, 3, 60, 24), 0.1, 4);
  for (const GuardKind guard : {GuardKind::paper, GuardKind::none}) {
    for (const SweepOrder order : {SweepOrder::gauss_seidel, SweepOrder::jacobi}) {
      SmoothingOptions options = eager(order, StepRule::umbrella, 5);
      options.guard = guard;
      const auto smoothed_by = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return tbb::task_arena(static_cast<int>(threads)).execute([&] { return smoothed(mesh, options); });
      };
      const TriangleMesh by_one = smoothed_by(1);
      for (const std::size_t threads : {2, 3, 8}) EXPECT_TRUE(is_same(smoothed_by(threads), by_one)) << threads << " threads";
    }
  }
}

// ---- The paper's guard in the loop ----

TEST(GuardKinds, ThePapersGuardLetsComponentsCrossEachOtherWhereTheExactOneDoesNot) {
  // A fast shell shrinks through a slow sphere that is no neighbour of it.
  const TriangleMesh mesh = joined(noisy(icosphere(1), 0.03, 1), noisy(icosphere(3, 0.8), 0.01, 1));
  ASSERT_THAT(mesh, HasNoIntersections());
  const auto after = [&](GuardKind guard, int vicinity, int rounds) {
    SmoothingOptions options = eager(SweepOrder::gauss_seidel, StepRule::umbrella, rounds);
    options.guard = guard;
    options.vicinity = vicinity;
    return smoothed(mesh, options);
  };
  for (const int vicinity : {1, 2, 3}) {
    bool has_crossed = false;
    for (const int rounds : {1, 2, 4, 8}) has_crossed |= !intersecting_pairs(after(GuardKind::paper, vicinity, rounds)).empty();
    EXPECT_TRUE(has_crossed) << vicinity;
  }
  for (const int rounds : {1, 2, 4, 8}) EXPECT_THAT(after(GuardKind::exact, 2, rounds), HasNoIntersections()) << rounds;
}

TEST(GuardKinds, NoGuardRefusesNothing) {
  for (const auto& [name, mesh] : hard_meshes(1)) {
    TriangleMesh after = mesh;
    SmoothingOptions options = eager(SweepOrder::gauss_seidel);
    options.guard = GuardKind::none;
    const SmoothingReport report = smooth(after, options);
    EXPECT_EQ(report.moves.refused + report.moves.shortened + report.stuck, 0U) << name;
  }
}

TEST(GuardKinds, AVicinityOfLessThanOneRingIsRejected) {
  for (const int vicinity : {0, -1}) {
    TriangleMesh mesh = icosphere(0);
    SmoothingOptions options;
    options.guard = GuardKind::paper;
    options.vicinity = vicinity;
    EXPECT_THROW(smooth(mesh, options), InvalidOption);
    EXPECT_TRUE(is_same(mesh, icosphere(0)));
  }
}

// ---- The volume ----

/// Smooths through all stages, none of which removes anything.
ImproveReport improve_all(TriangleMesh& mesh, const SmoothingOptions& smoothing) {
  ImproveOptions options;
  options.cavities = CavityPolicy::keep;
  options.deletes_redundant_points = false;
  options.smoothing = smoothing;
  return improve(mesh, options);
}

TEST(SweepOrder, TheReportHasTheVolumesBeforeAndAfter) {
  for (const auto& [name, mesh] : hard_meshes(3)) {
    for (const SweepOrder order : {SweepOrder::gauss_seidel, SweepOrder::jacobi}) {
      TriangleMesh after = mesh;
      const ImproveReport report = improve_all(after, eager(order, StepRule::umbrella, 5));
      // A mesh of several parts may be turned by the stages before; that changes no vertex.
      const TriangleMesh before{mesh.points, after.triangles};
      const double scale = std::abs(enclosed_volume(before));
      EXPECT_NEAR(report.volume_before_smoothing, enclosed_volume(before), 1e-12 * scale) << name;
      EXPECT_NEAR(report.volume_after_smoothing, enclosed_volume(after), 1e-12 * scale) << name;
    }
  }
}

TEST(SweepOrder, TheReportedVolumeOfAMeshFarFromTheOriginIsSharp) {
  // Coordinates of 1e6 are rounded by 1e-10; a sum over tetrahedra with the origin would lose six digits more.
  TriangleMesh mesh = translated(noisy(icosphere(3), 0.03, 4), {1e6, -1e6, 1e6});
  const TriangleMesh near = translated(mesh, {-1e6, 1e6, -1e6});
  SmoothingOptions options;
  options.rounds = 0;
  const ImproveReport report = improve_all(mesh, options);
  EXPECT_NEAR(report.volume_before_smoothing / enclosed_volume(near), 1, 1e-12);
  EXPECT_EQ(report.volume_after_smoothing, report.volume_before_smoothing);
}

TEST(SweepOrder, VolumePreservingStepsKeepTheVolumeOneByOneAndDriftAllAtOnce) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.05, 4);
  const auto change = [&](SweepOrder order, GuardKind guard) {
    TriangleMesh after = mesh;
    SmoothingOptions options = eager(order, StepRule::volume_preserving, 50);
    options.guard = guard;
    const ImproveReport report = improve_all(after, options);
    EXPECT_GT(report.smoothing.moves.accepted, 1000U);
    EXPECT_NEAR(report.volume_after_smoothing / enclosed_volume(after), 1, 1e-12);
    return std::abs(report.volume_after_smoothing / report.volume_before_smoothing - 1);
  };
  for (const GuardKind guard : {GuardKind::exact, GuardKind::none}) {
    EXPECT_LT(change(SweepOrder::gauss_seidel, guard), 1e-12);
    EXPECT_GT(change(SweepOrder::jacobi, guard), 1e-9);
  }
}

// ---- The counts ----

TEST(SweepOrder, TheCountsOfARoundAreAtMostTheActiveVertices) {
  for (const auto& [name, mesh] : hard_meshes(2)) {
    for (const GuardKind guard : {GuardKind::exact, GuardKind::paper, GuardKind::none}) {
      for (const SweepOrder order : {SweepOrder::gauss_seidel, SweepOrder::jacobi}) {
        SCOPED_TRACE(fmt::format("{}, guard {}, order {}", name, static_cast<int>(guard), static_cast<int>(order)));
        TriangleMesh after = mesh;
        SmoothingOptions options = eager(order, StepRule::umbrella, 8);
        options.guard = guard;
        const SmoothingReport report = smooth(after, options);
        MoveCounts sum;
        for (const RoundReport& round : report.rounds) {
          EXPECT_LE(round.moves.accepted + round.moves.refused + round.stuck, round.active);
          EXPECT_LE(round.moves.shortened, round.moves.accepted);
          EXPECT_EQ(round.longest_move > 0, round.moves.accepted > 0);
          sum.accepted += round.moves.accepted;
          sum.refused += round.moves.refused;
        }
        EXPECT_EQ(sum.accepted, report.moves.accepted);
        EXPECT_EQ(sum.refused, report.moves.refused);
        EXPECT_EQ(report.rounds.front().stuck, 0U) << "nothing has been refused before the first round";
        EXPECT_THAT(report.stopped_because, AnyOf("quality reached", "nothing moved", "rounds"));
      }
    }
  }
}

TEST(SweepOrder, StopsBecauseNothingMovedOnlyWhenTheLastRoundMovedNothing) {
  int stopped_so = 0;
  for (const auto& [name, mesh] : hard_meshes(1)) {
    for (const SweepOrder order : {SweepOrder::gauss_seidel, SweepOrder::jacobi}) {
      TriangleMesh after = mesh;
      SmoothingOptions options;
      options.order = order;
      options.rounds = 150;
      const SmoothingReport report = smooth(after, options);
      if (report.stopped_because != "nothing moved") continue;
      ++stopped_so;
      EXPECT_EQ(report.rounds.back().moves.accepted, 0U) << name;
      EXPECT_EQ(report.rounds.back().longest_move, 0) << name;
      EXPECT_GT(report.low_quality, 0U) << name;
    }
  }
  EXPECT_GT(stopped_so, 0) << "the case is only of use when some stop so";
}

TEST(SweepOrder, AVertexThatNothingAroundHasMovedForIsPassedOverAndCounted) {
  // Two plates interpenetrate: what is refused there once stays so.
  const TriangleMesh both = joined(plate(4, 1), translated(rotated(plate(4, 1), {1, 0, 0}, 0.7), {0.5, 0.3, -1}));
  for (const SweepOrder order : {SweepOrder::gauss_seidel, SweepOrder::jacobi}) {
    TriangleMesh mesh = both;
    const SmoothingReport report = smooth(mesh, eager(order, StepRule::umbrella, 30));
    std::size_t passed_over = 0;
    for (const RoundReport& round : report.rounds) passed_over += round.stuck;
    EXPECT_GT(passed_over, 0U);
    EXPECT_GT(report.stuck, 0U);
  }
}

}  // namespace
}  // namespace smopt
