#include "smopt/improve/remesh/remesh.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "smopt/error.h"
#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/improve/remesh/shape_judge.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;
using ::testing::ElementsAreArray;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Le;

struct Remeshed {
  TriangleMesh mesh;
  RemeshReport report;
};

Remeshed remeshed(TriangleMesh mesh, const RemeshOptions& options = {}) {
  RemeshReport report = remesh(mesh, options);
  return {std::move(mesh), std::move(report)};
}

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

std::ostream& operator<<(std::ostream& out, const NamedMesh& named) {
  return out << named.name;
}

/// A vertex of valence 100 above and one below a ring.
TriangleMesh wheel(int spokes) {
  TriangleMesh mesh{{{0, 0, 0.3}, {0, 0, -0.3}}, {}};
  const auto rim = [spokes](int i) { return static_cast<VertexId>(2 + i % spokes); };
  for (int i = 0; i < spokes; ++i) {
    const double angle = 2 * 3.14159265358979 * i / spokes;
    mesh.points.emplace_back(std::cos(angle), std::sin(angle), 0);
    mesh.triangles.insert(mesh.triangles.end(), {{rim(i), rim(i + 1), 0}, {rim(i + 1), rim(i), 1}});
  }
  return mesh;
}

TriangleMesh stretched(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& p : mesh.points) p = p.cwiseProduct(by);
  return mesh;
}

/// An ellipsoid whose ends are curved sixteen times as sharply as its waist.
TriangleMesh ellipsoid() {
  return stretched(icosphere(4), {1, 1, 4});
}

TriangleMesh noisy_sphere() {
  return noisy(icosphere(4), 0.02, 3);
}

TriangleMesh noisy_torus() {
  return noisy(torus(3, 1, 90, 30), 0.04, 4);
}

std::vector<NamedMesh> hard_meshes() {
  return {{"tetrahedron", tetrahedron()},
          {"cube", cube()},
          {"octahedron", octahedron()},
          {"icosahedron", icosphere(0)},
          {"thin_plate", plate(8, 0.01)},
          {"very_thin_plate", plate(5, 1e-6)},
          {"needles", spiky(icosphere(2), 7, 5)},
          {"long_needles", spiky(noisy(icosphere(2), 0.01, 2), 23, 20)},
          {"dents", spiky(icosphere(3), 40, 0.3)},
          {"wheel", wheel(100)},
          {"flat_ellipsoid", stretched(noisy(icosphere(3), 0.02, 9), {1, 1, 0.02})},
          {"noisy_sphere", noisy(icosphere(3), 0.05, 1)},
          {"very_noisy_sphere", noisy(icosphere(2), 0.1, 1)},
          {"torus", noisy(torus(1, 0.3, 60, 20), 0.01, 2)},
          {"thin_torus", torus(1, 0.02, 40, 5)},
          {"linked_rings", linked_rings()},
          {"knotted_tube", knotted_tube()},
          {"needles_with_a_speck", needles_with_a_speck_in_one()},
          {"dents_with_things", dents_with_things_in_one()},
          {"plates", plates_on_a_noisy_sheet(1e-3, 1)},
          {"points_in_faces", with_points_in_faces(noisy(icosphere(2), 0.03, 1), 2)},
          {"points_on_edges", with_points_on_edges(icosphere(2), 3)},
          {"nested_spheres", joined(joined(icosphere(3), reversed(icosphere(2, 0.9))), icosphere(1, 0.8))},
          {"molecule", random_molecule_surface(12, 1)}};
}

/// The Euler characteristic of each component, sorted.
std::vector<int> topology_of(const TriangleMesh& mesh) {
  std::vector<int> result;
  for (const TriangleMesh& part : components_of(mesh)) result.push_back(euler_characteristic(part));
  std::sort(result.begin(), result.end());
  return result;
}

void expect_sound(const TriangleMesh& before, const TriangleMesh& after) {
  EXPECT_THAT(after, IsClosedManifold());
  EXPECT_THAT(topology_of(after), ElementsAreArray(topology_of(before)));
  EXPECT_LE(intersecting_pairs(after).size(), intersecting_pairs(before).size());
  EXPECT_TRUE(std::all_of(after.points.begin(), after.points.end(), [](const Vec3& p) { return p.allFinite(); }));
  EXPECT_EQ(used_vertices(after), after.vertex_count()) << "no vertex without triangles is left";
}

