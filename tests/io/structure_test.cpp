#include <gmock/gmock.h>

#include <random>

#include "smopt/error.h"
#include "smopt/io/mmcif.h"
#include "smopt/io/pdb.h"
#include "smopt/io/pqr.h"
#include "smopt/io/xyzr.h"
#include "tests/io/structure_files.h"

// What PDB and mmCIF have in common: which atoms are kept, and that both give the same.
namespace smopt::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Atoms 1, 2, 3, … by x, so that the test sees which were kept.
std::vector<MadeAtom> numbered(std::vector<MadeAtom> atoms) {
  for (std::size_t i = 0; i < atoms.size(); ++i) atoms[i].center = Vec3(static_cast<double>(i + 1), 0.125, -7);
  return atoms;
}

/// Which of the atoms are kept, by PDB and mmCIF alike.
std::vector<double> kept(const std::vector<MadeAtom>& atoms, const MoleculeReadOptions& options = {}) {
  const std::vector<MadeAtom> all = numbered(atoms);
  const std::vector<double> from_pdb = xs_of(molecule_in("a.pdb", pdb_of(all), options));
  EXPECT_EQ(from_pdb, xs_of(molecule_in("a.cif", cif_of(all), options)));
  return from_pdb;
}

TEST(Structure, IsTheSameFromPdbAndMmcif) {
  const std::vector<MadeAtom> atoms = numbered({{"N", "N"},
                                                {"C", "CA", "A", "SER", 2, {}, 0.4},
                                                {"C", "CA", "B", "SER", 2, {}, 0.6},
                                                {"O", "O5'", " ", "DG", 3},
                                                {"ZN", "ZN", " ", "ZN", 4},
                                                {"H", "HG11", " ", "VAL", 5},
                                                {"O", "O", " ", "HOH", 6}});
  for (const RadiusSet set : {RadiusSet::bondi, RadiusSet::amber}) {
    for (const bool keep_waters : {false, true}) {
      MoleculeReadReport pdb_report;
      MoleculeReadReport cif_report;
      const Molecule from_pdb = molecule_in("a.pdb", pdb_of(atoms), {set, keep_waters}, &pdb_report);
      const Molecule from_cif = molecule_in("a.cif", cif_of(atoms), {set, keep_waters}, &cif_report);
      EXPECT_EQ(from_pdb.centers, from_cif.centers);
      EXPECT_EQ(from_pdb.radii, from_cif.radii);
      EXPECT_EQ(from_pdb.charges, from_cif.charges);
      EXPECT_EQ(pdb_report.notes, cif_report.notes);
      EXPECT_EQ(from_pdb.atom_count(), keep_waters ? 6U : 5U);
    }
  }
}

TEST(Structure, LeavesWaterOutUnlessAskedToKeepIt) {
  const std::vector<MadeAtom> atoms = {
      {"C"}, {"O", "O", " ", "HOH", 2}, {"O", "O", " ", "DOD", 3}, {"O", "OW", " ", "WAT", 4}, {"O", "O", " ", "OHO", 5}};
  EXPECT_THAT(kept(atoms), ElementsAre(1, 5));
  EXPECT_THAT(kept(atoms, {.keep_waters = true}), ElementsAre(1, 2, 3, 4, 5));
}

TEST(Structure, RejectsAMoleculeOfNothingButWater) {
  EXPECT_EQ(molecule_rejection("a.pdb", pdb_of({{"O", "O", " ", "HOH"}})), "a.pdb: all 1 atoms are water's, which is left out");
  EXPECT_EQ(molecule_rejection("a.pdb", pdb_of({{"O", "O", " ", "HOH"}}), {.keep_waters = true}), "");
}

TEST(Structure, KeepsTheAlternateLocationOfTheHighestOccupancy) {
  EXPECT_THAT(kept({{"C", "CA", "A", "SER", 1, {}, 0.3}, {"C", "CA", "B", "SER", 1, {}, 0.7}, {"N", "N", " ", "SER", 1}}),
              ElementsAre(2, 3));
}

TEST(Structure, KeepsTheFirstOfAlternateLocationsOfTheSameOccupancy) {
  EXPECT_THAT(kept({{"C", "CA", "B", "SER", 1, {}, 0.5}, {"C", "CA", "A", "SER", 1, {}, 0.5}, {"C", "CA", "C", "SER", 1, {}, 0.5}}),
              ElementsAre(1));
}

TEST(Structure, KeepsTheLocationWithoutALabel) {
  EXPECT_THAT(kept({{"C", "CA", "B", "SER", 1, {}, 0.9}, {"C", "CA", " ", "SER", 1, {}, 0.1}}), ElementsAre(2));
}

TEST(Structure, KeepsEveryAtomWithAtLeastOneLocation) {
  EXPECT_THAT(kept({{"C", "CA", "A", "SER", 1, {}, 0.6}, {"C", "CA", "B", "SER", 1, {}, 0.4}, {"O", "OG", "B", "SER", 1, {}, 0.4}}),
              ElementsAre(1, 3));
}

