#include "smopt/io/radius_set.h"

#include <gtest/gtest.h>

#include "smopt/error.h"

namespace smopt::testing {
namespace {

const std::string kSymbols =
    "H He Li Be B C N O F Ne Na Mg Al Si P S Cl Ar K Ca Sc Ti V Cr Mn Fe Co Ni Cu Zn Ga Ge As Se Br Kr Rb Sr Y Zr Nb Mo Tc Ru Rh Pd Ag Cd "
    "In Sn "
    "Sb Te I Xe Cs Ba La Ce Pr Nd Pm Sm Eu Gd Tb Dy Ho Er Tm Yb Lu Hf Ta W Re Os Ir Pt Au Hg Tl Pb Bi Po At Rn Fr Ra Ac Th Pa U Np Pu Am "
    "Cm Bk "
    "Cf Es Fm Md No Lr";

std::vector<std::string> periodic_table() {
  std::istringstream in(kSymbols);
  return {std::istream_iterator<std::string>(in), {}};
}

TEST(RadiusSet, KnowsTheSymbolsOfThePeriodicTableAndNoOthers) {
  const std::vector<std::string> symbols = periodic_table();
  ASSERT_EQ(symbols.size(), 103U) << "lawrencium's atomic number";
  std::size_t known = 0;
  for (char a = 'A'; a <= 'Z'; ++a) {
    known += is_element(std::string{a});
    for (char b = 'a'; b <= 'z'; ++b) known += is_element({std::string{a, b}});
  }
  for (const std::string& symbol : symbols) EXPECT_TRUE(is_element(symbol)) << symbol;
  EXPECT_EQ(known, symbols.size() + 1) << "and D";
  for (const char* none : {"", " ", "X", "Uue", "C1", "1", "\xc3\x85", "CA ", "[", "a["}) EXPECT_FALSE(is_element(none)) << none;
}

TEST(RadiusSet, TakesSymbolsInWhateverCase) {
  for (const char* symbol : {"Zn", "ZN", "zn", "zN"}) EXPECT_EQ(element_radius(symbol, RadiusSet::bondi), 1.39) << symbol;
}

// From the articles: Bondi's table I, Mantina's table 12, Batsanov's table 9, parm99's R*.
TEST(RadiusSet, HasThePublishedValues) {
  EXPECT_EQ(element_radius("H", RadiusSet::bondi), 1.20);
  EXPECT_EQ(element_radius("C", RadiusSet::bondi), 1.70);
  EXPECT_EQ(element_radius("N", RadiusSet::bondi), 1.55);
  EXPECT_EQ(element_radius("O", RadiusSet::bondi), 1.52);
  EXPECT_EQ(element_radius("P", RadiusSet::bondi), 1.80);
  EXPECT_EQ(element_radius("S", RadiusSet::bondi), 1.80);
  EXPECT_EQ(element_radius("Ca", RadiusSet::bondi), 2.31);
  EXPECT_EQ(element_radius("Fe", RadiusSet::bondi), 2.05);
  EXPECT_EQ(element_radius("C", RadiusSet::amber), 1.908);
  EXPECT_EQ(element_radius("N", RadiusSet::amber), 1.824);
  EXPECT_EQ(element_radius("O", RadiusSet::amber), 1.6612);
  EXPECT_EQ(element_radius("P", RadiusSet::amber), 2.1);
  EXPECT_EQ(element_radius("S", RadiusSet::amber), 2.0);
  EXPECT_EQ(element_radius("H", RadiusSet::amber), 1.487);
}

TEST(RadiusSet, GivesDeuteriumTheRadiusOfHydrogen) {
  for (const RadiusSet set : {RadiusSet::bondi, RadiusSet::amber}) EXPECT_EQ(element_radius("D", set), element_radius("H", set));
}

TEST(RadiusSet, HasNothingRatherThanAGuess) {
  EXPECT_EQ(element_radius("Gd", RadiusSet::bondi), std::nullopt);
  EXPECT_EQ(element_radius("Fe", RadiusSet::amber), std::nullopt);
  EXPECT_EQ(element_radius("Xx", RadiusSet::bondi), std::nullopt);
}

TEST(RadiusSet, HasNoRadiusThatNoAtomHas) {
  for (const std::string& symbol : periodic_table()) {
    for (const RadiusSet set : {RadiusSet::bondi, RadiusSet::amber}) {
      const double radius = element_radius(symbol, set).value_or(1);
      EXPECT_GT(radius, 0.5) << symbol;
      EXPECT_LT(radius, 3.5) << symbol;
    }
  }
}

TEST(RadiusSet, IsFoundByItsName) {
  EXPECT_EQ(radius_set_names(), "bondi, amber");
  for (const RadiusSet set : {RadiusSet::bondi, RadiusSet::amber}) EXPECT_EQ(radius_set_by_name(radius_set_name(set)), set);
  EXPECT_THROW(radius_set_by_name("Bondi"), InvalidOption);
}

}  // namespace
}  // namespace smopt::testing
