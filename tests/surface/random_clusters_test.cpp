#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "smopt/surface/adaptive_surface.h"
#include "smopt/surface/gaussian_surface.h"
#include "tests/support/matchers.h"
#include "tests/support/molecules.h"
#include "tests/surface/self_intersections.h"

namespace smopt {
namespace {

using namespace testing;

constexpr std::uint32_t kShards = 20;
constexpr std::uint32_t kClustersPerShard = 25;

double log_uniform(double low, double high, std::mt19937& random) {
  return std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(random));
}

/// Random clusters of 1 to 200 atoms, decays from 0.3 to 1.2 and cell sizes: 500 in all.
class RandomClusters : public ::testing::TestWithParam<std::uint32_t> {
 protected:
  static void expect_sound(const TriangleMesh& mesh, const std::string& what) {
    EXPECT_THAT(mesh, IsClosedManifold()) << what;
    EXPECT_EQ(count_self_intersections(mesh), 0U) << what;
    EXPECT_GT(enclosed_volume(mesh), 0) << what;
  }
};
INSTANTIATE_TEST_SUITE_P(Shard, RandomClusters, ::testing::Range(0U, kShards));

TEST_P(RandomClusters, HaveSoundSurfacesFromBothSamplers) {
  for (std::uint32_t i = 0; i < kClustersPerShard; ++i) {
    const std::uint32_t seed = 1000 + GetParam() * kClustersPerShard + i;
    std::mt19937 random(seed);
    const auto atoms = static_cast<std::size_t>(log_uniform(1, 200.99, random));
    Molecule molecule = random_cluster(atoms, seed);
    molecule.radii.front() = 2;  // so that the isovalue is reached
    GaussianSurfaceOptions options;
    options.decay = std::uniform_real_distribution<double>(0.3, 1.2)(random);
    options.spacing = log_uniform(0.3, 1.2, random);
    const double error = log_uniform(0.1, 2, random);
    const std::string what =
        fmt::format("seed {}: {} atoms, decay {}, spacing {}, error {}", seed, atoms, options.decay, options.spacing, error);
    expect_sound(gaussian_surface(molecule, options), what + " (uniform)");
    const GaussianField field(molecule, {options.decay, 1e-6});
    expect_sound(adaptive_surface(partition_space(field, options.isovalue, error)), what + " (adaptive)");
  }
}

}  // namespace
}  // namespace smopt
