#include "smopt/io/small_radii.h"

#include <gmock/gmock.h>

#include <limits>

#include "smopt/error.h"

namespace smopt::testing {
namespace {

using ::testing::ElementsAre;

Molecule with_radii(std::vector<double> radii) {
  Molecule molecule;
  molecule.centers.resize(radii.size(), Vec3::Zero());
  molecule.charges.resize(radii.size(), 0.5);
  molecule.radii = std::move(radii);
  return molecule;
}

TEST(SmallRadii, BecomeTheRadiusOfTmsmesh) {
  Molecule molecule = with_radii({0, 0.499, 0.5, 0.55, 1.8});
  EXPECT_EQ(raise_small_radii(molecule), 2U);
  EXPECT_THAT(molecule.radii, ElementsAre(0.6, 0.6, 0.5, 0.55, 1.8));
  EXPECT_EQ(raise_small_radii(molecule), 0U) << "once is enough";
}

TEST(SmallRadii, AreThoseBelowTheThreshold) {
  Molecule molecule = with_radii({0.9, 1.0, 1.1});
  EXPECT_EQ(raise_small_radii(molecule, 1.0, 1.0), 1U);
  EXPECT_THAT(molecule.radii, ElementsAre(1.0, 1.0, 1.1));
  EXPECT_EQ(raise_small_radii(molecule, 0, 0), 0U);
}

TEST(SmallRadii, AreNeverMadeSmallerOrMeaningless) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Molecule molecule = with_radii({0.1});
  EXPECT_THROW(raise_small_radii(molecule, 0.5, 0.4), InvalidOption);
  EXPECT_THROW(raise_small_radii(molecule, -0.5, 0.4), InvalidOption);
  EXPECT_THROW(raise_small_radii(molecule, kNan, 0.6), InvalidOption);
  EXPECT_THROW(raise_small_radii(molecule, 0.5, kNan), InvalidOption);
  EXPECT_THROW(raise_small_radii(molecule, 0.5, kInfinity), InvalidOption);
  EXPECT_THAT(molecule.radii, ElementsAre(0.1));
}

TEST(SmallRadii, MayBeThoseOfNoAtom) {
  Molecule empty;
  EXPECT_EQ(raise_small_radii(empty), 0U);
}

}  // namespace
}  // namespace smopt::testing