std::size_t edits(const RemeshReport& report) {
  return report.flips.done + report.collapses.done + report.splits.done;
}

void expect_count_within(const TriangleMesh& mesh, std::size_t wanted, double relative) {
  EXPECT_NEAR(static_cast<double>(mesh.vertex_count()), static_cast<double>(wanted), relative * static_cast<double>(wanted));
}

double relative_volume_change(const TriangleMesh& before, const TriangleMesh& after) {
  return std::abs(enclosed_volume(after) / enclosed_volume(before) - 1);
}

// ---- What holds on every mesh ----

class RemeshHardMesh : public ::testing::TestWithParam<NamedMesh> {};
INSTANTIATE_TEST_SUITE_P(Remesh, RemeshHardMesh, ::testing::ValuesIn(hard_meshes()),
                         [](const auto& parameter) { return parameter.param.name; });

TEST_P(RemeshHardMesh, StaysAClosedManifoldOfTheSameTopologyWithoutIntersections) {
  const TriangleMesh& before = GetParam().mesh;
  ASSERT_THAT(before, HasNoIntersections());
  expect_sound(before, remeshed(before).mesh);
}

TEST_P(RemeshHardMesh, StaysSoundWhateverIsAskedFor) {
  const TriangleMesh& before = GetParam().mesh;
  RemeshOptions coarse, fine, curved, free, uniform, bounded;
  coarse.vertices = std::max<std::size_t>(before.vertex_count() / 4, 4);
  fine.vertices = 2 * before.vertex_count();
  curved.sizing = Sizing::curvature;
  free.preserves_volume = false;
  free.rounds = 12;
  uniform.sizing = Sizing::uniform;
  bounded.deviation = 0.2 * mean_edge_length(before);
  int index = 0;
  for (RemeshOptions options : {coarse, fine, curved, free, uniform, bounded}) {
    SCOPED_TRACE(index++);
    options.refinements = 1;  // of needles there is no end, and each makes the mesh larger
    expect_sound(before, remeshed(before, options).mesh);
  }
}

TEST_P(RemeshHardMesh, ReportsTheGoalsAsTheyAreMeasured) {
  RemeshOptions options;
  options.repairs = 3;
  const auto [mesh, report] = remeshed(GetParam().mesh, options);
  const std::array<GoalMeasure, 5> measured = measure_goals(mesh, options.goals);
  ASSERT_EQ(report.goals.size(), measured.size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    SCOPED_TRACE(measured[i].name);
    const GoalOutcome& outcome = report.goals[i];
    EXPECT_EQ(outcome.name, measured[i].name);
    EXPECT_NEAR(outcome.reached, measured[i].worst, 1e-5);
    EXPECT_GE(outcome.missing, measured[i].surely_missing);
    EXPECT_LE(outcome.missing, measured[i].perhaps_missing);
    EXPECT_EQ(outcome.explanation.empty(), outcome.missing == 0) << outcome.explanation;
  }
}

TEST_P(RemeshHardMesh, KeepsItsVolumeButForWhatTheReportOwes) {
  const TriangleMesh& before = GetParam().mesh;
  const auto [after, report] = remeshed(before);
  const double volume = enclosed_volume(before);
  EXPECT_NEAR(enclosed_volume(after) + report.volume_owed, volume, 1e-9 * std::abs(volume) + 1e-12);
}

// ---- Volume ----

TEST(Remesh, KeepsTheVolumeOfASmoothSurfaceToOneInAHundredThousand) {
  for (const TriangleMesh& before : {noisy_sphere(), noisy_torus(), noisy(icosphere(3), 0.05, 1), ellipsoid(), linked_rings()})
    EXPECT_LT(relative_volume_change(before, remeshed(before).mesh), 1e-5);
}

TEST(Remesh, LosesVolumeWhereItNeedNotBeKept) {
  RemeshOptions options;
  options.preserves_volume = false;
  EXPECT_GT(relative_volume_change(noisy_sphere(), remeshed(noisy_sphere(), options).mesh), 1e-4);
}

