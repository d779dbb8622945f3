#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "smopt/improve/improve.h"
#include "smopt/timing.h"
#include "tests/improve/guarantee/cgal_archive.h"
#include "tests/improve/guarantee/promise.h"
#include "tests/improve/judge.h"
#include "tests/support/matchers.h"

namespace smopt {
namespace {

using namespace testing;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;

#define SKIP_WITHOUT_CGAL_ARCHIVE() \
  if (!has_cgal_archive()) GTEST_SKIP() << "Debian's libcgal-demo is not installed"

/// Vertices of the largest mesh that is tried with many settings.
#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t kLargest = 4'000;  // ten times slower, and the larger ones run the same code
#else
constexpr std::size_t kLargest = 100'000;  // all
#endif

std::vector<ArchiveMesh> usable_meshes() {
  std::vector<ArchiveMesh> meshes = read_cgal_archive();
  std::erase_if(meshes, [](const ArchiveMesh& mesh) { return !mesh.unusable_because.empty(); });
  return meshes;
}

/// One line of the list: what improving did to a mesh.
void print_row(const std::string& name, const TriangleMesh& before, const TriangleMesh& after, const ImproveReport& report,
               double seconds) {
  fmt::print("{:26} {:7} {:8.2f} {:+12.2e} {:9.3g} {:9.3g} {:6} {:6}  {}\n", name, before.vertex_count(), seconds,
             enclosed_volume(after) / enclosed_volume(before) - 1, smallest_angle_deg(before), smallest_angle_deg(after),
             report.smoothing.rounds.size(), report.smoothing.stuck, report.smoothing.stopped_because);
}

void print_header() {
  fmt::print("{:26} {:>7} {:>8} {:>12} {:>9} {:>9} {:>6} {:>6}  {}\n", "mesh", "points", "s", "volume", "angle", "after", "rounds", "stuck",
             "stopped because");
}

TEST(CgalMeshes, ThatAreClosedAndFreeOfIntersectionsStaySo) {
  SKIP_WITHOUT_CGAL_ARCHIVE();
  print_header();
  for (const ArchiveMesh& input : usable_meshes()) {
    SCOPED_TRACE(input.name);
    TriangleMesh reference = input.mesh;
    prepare(reference, CavityPolicy::delete_cavities);
    TriangleMesh after = input.mesh;
    const Stopwatch stopwatch;
    const ImproveReport report = improve(after, {});
    print_row(input.name, reference, after, report, stopwatch.elapsed().wall);
    EXPECT_THAT(after, HasNoIntersections());
    EXPECT_THAT(after, IsClosedManifold());
    EXPECT_GT(enclosed_volume(after), 0);
    EXPECT_EQ(shells(after), shells(without_removed_components(reference, CavityPolicy::delete_cavities)));
  }
}

TEST(CgalMeshes, KeepThePromiseWithManySettings) {
  SKIP_WITHOUT_CGAL_ARCHIVE();
  std::size_t index = 0;
  for (const ArchiveMesh& input : usable_meshes()) {
    if (input.mesh.vertex_count() > kLargest) continue;
    SCOPED_TRACE(input.name);
    TriangleMesh mesh = input.mesh;
    prepare(mesh, CavityPolicy::keep);  // turned outwards, without isolated vertices
    expect_promise_kept(mesh, combination(index++));
  }
}

TEST(CgalMeshes, IncludeTheWellKnownOnes) {
  SKIP_WITHOUT_CGAL_ARCHIVE();
  std::set<std::string> names;
  std::vector<std::string> rejected;
  for (const ArchiveMesh& mesh : read_cgal_archive(&rejected)) {
    if (mesh.unusable_because.empty()) names.insert(mesh.name);
    if (!mesh.unusable_because.empty()) fmt::print("left out: {}, {}\n", mesh.name, mesh.unusable_because);
  }
  for (const std::string& why : rejected) fmt::print("not read: {}\n", why);
  EXPECT_THAT(names, IsSupersetOf({"cheese", "turbine", "anchor_dense", "retinal", "femur", "homer"}));
}

/// Improves a mesh with intersections by each step rule; redundant points are kept so that the triangles keep their numbers.
void expect_no_new_pairs_by_any_rule(const std::string& name, const TriangleMesh& input) {
  for (const StepRule step : {StepRule::umbrella, StepRule::volume_preserving, StepRule::tangential}) {
    ImproveOptions options;
    options.deletes_redundant_points = false;
    options.cavities = CavityPolicy::keep;
    options.smoothing.step = step;
    SCOPED_TRACE(fmt::format("{}, {}", name, describe(options)));
    TriangleMesh after = input;
    const Stopwatch stopwatch;
    const ImproveReport report = improve(after, options);
    print_row(name, input, after, report, stopwatch.elapsed().wall);
    EXPECT_THAT(new_pairs(input, after), IsEmpty());
    EXPECT_THAT(after, IsClosedManifold());
    EXPECT_GT(report.smoothing.moves.refused, 0U);
    EXPECT_GT(report.smoothing.stuck, 0U);
  }
}

TEST(CgalMeshes, CamelAndManGetNoNewIntersectionByAnyStepRule) {
  SKIP_WITHOUT_CGAL_ARCHIVE();
  print_header();
  for (const auto& [name, pairs] : {std::pair<std::string, std::size_t>{"camel", 20}, {"man", 848}}) {
    const TriangleMesh mesh = read_from_cgal_archive(name);
    EXPECT_EQ(intersecting_pairs(mesh).size(), pairs);
    expect_no_new_pairs_by_any_rule(name, mesh);
  }
}

TEST(CgalMeshes, WithIntersectionsGetNoNewOnes) {
  SKIP_WITHOUT_CGAL_ARCHIVE();
  std::size_t index = 0;
  for (const ArchiveMesh& input : read_cgal_archive()) {
    if (!input.unusable_because.ends_with("intersecting pairs") || input.mesh.vertex_count() > kLargest) continue;
    SCOPED_TRACE(input.name);
    for (int i = 0; i < 3; ++i) {
      ImproveOptions options = combination(index++);
      options.cavities = CavityPolicy::keep;
      expect_no_new_fault(input.mesh, options);
    }
  }
}

}  // namespace
}  // namespace smopt