TEST(Structure, TellsAlternateLocationsFromOtherResiduesAtoms) {
  EXPECT_THAT(kept({{"C", "CA", "A", "SER", 1}, {"C", "CA", "A", "SER", 2}, {"C", "CB", "A", "SER", 1}}), ElementsAre(1, 2, 3));
  const std::string insertion =
      "ATOM      1  CA AGLY A   1       1.000   2.000   3.000\nATOM      2  CA AGLY A   1A      4.000   2.000   3.000\n";
  EXPECT_EQ(molecule_in("a.pdb", insertion).atom_count(), 2U);
  const std::string chains =
      "ATOM      1  CA AGLY A   1       1.000   2.000   3.000\nATOM      2  CA AGLY B   1       4.000   2.000   3.000\n";
  EXPECT_EQ(molecule_in("a.pdb", chains).atom_count(), 2U);
}

// Files by other programs name all carbons of a ligand C, or have a letter in column 17 that is no label.
TEST(Structure, NeverTakesAtomsOfTheSameNameForAlternateLocations) {
  EXPECT_THAT(kept({{"C", "C"}, {"C", "C"}, {"C", "C", "A", "LIG", 2}, {"C", "C", "A", "LIG", 2}}), ElementsAre(1, 2, 3, 4));
}

TEST(Structure, KeepsOneResidueWhereTwoShareAPlace) {
  EXPECT_THAT(kept({{"C", "CA", "A", "SER", 1, {}, 0.4},
                    {"O", "OG", "A", "SER", 1, {}, 0.4},
                    {"C", "CA", "B", "THR", 1, {}, 0.6},
                    {"C", "CG2", "B", "THR", 1, {}, 0.6}}),
              ElementsAre(3, 4));
}

TEST(Structure, KeepsTheFirstModelOnly) {
  EXPECT_THAT(kept({{"C"}, {.name = "CB", .model = 1}, {.model = 2}, {.name = "CB", .model = 2}}), ElementsAre(1, 2));
}

TEST(Structure, CountsTheAlternateLocationsLeftOut) {
  MoleculeReadReport report;
  molecule_in("a.pdb", pdb_of({{"C", "CA", "A"}, {"C", "CA", "B"}, {"C", "CA", "C"}}), {}, &report);
  EXPECT_THAT(report.notes, Contains("2 alternate locations left out"));
}

/// A file of every format, and what reads it.
struct FuzzedFormat {
  std::string text;
  void (*parse)(const std::string& text);
};

const std::string kName = "fuzzed";

template <auto parse>
void parse_structure(const std::string& text) {
  MoleculeReadReport report;
  parse(text, kName, {}, report);
}

std::vector<FuzzedFormat> fuzzed_formats() {
  const std::vector<MadeAtom> atoms =
      numbered({{"N", "N"}, {"C", "CA", "A"}, {"C", "CA", "B"}, {"O", "O5'", " ", "DG", 3}, {"ZN", "ZN", " ", "ZN", 4}});
  return {{pdb_of(atoms), parse_structure<parse_pdb>},
          {cif_of(atoms) + "_a.b\n;text\n;\n_a.c 'quoted'\n", parse_structure<parse_mmcif>},
          {"ATOM 1 N GLY 1 1.0 2.0 3.0 0.5 1.5\nATOM      1  N   NTER    4      68.227-100.558 -13.641  0.185 1.824\n",
           [](const std::string& text) { parse_pqr(text, kName); }},
          {"# spheres\n1.0 2.0 3.0 1.5\n-1e1 0 0 1.2 1 label\n", [](const std::string& text) { parse_xyzr(text, kName); }}};
}

/// Whether it was read; anything but InvalidInput goes on to the test.
bool is_read(const FuzzedFormat& format, const std::string& text) {
  try {
    format.parse(text);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

TEST(MoleculeFuzz, EveryTruncationIsReadOrRefused) {
  for (const FuzzedFormat& format : fuzzed_formats()) {
    EXPECT_TRUE(is_read(format, format.text));
    for (std::size_t size = 0; size < format.text.size(); ++size) EXPECT_NO_THROW(is_read(format, format.text.substr(0, size))) << size;
  }
}

TEST(MoleculeFuzz, EveryDamageIsReadOrRefused) {
  constexpr std::uint32_t kSeed = 4;
  constexpr int kTries = 20000;
  constexpr std::string_view kMeaningful = "\n\r\t '\";#_.-+e0129()\0\xff*";
  std::mt19937 random(kSeed);
  for (const FuzzedFormat& format : fuzzed_formats()) {
    int refused = 0;
    for (int i = 0; i < kTries; ++i) {
      std::string text = format.text;
      for (auto flips = 1 + random() % 4; flips > 0; --flips) text[random() % text.size()] = kMeaningful[random() % kMeaningful.size()];
      if (random() % 4 == 0) text.erase(random() % text.size(), random() % 20);
      EXPECT_NO_THROW(refused += !is_read(format, text)) << "seed " << kSeed << ": " << text;
    }
    EXPECT_GT(refused, 0) << "the damage was none";
    EXPECT_LT(refused, kTries) << "everything was refused";
  }
}

}  // namespace
}  // namespace smopt::testing
