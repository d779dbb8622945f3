#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <tuple>

#include "metrics/degenerate.h"
#include "smopt/improve/prepare.h"
#include "smopt/improve/remesh/remesh.h"
#include "smopt/surface/gaussian_surface.h"
#include "tests/improve/guarantee/cgal_archive.h"
#include "tests/improve/guarantee/promise.h"
#include "tests/improve/guarantee/random_mesh.h"
#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/improve/remesh/shape_judge.h"
#include "tests/support/files.h"
#include "tests/support/matchers.h"

/// The guarantee of `smopt2`, on what the guarantee of `smopt` is tested on.
namespace smopt {
namespace {

using namespace testing;
using ::testing::ElementsAreArray;

#ifdef __SANITIZE_ADDRESS__
constexpr std::uint32_t kSeeds = 1, kSeedsOfFaulty = 1;
constexpr std::size_t kLargest = 4'000;  // vertices of a mesh of the archive
#else
constexpr std::uint32_t kSeeds = 4;          // of each of the 26 families
constexpr std::uint32_t kSeedsOfFaulty = 2;  // the same
constexpr std::size_t kLargest = 100'000;    // all
#endif

// ---- What is promised ----

std::size_t degenerate_count(const TriangleMesh& mesh) {
  const std::vector<bool> flags = metrics::degenerate_triangles(mesh);
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), true));
}

std::vector<int> euler_characteristics(const TriangleMesh& mesh) {
  std::vector<int> result;
  for (const TriangleMesh& part : components_of(mesh)) result.push_back(euler_characteristic(part));
  std::sort(result.begin(), result.end());
  return result;
}

RemeshReport expect_promise_kept_by_remeshing(const TriangleMesh& before, const RemeshOptions& options) {
  TriangleMesh after = before;
  const RemeshReport report = remesh(after, options);
  EXPECT_TRUE(std::all_of(after.points.begin(), after.points.end(), [](const Vec3& p) { return p.allFinite(); }));
  EXPECT_THAT(after, HasNoIntersections());
  EXPECT_THAT(after, IsClosedManifold());
  EXPECT_LE(degenerate_count(after), degenerate_count(before));
  EXPECT_THAT(shells(after), ElementsAreArray(shells(before)));
  return report;
}

void expect_no_new_fault_by_remeshing(const TriangleMesh& before, const RemeshOptions& options) {
  TriangleMesh after = before;
  remesh(after, options);
  EXPECT_THAT(after, IsClosedManifold());
  EXPECT_THAT(euler_characteristics(after), ElementsAreArray(euler_characteristics(before)));
  EXPECT_LE(degenerate_count(after), degenerate_count(before));
}

/// One of the combinations of options that tests cycle through: coarser, as it is, finer; sizing; volume kept or not; operations left out.
RemeshOptions remesh_combination(const TriangleMesh& mesh, std::size_t index) {
  const auto next_digit = [&index](std::size_t base) {
    const std::size_t digit = index % base;
    index /= base;
    return digit;
  };
  RemeshOptions options;
  options.refinements = 1;  // of needles there is no end
  options.sizing = std::array{Sizing::density, Sizing::uniform, Sizing::curvature}[next_digit(3)];
  options.vertices = std::array{std::size_t{0}, mesh.vertex_count() / 3 + 4, 2 * mesh.vertex_count()}[next_digit(3)];
  if (options.sizing == Sizing::curvature && options.vertices == 0) options.chord_error = 0.02 * mean_edge_length(mesh);
  options.preserves_volume = next_digit(2) == 0;
  const std::size_t left_out = next_digit(4);
  options.flips = left_out != 1;
  options.collapses = left_out != 2;
  options.splits = left_out != 3;
  options.rounds = static_cast<int>(std::array{4U, 12U}[next_digit(2)]);
  return options;
}

std::string describe(const RemeshOptions& o) {
  return fmt::format("sizing {}, {} vertices, chord error {}, volume {}, flips {}, collapses {}, splits {}, {} rounds",
                     static_cast<int>(o.sizing), o.vertices, o.chord_error, o.preserves_volume, o.flips, o.collapses, o.splits, o.rounds);
}

// ---- Random meshes ----