// ---- Goals ----

void expect_all_goals_reached(const TriangleMesh& before, const RemeshOptions& options = {}) {
  const auto [after, report] = remeshed(before, options);
  for (const GoalMeasure& goal : measure_goals(after, options.goals)) EXPECT_EQ(goal.surely_missing, 0U) << goal.name << " " << goal.worst;
  for (const GoalOutcome& goal : report.goals) EXPECT_EQ(goal.missing, 0U) << goal.name << " " << goal.explanation;
}

TEST(Remesh, ReachesAllGoalsOnEasyShapes) {
  expect_all_goals_reached(noisy_sphere());
  expect_all_goals_reached(noisy_torus());
  expect_all_goals_reached(with_points_on_edges(icosphere(3), 3));
}

TEST(Remesh, ReachesLooserGoalsThatAreAskedFor) {
  RemeshOptions options;
  options.goals = {20, 130, 0.2, 10, 2};
  expect_all_goals_reached(noisy_torus(), options);
}

TEST(Remesh, ReachesTighterGoalsOnASphere) {
  RemeshOptions options;
  options.goals.min_angle_deg = 35;
  options.goals.max_angle_deg = 100;
  const TriangleMesh after = remeshed(noisy_sphere(), options).mesh;
  EXPECT_GE(smallest_angle(after), 34);
  EXPECT_LE(largest_angle(after), 101);
}

TEST(Remesh, SaysWhichGoalCannotBeReached) {
  RemeshOptions options;
  options.goals.min_angle_deg = 59;  // no closed surface of valence 6 only, but a torus, is equilateral
  const auto [after, report] = remeshed(noisy(icosphere(2), 0.03, 5), options);
  EXPECT_GT(report.goals[0].missing, 0U);
  EXPECT_FALSE(report.goals[0].explanation.empty());
  EXPECT_EQ(report.goals[0].goal, 59);
  EXPECT_FALSE(report.stopped_because.empty());
}

// ---- How many vertices, how long edges ----

TEST(Remesh, KeepsTheNumberOfVerticesUnlessAskedOtherwise) {
  for (const TriangleMesh& before : {noisy_sphere(), noisy_torus(), with_points_on_edges(icosphere(3), 3), ellipsoid()})
    expect_count_within(remeshed(before).mesh, before.vertex_count(), 0.05);
}

TEST(Remesh, GivesAboutAsManyVerticesAsAreAskedFor) {
  for (const TriangleMesh& before : {noisy_sphere(), noisy_torus()}) {
    for (const double factor : {0.25, 0.5, 1.0, 2.0, 4.0}) {
      for (const Sizing sizing : {Sizing::density, Sizing::uniform, Sizing::curvature}) {
        SCOPED_TRACE(fmt::format("{} vertices, factor {}, sizing {}", before.vertex_count(), factor, static_cast<int>(sizing)));
        RemeshOptions options;
        options.sizing = sizing;
        options.vertices = static_cast<std::size_t>(factor * static_cast<double>(before.vertex_count()));
        const TriangleMesh after = remeshed(before, options).mesh;
        expect_count_within(after, options.vertices, 0.05);
        EXPECT_THAT(after, HasNoIntersections());
      }
    }
  }
}

TEST(Remesh, GivesEdgesOfTheLengthAskedFor) {
  for (const TriangleMesh& before : {noisy_sphere(), noisy_torus()}) {
    for (const double factor : {0.5, 0.7, 0.8, 1.0, 1.2, 1.5, 2.0}) {
      RemeshOptions options;
      options.sizing = Sizing::uniform;
      options.edge_length = factor * mean_edge_length(before);
      const double reached = mean_edge_length(remeshed(before, options).mesh);
      EXPECT_NEAR(reached / options.edge_length, 1, 0.1) << "factor " << factor;
    }
  }
}

/// The mean length of the edges whose middle is in a slab of heights.
double mean_length_between(const TriangleMesh& mesh, double low, double high) {
  double sum = 0;
  int count = 0;
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 &a = mesh.points[t[i]], &b = mesh.points[t[(i + 1) % 3]];
      const double z = std::abs(0.5 * (a + b).z());
      if (z < low || z > high) continue;
      sum += (a - b).norm();
      ++count;
    }
  }
  return sum / count;
}

