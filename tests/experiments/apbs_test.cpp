#include "experiments/apbs/apbs.h"

#include <gmock/gmock.h>

#include <cmath>

#include "smopt/error.h"

namespace smopt::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

Molecule ion(double charge, double radius) {
  return {{Vec3(1, -2, 0.5)}, {charge}, {radius}};
}

/// Born's energy with the electrolyte's factor of Debye and Hückel; its units from CODATA, not AFMPB's rounded ones.
double born_energy(double charge, double radius, const metrics::DielectricModel& medium) {
  constexpr double kCoulomb = 332.0637;
  return kCoulomb * charge * charge / (2 * radius) * (1 / (medium.outer * (1 + medium.kappa() * radius)) - 1 / medium.inner);
}

TEST(ApbsGrid, IsAsFineAsAskedAndHoldsTheMolecule) {
  const Molecule two = {{Vec3(0, 0, 0), Vec3(40, 10, 0)}, {1, -1}, {2, 3}};
  const ApbsGrid grid = apbs_grid(two, 0.5);
  EXPECT_EQ(grid.spacing, 0.5);
  EXPECT_EQ(grid.center, Vec3(20.5, 5.5, 0));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GE(grid.length()[axis], Vec3(45 + 20, 15 + 20, 6 + 20)[axis]);
    EXPECT_EQ(grid.nodes.at(static_cast<std::size_t>(axis)) % 32, 1);
    EXPECT_GE(grid.coarse_length[axis], grid.length()[axis]);
  }
  EXPECT_THROW(apbs_grid(two, 1e-9), InvalidOption);
  EXPECT_THROW(apbs_grid(two, 0), InvalidOption);
  EXPECT_THROW(apbs_grid(two, NAN), InvalidOption);
}

TEST(ApbsInput, TheReferenceIsTheSoluteInItsOwnMediumWithoutIons) {
  const std::string text = apbs_input("m.pqr", {}, ApbsSurface::molecular, apbs_grid(ion(1, 2), 1));
  const std::string solvated = text.substr(0, text.find("elec name reference"));
  const std::string reference = text.substr(text.find("elec name reference"));
  EXPECT_THAT(solvated, HasSubstr("sdie 80"));
  EXPECT_THAT(solvated, HasSubstr("ion charge -1 conc 0.15 radius 0\n"));
  EXPECT_THAT(reference, HasSubstr("pdie 2\n  sdie 2\n"));
  EXPECT_THAT(reference, Not(HasSubstr("ion charge")));
}

TEST(ApbsInput, EveryPropertyOfTheMoleculeIsInThePqr) {
  EXPECT_EQ(format_pqr(ion(-0.25, 1.824)), "ATOM 1 C MOL 1 1.000000 -2.000000 0.500000 -0.250000 1.824000\n");
}

TEST(ApbsOutput, GivesTheLastDifferenceInKilocalories) {
  EXPECT_DOUBLE_EQ(parse_apbs_energy("  Global net ELEC energy = 1.0 kJ/mol\n  Global net ELEC energy = -4.184E+02 kJ/mol\n"), -100);
  for (const char* text : {"", "Global net ELEC energy =", "Global net ELEC energy = x", "Global net ELEC energy = nan"})
    EXPECT_THROW(parse_apbs_energy(text), MethodFailed) << text;
}

TEST(Apbs, GivesBornsEnergyOfAnIon) {
  if (!has_apbs()) GTEST_SKIP() << "apbs is not installed";
  for (const double ionic_strength : {0.0, 150.0}) {
    ApbsOptions options;
    options.medium.ionic_strength = ionic_strength;
    options.spacing = 0.4;
    const ApbsResult result = run_apbs(ion(-2, 3), options);
    const double expected = born_energy(-2, 3, options.medium);
    EXPECT_NEAR(result.polar, expected, 0.05 * std::abs(expected)) << ionic_strength << " mM";
    EXPECT_GT(result.seconds, 0);
  }
}

TEST(Apbs, TheGaussianSurfaceOfOneAtomIsItsSphere) {
  if (!has_apbs()) GTEST_SKIP() << "apbs is not installed";
  // exp(-d (x² - r²)) = 1 where x = r, whatever d.
  ApbsOptions options;
  options.surface = ApbsSurface::gaussian;
  options.spacing = 0.4;
  EXPECT_NEAR(run_apbs(ion(-2, 3), options).polar, born_energy(-2, 3, options.medium), 0.05 * std::abs(born_energy(-2, 3, options.medium)));
  options.gaussian.isovalue = std::exp(options.gaussian.decay * (9 - 4));
  const double expected = born_energy(-2, 2, options.medium);
  EXPECT_NEAR(run_apbs(ion(-2, 3), options).polar, expected, 0.05 * std::abs(expected)) << "the sphere of 2 Å";
}

TEST(Apbs, ASpacingThatNeedsTooMuchMemoryIsAFailureWithTheEstimate) {
  if (!has_apbs()) GTEST_SKIP() << "apbs is not installed";
  ApbsOptions options;
  options.spacing = 0.05;
  options.limits.memory_mb = 1000;
  EXPECT_THAT([&] { run_apbs(ion(1, 2), options); }, ThrowsMessage<MethodFailed>(HasSubstr("1000 MB are allowed")));
  EXPECT_THROW(run_apbs({}, options), InvalidInput);
}

TEST(Apbs, OutOfTimeIsAFailureWithTheLimit) {
  if (!has_apbs()) GTEST_SKIP() << "apbs is not installed";
  ApbsOptions options;
  options.limits.seconds = 0.05;
  EXPECT_THAT([&] { run_apbs(ion(1, 2), options); }, ThrowsMessage<MethodFailed>(HasSubstr("0.05 s")));
}

}  // namespace
}  // namespace smopt::experiments