using FamilyAndSeed = std::tuple<MeshFamily, std::uint32_t>;

std::string name_of(const ::testing::TestParamInfo<FamilyAndSeed>& info) {
  return fmt::format("{}_{}", std::get<0>(info.param).name, std::get<1>(info.param));
}

std::size_t index_of(const MeshFamily& family) {
  const auto families = mesh_families();
  return static_cast<std::size_t>(
      std::find_if(families.begin(), families.end(), [&](const MeshFamily& f) { return f.name == family.name; }) - families.begin());
}

auto with_seeds(std::uint32_t count) {
  const auto families = mesh_families();
  return ::testing::Combine(::testing::ValuesIn(families.begin(), families.end()), ::testing::Range(1U, count + 1));
}

RemeshOptions options_for(const FamilyAndSeed& parameter, const TriangleMesh& mesh) {
  constexpr std::size_t kStep = 7;  // coprime to the number of combinations
  return remesh_combination(mesh, (index_of(std::get<0>(parameter)) * kStep + std::get<1>(parameter)) * kStep);
}

class RemeshedRandomMeshes : public ::testing::TestWithParam<FamilyAndSeed> {};
INSTANTIATE_TEST_SUITE_P(Guarantee, RemeshedRandomMeshes, with_seeds(kSeeds), name_of);

TEST_P(RemeshedRandomMeshes, StayFreeOfIntersectionsAndKeepTheirTopology) {
  const auto [mesh, description] = random_mesh_without_pairs(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const RemeshOptions options = options_for(GetParam(), mesh);
  SCOPED_TRACE(description);
  SCOPED_TRACE(describe(options));
  expect_promise_kept_by_remeshing(mesh, options);
}

class RemeshedFaultyMeshes : public ::testing::TestWithParam<FamilyAndSeed> {};
INSTANTIATE_TEST_SUITE_P(Guarantee, RemeshedFaultyMeshes, with_seeds(kSeedsOfFaulty), name_of);

TEST_P(RemeshedFaultyMeshes, StayManifoldOfTheSameTopology) {
  auto [mesh, description] = random_mesh_with_faults(std::get<0>(GetParam()), std::get<1>(GetParam()));
  prepare(mesh, CavityPolicy::keep);
  const RemeshOptions options = options_for(GetParam(), mesh);
  SCOPED_TRACE(description);
  SCOPED_TRACE(describe(options));
  expect_no_new_fault_by_remeshing(mesh, options);
}

// ---- Meshes of the archive, a molecule ----

TEST(RemeshedCgalMeshes, ThatAreClosedAndFreeOfIntersectionsStaySoAndGetGoodAngles) {
  if (!has_cgal_archive()) GTEST_SKIP() << "Debian's libcgal-demo is not installed";
  for (const ArchiveMesh& input : read_cgal_archive()) {
    if (!input.unusable_because.empty() || input.mesh.vertex_count() > kLargest) continue;
    SCOPED_TRACE(input.name);
    TriangleMesh mesh = input.mesh;
    prepare(mesh, CavityPolicy::keep);
    const RemeshReport report = expect_promise_kept_by_remeshing(mesh, {});
    EXPECT_GE(report.goals[0].reached, 15) << report.goals[0].explanation;
    EXPECT_LE(report.goals[1].reached, 140) << report.goals[1].explanation;
  }
}

TEST(RemeshedMolecule, KeepsVolumeAndTopologyAndReachesItsGoals) {
  const std::filesystem::path file = apbs_molecule("misc/fas2.pqr");
  TriangleMesh mesh = file.empty() ? random_molecule_surface(900, 1) : gaussian_surface(read_molecule(file), {});
  prepare(mesh, CavityPolicy::delete_cavities);
  const RemeshReport report = expect_promise_kept_by_remeshing(mesh, {});
  TriangleMesh after = mesh;
  remesh(after, {});
  EXPECT_NEAR(enclosed_volume(after) / enclosed_volume(mesh), 1, 1e-4);
  EXPECT_GE(smallest_angle(after), 15);
  EXPECT_LE(largest_angle(after), 140);
  EXPECT_EQ(report.goals.size(), 5U);
}

}  // namespace
}  // namespace smopt