TEST(Remesh, KeepsTheInputsDensityPlaceByPlace) {
  // One half of the sphere has edges about twice as long as the other.
  RemeshOptions halves;
  TriangleMesh before = icosphere(4);
  for (Vec3& p : before.points) p = (p + Vec3(0, 0, 0.6)).normalized();
  before = noisy(before, 0.005, 1);
  const auto upper = [](const TriangleMesh& mesh) {
    TriangleMesh up = mesh;
    for (Vec3& p : up.points) p.z() += 1;  // 0 to 2
    return up;
  };
  const TriangleMesh after = remeshed(before).mesh;
  const double dense_before = mean_length_between(upper(before), 1.8, 2), sparse_before = mean_length_between(upper(before), 0, 0.4);
  const double dense = mean_length_between(upper(after), 1.8, 2), sparse = mean_length_between(upper(after), 0, 0.4);
  ASSERT_GT(sparse_before, 1.5 * dense_before);
  EXPECT_NEAR(dense / dense_before, 1, 0.15);
  EXPECT_NEAR(sparse / sparse_before, 1, 0.15);
}

TEST(Remesh, MakesEdgesAlikeEverywhereByUniformSizing) {
  RemeshOptions options;
  options.sizing = Sizing::uniform;
  const TriangleMesh after = remeshed(ellipsoid(), options).mesh;
  EXPECT_NEAR(mean_length_between(after, 3.2, 4) / mean_length_between(after, 0, 1), 1, 0.1);
}

TEST(Remesh, MakesEdgesShortWhereTheCurvatureIsHigh) {
  RemeshOptions options;
  options.sizing = Sizing::curvature;
  options.vertices = ellipsoid().vertex_count();
  const TriangleMesh after = remeshed(ellipsoid(), options).mesh;
  EXPECT_LT(mean_length_between(after, 3.8, 4), 0.6 * mean_length_between(after, 0, 1));
  EXPECT_THAT(after, HasNoIntersections());
}

TEST(Remesh, GivesChordsTheLengthThatTheErrorAllowsByCurvatureSizing) {
  // The centre of an equilateral triangle of edge √(6e − 3e²) in a sphere of radius 1 is e below it.
  for (const double error : {0.0005, 0.002, 0.005}) {
    RemeshOptions options;
    options.sizing = Sizing::curvature;
    options.chord_error = error;
    const double expected = std::sqrt(6 * error - 3 * error * error);
    EXPECT_NEAR(mean_edge_length(remeshed(icosphere(4), options).mesh) / expected, 1, 0.1) << error;
  }
}

// ---- Switches ----

std::vector<std::size_t> sorted_valences(const TriangleMesh& mesh) {
  std::vector<std::size_t> result = valences(mesh);
  std::sort(result.begin(), result.end());
  return result;
}

