#include "smopt/surface/gaussian_grid.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

namespace smopt {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Molecule molecule_of(std::vector<Vec3> centers, std::vector<double> radii) {
  const std::size_t n = centers.size();
  return {std::move(centers), std::vector<double>(n, 0.0), std::move(radii)};
}

Molecule random_molecule(std::size_t atoms, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-5, 5);
  std::uniform_real_distribution<double> radius(0, 2);
  Molecule molecule;
  for (std::size_t i = 0; i < atoms; ++i) {
    molecule.centers.emplace_back(place(random), place(random), place(random));
    molecule.radii.push_back(radius(random));
    molecule.charges.push_back(0);
  }
  return molecule;
}

double direct_sum(const Molecule& molecule, double decay, const Vec3& x) {
  double sum = 0;
  for (std::size_t i = 0; i < molecule.atom_count(); ++i)
    sum += std::exp(-decay * ((x - molecule.centers[i]).squaredNorm() - molecule.radii[i] * molecule.radii[i]));
  return sum;
}

TEST(GaussianGrid, IsTheSumOfTheKernelsUpToTheTermsLeftOut) {
  const Molecule molecule = random_molecule(30, 1);
  const GaussianGridOptions options{0.6, 0.7, 1e-6};
  const ScalarGrid grid = gaussian_grid(molecule, options);
  const double bound = options.least_term * 30;
  for (std::size_t k = 0; k < grid.size[2]; ++k) {
    for (std::size_t j = 0; j < grid.size[1]; ++j) {
      for (std::size_t i = 0; i < grid.size[0]; ++i) {
        const double expected = direct_sum(molecule, options.decay, {grid.coordinate(0, i), grid.coordinate(1, j), grid.coordinate(2, k)});
        ASSERT_NEAR(grid.values[grid.index(i, j, k)], expected, bound + 1e-13 * expected) << i << " " << j << " " << k;
      }
    }
  }
}

TEST(GaussianGrid, IsZeroOnTheOutermostNodes) {
  const ScalarGrid grid = gaussian_grid(random_molecule(10, 2), {0.6, 0.5, 1e-6});
  for (std::size_t k = 0; k < grid.size[2]; ++k) {
    for (std::size_t j = 0; j < grid.size[1]; ++j) {
      for (std::size_t i = 0; i < grid.size[0]; ++i) {
        const bool outermost = i == 0 || j == 0 || k == 0 || i + 1 == grid.size[0] || j + 1 == grid.size[1] || k + 1 == grid.size[2];
        if (outermost) {
          ASSERT_EQ(grid.values[grid.index(i, j, k)], 0.0);
        }
      }
    }
  }
}

TEST(GaussianGrid, IsSampledOnAGridCoarserThanTheMolecule) {
  const ScalarGrid grid = gaussian_grid(molecule_of({{0, 0, 0}}, {1}), {0.6, 50, 1e-6});
  EXPECT_EQ(grid.node_count(), grid.values.size());
  EXPECT_GE(*std::min_element(grid.size.begin(), grid.size.end()), 3U);
}

TEST(GaussianGrid, RefusesMoleculesItCannotSample) {
  const auto sample = [](const Molecule& molecule) { return [&molecule] { gaussian_grid(molecule, {}); }; };
  const Molecule empty;
  EXPECT_THAT(sample(empty), ThrowsMessage<InvalidInput>(HasSubstr("no atoms")));
  const Molecule negative = molecule_of({{0, 0, 0}, {1, 0, 0}}, {1, -1.5});
  EXPECT_THAT(sample(negative), ThrowsMessage<InvalidInput>(HasSubstr("atom 2 of 2: the radius -1.5 is negative")));
  const Molecule nan_radius = molecule_of({{0, 0, 0}}, {std::nan("")});
  EXPECT_THAT(sample(nan_radius), ThrowsMessage<InvalidInput>(HasSubstr("atom 1 of 1: the radius nan is not finite")));
  const Molecule infinite = molecule_of({{0, kInfinity, 0}}, {1});
  EXPECT_THAT(sample(infinite), ThrowsMessage<InvalidInput>(HasSubstr("atom 1 of 1: the position (0, inf, 0)")));
  const Molecule huge = molecule_of({{0, 0, 0}}, {100});
  EXPECT_THAT(sample(huge), ThrowsMessage<InvalidInput>(HasSubstr("too large")));
  const Molecule unequal{{{0, 0, 0}}, {0}, {}};
  EXPECT_THAT(sample(unequal), ThrowsMessage<InvalidInput>(HasSubstr("1 atoms and 0 radii")));
}

TEST(GaussianGrid, RefusesAGridThatIsTooLargeAndStatesItsSize) {
  const Molecule far_apart = molecule_of({{0, 0, 0}, {1e6, 1e6, 1e6}}, {1, 1});
  EXPECT_THAT(
      [&] {
        gaussian_grid(far_apart, {0.6, 1, 1e-6});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("1000013 x 1000013 x 1000013 nodes")));
}

TEST(GaussianGrid, RefusesOptionsOutOfRange) {
  const Molecule molecule = molecule_of({{0, 0, 0}}, {1});
  for (const double bad : {0.0, -1.0, kInfinity, std::nan("")}) {
    EXPECT_THROW(gaussian_grid(molecule, {bad, 1, 1e-6}), InvalidOption);
    EXPECT_THROW(gaussian_grid(molecule, {0.6, bad, 1e-6}), InvalidOption);
    EXPECT_THROW(gaussian_grid(molecule, {0.6, 1, bad}), InvalidOption);
  }
}

TEST(GaussianGrid, StopsWhenTheCallbackSaysSo) {
  EXPECT_THROW(gaussian_grid(molecule_of({{0, 0, 0}}, {1}), {}, [](auto, double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace smopt
