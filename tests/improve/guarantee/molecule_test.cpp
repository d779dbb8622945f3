#include <fmt/format.h>
#include <gmock/gmock.h>

#include "smopt/improve/improve.h"
#include "smopt/surface/gaussian_surface.h"
#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/support/files.h"
#include "tests/support/matchers.h"

namespace smopt {
namespace {

using namespace testing;
using ::testing::AnyOf;

/// Fasciculin 2 (906 atoms) where apbs-data is installed, else as many random atoms.
TriangleMesh molecule_surface() {
  const std::filesystem::path file = apbs_molecule("misc/fas2.pqr");
  return file.empty() ? random_molecule_surface(900, 1) : gaussian_surface(read_molecule(file), {});
}

ImproveOptions with_step(StepRule step) {
  ImproveOptions options;
  options.smoothing.step = step;
  return options;
}

TEST(MoleculeSurface, KeepsItsVolumeByTheVolumePreservingStep) {
  ImproveOptions options = with_step(StepRule::volume_preserving);
  for (const bool is_eager : {false, true}) {
    if (is_eager) options.smoothing.thresholds = {0.3, 20};
    TriangleMesh after = molecule_surface(), without_rounds = after;
    const ImproveReport report = improve(after, options);
    EXPECT_GT(report.smoothing.moves.accepted, after.vertex_count() / 2);
    options.smoothing.rounds = 0;
    improve(without_rounds, options);
    options.smoothing.rounds = SmoothingOptions{}.rounds;
    EXPECT_EQ(after.triangles, without_rounds.triangles);
    EXPECT_NEAR(enclosed_volume(after) / enclosed_volume(without_rounds), 1, 1e-9);
  }
}

/// The triangles that one screening would find, counted without it.
std::size_t count_low_quality(const TriangleMesh& mesh, const QualityThresholds& thresholds) {
  std::size_t low = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 &a = mesh.points[i], &b = mesh.points[j], &c = mesh.points[k];
    if (edge_ratio(a, b, c) < thresholds.edge_ratio || smallest_angle_deg(a, b, c) < thresholds.min_angle_deg) ++low;
  }
  return low;
}

/// How many rounds it took until nothing moved any more.
std::size_t rounds_until_nothing_moved(const SmoothingReport& report) {
  std::size_t count = report.rounds.size();
  while (count > 0 && report.rounds[count - 1].moves.accepted == 0) --count;
  return count;
}

TriangleMesh improved(TriangleMesh mesh, ImproveOptions options, std::size_t rounds) {
  options.smoothing.rounds = static_cast<int>(rounds);
  improve(mesh, options);
  return mesh;
}

class EachStep : public ::testing::TestWithParam<StepRule> {};
INSTANTIATE_TEST_SUITE_P(MoleculeSurface, EachStep,
                         ::testing::Values(StepRule::umbrella, StepRule::volume_preserving, StepRule::tangential));

TEST_P(EachStep, TellsInWhichRoundItConverged) {
  constexpr int kPlenty = 1000;
  const TriangleMesh before = molecule_surface();
  ImproveOptions options = with_step(GetParam());
  options.smoothing.rounds = kPlenty;
  for (const QualityThresholds& thresholds : {QualityThresholds{}, QualityThresholds{0.2, 15}}) {
    SCOPED_TRACE(fmt::format("angles below {}", thresholds.min_angle_deg));
    options.smoothing.thresholds = thresholds;
    TriangleMesh converged = before;
    const SmoothingReport report = improve(converged, options).smoothing;
    const std::size_t rounds = rounds_until_nothing_moved(report);
    fmt::print("{} after {} rounds, the last {} of which moved nothing; {} vertices stuck\n", report.stopped_because, report.rounds.size(),
               report.rounds.size() - rounds, report.stuck);
    ASSERT_LT(report.rounds.size(), kPlenty);
    EXPECT_THAT(report.stopped_because, AnyOf("quality reached", "nothing moved"));
    EXPECT_EQ(report.stopped_because == "quality reached", count_low_quality(converged, thresholds) == 0);
    EXPECT_TRUE(is_same(improved(before, options, rounds), converged));
    EXPECT_FALSE(is_same(improved(before, options, rounds - 1), converged));
  }
}

}  // namespace
}  // namespace smopt