/// The triangles by the coordinates of their corners, sorted: the same for two meshes that differ in numbering only.
std::vector<std::array<double, 9>> surface_of(const TriangleMesh& mesh) {
  std::vector<std::array<double, 9>> result;
  for (const Triangle& t : mesh.triangles) {
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = {mesh.points[t[i]].x(), mesh.points[t[i]].y(), mesh.points[t[i]].z()};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    std::array<double, 9> all;
    for (std::size_t i = 0; i < 9; ++i) all[i] = corners[i / 3][i % 3];
    result.push_back(all);
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(Remesh, NeverMakesAnOperationThatIsSwitchedOff) {
  RemeshOptions no_flips, no_collapses, no_splits, none;
  no_flips.flips = false;
  no_collapses.collapses = false;
  no_splits.splits = false;
  none.flips = none.collapses = none.splits = false;
  const TriangleMesh before = noisy_sphere();
  EXPECT_EQ(remeshed(before, no_flips).report.flips.done, 0U);
  const auto [grown, growing] = remeshed(before, no_collapses);
  EXPECT_EQ(growing.collapses.done, 0U);
  EXPECT_EQ(grown.vertex_count(), before.vertex_count() + growing.splits.done);
  const auto [shrunk, shrinking] = remeshed(before, no_splits);
  EXPECT_EQ(shrinking.splits.done, 0U);
  EXPECT_EQ(shrunk.vertex_count(), before.vertex_count() - shrinking.collapses.done);
  const auto [moved, moving] = remeshed(before, none);
  EXPECT_EQ(edits(moving), 0U);
  EXPECT_EQ(moved.vertex_count(), before.vertex_count());
  EXPECT_EQ(sorted_valences(moved), sorted_valences(before));
}

TEST(Remesh, BooksEveryOperation) {
  RemeshOptions options;
  options.vertices = 2 * noisy_torus().vertex_count();
  for (const RemeshOptions& given : {RemeshOptions{}, options}) {
    const auto [after, report] = remeshed(noisy_torus(), given);
    EXPECT_EQ(after.vertex_count(), noisy_torus().vertex_count() + report.splits.done - report.collapses.done);
  }
}

TEST(Remesh, ChangesNothingWithoutRoundsRepairsAndRefinements) {
  RemeshOptions options;
  options.rounds = options.repairs = options.refinements = 0;
  for (const TriangleMesh& before : {noisy_sphere(), linked_rings(), tetrahedron()}) {
    const auto [after, report] = remeshed(before, options);
    EXPECT_EQ(surface_of(after), surface_of(before));
    EXPECT_EQ(edits(report) + report.moves.accepted, 0U);
  }
}

TEST(Remesh, RunsMoreRoundsThanAskedForOnlyWhileTheNumberOfVerticesIsOff) {
  constexpr int kAsked = 2, kAddedAtMost = 6;
  RemeshOptions options;
  options.rounds = kAsked;
  options.refinements = 0;
  options.repairs = 3;
  const int rounds = remeshed(noisy_torus(), options).report.rounds;
  EXPECT_GT(rounds, 0);
  EXPECT_LE(rounds, kAsked + kAddedAtMost);
  options.splits = false;  // then the number cannot be chosen
  EXPECT_LE(remeshed(noisy_torus(), options).report.rounds, kAsked);
}

TEST(Remesh, OnlyRepairsWithoutRounds) {
  RemeshOptions options;
  options.rounds = 0;
  const TriangleMesh before = spiky(icosphere(3), 97, 1.1);
  const auto [after, report] = remeshed(before, options);
  std::size_t same = 0;
  for (const Vec3& p : before.points) same += static_cast<std::size_t>(std::count(after.points.begin(), after.points.end(), p));
  EXPECT_GT(same, before.vertex_count() / 4) << "what misses no goal stays";
  expect_sound(before, after);
}

// ---- Symmetries ----

/// The same up to rounding: alike in number, shape and volume, though not the same triangles.
void expect_alike(const TriangleMesh& a, const TriangleMesh& b, double scale) {
  const double na = static_cast<double>(a.vertex_count()), nb = static_cast<double>(b.vertex_count());
  EXPECT_NEAR(nb / na, 1, 0.01);
  EXPECT_NEAR(mean_edge_length(b) / (scale * mean_edge_length(a)), 1, 0.01);
  EXPECT_NEAR(enclosed_volume(b) / (std::pow(scale, 3) * enclosed_volume(a)), 1, 1e-4);
  for (const auto& goals : {measure_goals(a, {}), measure_goals(b, {})})
    for (const GoalMeasure& goal : goals) EXPECT_EQ(goal.surely_missing, 0U) << goal.name;
}

TEST(Remesh, GivesAlikeMeshesWhereverAndHoweverLargeTheInputIs) {
  const TriangleMesh before = noisy(torus(3, 1, 60, 24), 0.03, 4), after = remeshed(before).mesh;
  expect_alike(after, remeshed(rotated(before, {1, 2, 3}, 1)).mesh, 1);
  expect_alike(after, remeshed(translated(before, {1000, -2000, 500})).mesh, 1);
  expect_alike(after, remeshed(translated(before, {1e6, 1e6, -1e6})).mesh, 1);
  for (const double scale : {1e-3, 0.3, 1e3, 1e6}) {
    SCOPED_TRACE(scale);
    expect_alike(after, remeshed(scaled(before, scale)).mesh, scale);
  }
  expect_alike(after, remeshed(relabelled(before, 5)).mesh, 1);
}

TEST(Remesh, IsExactlyTheSameForCoordinatesTwiceAsLarge) {
  // A power of two scales every number exactly; only constants with a unit would tell.
  const TriangleMesh before = noisy(icosphere(3), 0.03, 4);
  for (const double scale : {0.25, 8.0, 1024.0})
    EXPECT_TRUE(is_same(remeshed(scaled(before, scale)).mesh, scaled(remeshed(before).mesh, scale))) << "scale " << scale;
}

TEST(Remesh, StaysSoundAtExtremeCoordinates) {
  const TriangleMesh before = noisy(icosphere(2), 0.03, 8);
  for (const double scale : {1e-12, 1e-6, 1e6, 1e12}) {
    SCOPED_TRACE(scale);
    expect_sound(scaled(before, scale), remeshed(scaled(before, scale)).mesh);
  }
  for (const double offset : {1e3, 1e6, 1e9}) {
    SCOPED_TRACE(offset);
    const TriangleMesh moved = translated(before, {offset, -offset, 0.3 * offset});
    if (intersecting_pairs(moved).empty()) expect_sound(moved, remeshed(moved).mesh);
  }
}

TEST(Remesh, ChangesLittleAboutAMeshThatIsGoodAlready) {
  const TriangleMesh good = remeshed(noisy_sphere()).mesh;
  const auto [again, report] = remeshed(good);
  expect_count_within(again, good.vertex_count(), 0.02);
  EXPECT_LT(edits(report), good.vertex_count() / 5);
  EXPECT_LT(relative_volume_change(good, again), 1e-6);
  for (const GoalMeasure& goal : measure_goals(again, {})) EXPECT_EQ(goal.surely_missing, 0U) << goal.name;
}

TEST(Remesh, LeavesAGoodMeshAsItIsWhenItMayOnlyRepair) {
  RemeshOptions options;
  options.rounds = 0;
  EXPECT_EQ(surface_of(remeshed(icosphere(3), options).mesh), surface_of(icosphere(3)));
}

TEST(Remesh, GivesTheSameBytesTwice) {
  EXPECT_TRUE(is_same(remeshed(noisy_torus()).mesh, remeshed(noisy_torus()).mesh));
}

// ---- Inputs with intersections ----

TEST(Remesh, AddsNoPairWhereSomeIntersectAlready) {
  const TriangleMesh overlapping = joined(icosphere(3), translated(noisy(icosphere(3), 0.02, 3), {1.2, 0.1, 0}));
  const TriangleMesh crumpled = noisy(icosphere(3), 0.25, 3);
  for (const TriangleMesh& before : {overlapping, crumpled}) {
    ASSERT_FALSE(intersecting_pairs(before).empty());
    const TriangleMesh after = remeshed(before).mesh;
    EXPECT_LE(intersecting_pairs(after).size(), intersecting_pairs(before).size());
    EXPECT_THAT(after, IsClosedManifold());
    EXPECT_THAT(topology_of(after), ElementsAreArray(topology_of(before)));
  }
}

// ---- Refusals ----

/// What an InvalidOption says; empty when nothing is thrown.
std::string complaint(const RemeshOptions& options) {
  TriangleMesh mesh = icosphere(1);
  try {
    remesh(mesh, options);
  } catch (const InvalidOption& error) {
    EXPECT_TRUE(is_same(mesh, icosphere(1)));
    return error.what();
  }
  return {};
}

template <class Set>
RemeshOptions with(const Set& set) {
  RemeshOptions options;
  set(options);
  return options;
}

TEST(Remesh, NamesTheOptionThatIsOutOfRange) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, 60.0, 61.0, nan, infinity})
    EXPECT_THAT(complaint(with([&](RemeshOptions& o) { o.goals.min_angle_deg = bad; })), HasSubstr("min-angle")) << bad;
  for (const double bad : {60.0, 59.0, 180.0, 181.0, -1.0, nan, infinity})
    EXPECT_THAT(complaint(with([&](RemeshOptions& o) { o.goals.max_angle_deg = bad; })), HasSubstr("max-angle")) << bad;
  for (const double bad : {-0.1, 1.0, 2.0, nan})
    EXPECT_THAT(complaint(with([&](RemeshOptions& o) { o.goals.edge_ratio = bad; })), HasSubstr("edge-ratio")) << bad;
  for (const double bad : {-0.1, 180.0, nan})
    EXPECT_THAT(complaint(with([&](RemeshOptions& o) { o.goals.min_dihedral_deg = bad; })), HasSubstr("min-dihedral")) << bad;
  EXPECT_THAT(complaint(with([](RemeshOptions& o) { o.goals.valence_spread = -1; })), HasSubstr("valence"));
  EXPECT_THAT(complaint(with([](RemeshOptions& o) { o.rounds = -1; })), HasSubstr("rounds"));
  EXPECT_THAT(complaint(with([](RemeshOptions& o) { o.repairs = -1; })), HasSubstr("repairs"));
  EXPECT_THAT(complaint(with([](RemeshOptions& o) { o.refinements = -1; })), HasSubstr("refinements"));
  for (const double bad : {0.0, -1.0, nan})
    EXPECT_THAT(complaint(with([&](RemeshOptions& o) { o.deviation = bad; })), HasSubstr("deviation")) << bad;
  for (const double bad : {-1.0, nan, infinity}) {
    EXPECT_THAT(complaint(with([&](RemeshOptions& o) {
                  o.sizing = Sizing::uniform;
                  o.edge_length = bad;
                })),
                HasSubstr("edge-length"))
        << bad;
  }
  for (const double bad : {0.0, -1.0, nan, infinity})
    EXPECT_THAT(complaint(with([&](RemeshOptions& o) { o.chord_error = bad; })), HasSubstr("error")) << bad;
}

TEST(Remesh, RefusesWhatIsNotAClosedManifold) {
  TriangleMesh open = icosphere(1), two_fans = joined(tetrahedron(), tetrahedron()), inconsistent = icosphere(1);
  open.triangles.pop_back();
  for (Triangle& t : two_fans.triangles)
    for (VertexId& v : t) v = v == 4 ? 0 : v;  // both tetrahedra at vertex 0
  std::swap(inconsistent.triangles[3][0], inconsistent.triangles[3][1]);
  TriangleMesh three_at_an_edge = tetrahedron();
  three_at_an_edge.points.emplace_back(3, 3, 3);
  three_at_an_edge.triangles.push_back({0, 1, 4});
  for (const TriangleMesh& bad : {open, two_fans, inconsistent, three_at_an_edge}) {
    TriangleMesh mesh = bad;
    EXPECT_THROW(remesh(mesh, {}), InvalidMesh);
    EXPECT_TRUE(is_same(mesh, bad));
  }
}

TEST(Remesh, DoesNothingToAnEmptyMesh) {
  TriangleMesh mesh;
  try {
    remesh(mesh, {});
  } catch (const InvalidMesh&) {
  }
  EXPECT_TRUE(mesh.points.empty());
}

TEST(Remesh, StopsWhenTheCallbackSaysSo) {
  for (const int calls : {1, 2, 5}) {
    TriangleMesh mesh = noisy_torus();
    int count = 0;
    EXPECT_THROW(remesh(mesh, {}, [&](std::string_view, double) { return ++count < calls; }), Cancelled);
    EXPECT_EQ(count, calls) << "not asked again";
  }
}

TEST(Remesh, ReportsProgressBetweenZeroAndOne) {
  TriangleMesh mesh = noisy_torus();
  int calls = 0;
  remesh(mesh, {}, [&](std::string_view stage, double fraction) {
    EXPECT_FALSE(stage.empty());
    EXPECT_THAT(fraction, Ge(0));
    EXPECT_THAT(fraction, Le(1));
    ++calls;
    return true;
  });
  EXPECT_GT(calls, 3);
}

TEST(Remesh, ReducesTheValenceOfALargeFan) {
  const TriangleMesh after = remeshed(wheel(100)).mesh;
  const std::vector<std::size_t> valence = valences(after);
  EXPECT_LE(*std::max_element(valence.begin(), valence.end()), 20U);
  EXPECT_THAT(after, HasNoIntersections());
}

}  // namespace
}  // namespace smopt
