#include "smopt/io/pdb.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "smopt/io/gzip.h"
#include "tests/io/structure_files.h"

namespace smopt::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The format's own example lines (wwPDB, file format 3.3, section 9).
const std::string kExample =
    "ATOM     32  N  AARG A  -3      11.281  86.699  94.383  0.50 35.88           N  \n"
    "ATOM     33  N  BARG A  -3      11.296  86.721  94.521  0.50 35.60           N  \n"
    "ATOM     34  CA AARG A  -3      12.353  85.696  94.456  0.50 36.67           C  \n"
    "HETATM 8237 MG    MG A1001      13.872  -2.555 -29.045  1.00 27.36          MG  \n";

double radius_of_line(const std::string& line) {
  return molecule_in("a.pdb", line).radii.at(0);
}

/// A line without columns 77–78.
std::string without_element(const std::string& name, const std::string& residue) {
  return fmt::format("ATOM      1 {:<4} {:>3} A   1       1.000   2.000   3.000  1.00 20.00\n", name, residue);
}

constexpr double kH = 1.20, kC = 1.70, kN = 1.55, kO = 1.52, kCa = 2.31, kCl = 1.75, kSe = 1.90, kHg = 1.55, kZn = 1.39;

TEST(Pdb, ReadsTheFormatsExample) {
  const Molecule m = molecule_in("a.pdb", kExample);
  ASSERT_EQ(m.atom_count(), 3U);
  EXPECT_EQ(m.centers[0], Vec3(11.281, 86.699, 94.383));
  EXPECT_EQ(m.centers[2], Vec3(13.872, -2.555, -29.045));
  EXPECT_THAT(m.radii, ElementsAre(kN, kC, 1.73));
  EXPECT_THAT(m.charges, ElementsAre(0, 0, 0));
}

TEST(Pdb, IsReadUnderEveryNameOfIt) {
  for (const char* name : {"a.pdb", "a.ent", "a.PDB"}) EXPECT_EQ(molecule_in(name, kExample).atom_count(), 3U) << name;
  EXPECT_EQ(molecule_in("a.pdb.gz", gzip(kExample)).atom_count(), 3U);
  EXPECT_EQ(molecule_in("a.pdb", "\xef\xbb\xbf" + kExample).atom_count(), 3U) << "a byte order mark is no part of the first line";
}

TEST(Pdb, ReadsNumbersThatFillTheirColumns) {
  const Molecule m = molecule_in("a.pdb", "ATOM      1  CA  GLY A   1    -999.123-999.4569999.789100.00 20.00           C\r\n");
  EXPECT_EQ(m.centers[0], Vec3(-999.123, -999.456, 9999.789));
}

TEST(Pdb, TakesTheElementFromItsColumns) {
  EXPECT_EQ(radius_of_line("HETATM    1 CA    CA A   1       1.000   2.000   3.000  1.00 20.00          CA  "), kCa);
  EXPECT_EQ(radius_of_line("HETATM    1 CA   LIG A   1       1.000   2.000   3.000  1.00 20.00           C1+"), kC);
  EXPECT_EQ(radius_of_line("HETATM    1 CA   LIG A   1       1.000   2.000   3.000  1.00 20.00          cl  "), kCl);
  EXPECT_EQ(radius_of_line("HETATM    1 CA   LIG A   1       1.000   2.000   3.000  1.00 20.00          C"), kC);
}

TEST(Pdb, TellsTheElementByTheAlignmentOfTheName) {
  const std::vector<std::tuple<std::string, std::string, double>> cases = {
      {" CA ", "LIG", kC}, {"CA  ", "LIG", kCa}, {" CL1", "LIG", kC},  {"CL1 ", "LIG", kCl}, {" H1 ", "LIG", kH},
      {"1H  ", "LIG", kH}, {"HG11", "LIG", kH},  {"HG  ", "LIG", kHg}, {"SE  ", "MSE", kSe}, {" O5'", "LIG", kO},
      {"C10A", "LIG", kC}, {" ZN ", " ZN", kZn}, {" CA ", " CA", kCa}, {"CL  ", " CL", kCl}};
  for (const auto& [name, residue, radius] : cases) EXPECT_EQ(radius_of_line(without_element(name, residue)), radius) << name << residue;
}

TEST(Pdb, TellsTheElementsOfStandardResiduesHoweverTheyAreAligned) {
  const std::vector<std::tuple<std::string, std::string, double>> cases = {{"CA  ", "ALA", kC}, {"CD1 ", "ILE", kC}, {"NE  ", "ARG", kN},
                                                                           {"HG  ", "SER", kH}, {"1HB ", "ALA", kH}, {"HO2'", "  G", kH},
                                                                           {" OE1", "GLU", kO}, {"NE2 ", "HIE", kN}};
  for (const auto& [name, residue, radius] : cases) EXPECT_EQ(radius_of_line(without_element(name, residue)), radius) << name << residue;
}

TEST(Pdb, TellsTheElementByTheNameInFilesOfBefore1996) {
  EXPECT_EQ(radius_of_line("ATOM      1  N   LIG A   1       1.000   2.000   3.000  1.00 20.00      1ABC  12"), kN);
}

TEST(Pdb, PassesOverEveryOtherLine) {
  EXPECT_EQ(
      molecule_in("a.pdb", "REMARK ATOM\nANISOU   32  N   ARG A  -3     2406\nTER\nATOMS\n\n" + kExample + "CONECT 1 2\n").atom_count(),
      3U);
}

TEST(Pdb, SaysWhatWasAssumed) {
  MoleculeReadReport report;
  molecule_in(
      "a.pdb",
      without_element(" CA ", "GLY") + "TER\nHETATM    2  O   HOH A   2       1.000   2.000   3.000  1.00 20.00\nENDMDL\n" + kExample, {},
      &report);
  EXPECT_THAT(report.notes, ElementsAre("only the first model is read: 4 atoms of others left out",
                                        "elements of 2 atoms told by their names (columns 77–78 are blank)",
                                        "radii by element (set \"bondi\"), charges 0", "1 atoms of water left out"));
}

TEST(Pdb, EndsTheFirstModelHoweverItIsMarked) {
  const std::string atom = without_element(" CA ", "GLY");
  for (const char* mark : {"ENDMDL\n", "END\n", "END   \n", "MODEL        2\n"})
    EXPECT_EQ(molecule_in("a.pdb", "MODEL        1\n" + atom + mark + atom).atom_count(), 1U) << mark;
  EXPECT_EQ(molecule_in("a.pdb", atom + "TER\nENDO\n" + atom).atom_count(), 2U);
}

TEST(Pdb, RejectsALineThatIsTooShort) {
  const std::string line = without_element(" CA ", "GLY");
  EXPECT_EQ(molecule_rejection("a.pdb", "REMARK\n" + line.substr(0, 53)),
            "a.pdb:2: the atom's line has 53 columns, its coordinates end in column 54");
  EXPECT_EQ(molecule_rejection("a.pdb", "REMARK\n" + line.substr(0, 54)), "");
  EXPECT_EQ(molecule_rejection("a.pdb", "ATOM"), "a.pdb:1: the atom's line has 4 columns, its coordinates end in column 54");
}

TEST(Pdb, RejectsCoordinatesThatAreNoFiniteNumbers) {
  const auto with_y = [](const std::string& y) {
    return molecule_rejection("a.pdb", fmt::format("ATOM      1  CA  GLY A   1       1.000{:>8}   3.000  1.00 20.00           C\n", y));
  };
  EXPECT_EQ(with_y("2.0x0"), "a.pdb:1: coordinate y (columns 39–46) is \"2.0x0\", expected a number");
  EXPECT_EQ(with_y("********"), "a.pdb:1: coordinate y (columns 39–46) is \"********\", expected a number");
  EXPECT_EQ(with_y(""), "a.pdb:1: coordinate y (columns 39–46) is \"\", expected a number");
  EXPECT_EQ(with_y("nan"), "a.pdb:1: coordinate y is nan, expected a finite number");
  EXPECT_EQ(with_y("-inf"), "a.pdb:1: coordinate y is -inf, expected a finite number");
}

// Full columns cut in the wrong place give numbers, but wrong ones.
TEST(Pdb, NeverReadsNumbersAcrossColumns) {
  const std::string line = "ATOM      1  CA  GLY A   1    1068.2271100.5581013.641  1.00 20.00           C\n";
  ASSERT_EQ(molecule_in("a.pdb", line).centers[0], Vec3(1068.227, 1100.558, 1013.641));
  std::string to_the_left = line;
  to_the_left.erase(20, 1);
  EXPECT_EQ(molecule_rejection("a.pdb", to_the_left),
            "a.pdb:1: column 30 holds \"1\", expected a blank: the line is not in the PDB's columns");
  std::string to_the_right = line;
  to_the_right.insert(20, " ");
  EXPECT_EQ(molecule_rejection("a.pdb", to_the_right), "a.pdb:1: occupancy (columns 55–60) is \"1  1.0\", expected a number");
}

TEST(Pdb, RejectsAnElementWithoutARadius) {
  const auto with_element = [](const std::string& element, const MoleculeReadOptions& options = {}) {
    return molecule_rejection("a.pdb", pdb_of({{"C"}, {.element = element, .residue = "LIG"}}), options);
  };
  EXPECT_EQ(with_element("XX"), "a.pdb:4: \"XX\" is not an element");
  EXPECT_EQ(with_element("GD"), "a.pdb:4: the radius set \"bondi\" has no radius for element GD");
  EXPECT_EQ(with_element("FE"), "");
  EXPECT_EQ(with_element("FE", {.radius_set = RadiusSet::amber}), "a.pdb:4: the radius set \"amber\" has no radius for element FE");
  EXPECT_EQ(molecule_rejection("a.pdb", without_element("    ", "LIG")), "a.pdb:1: the element of atom \"\" is missing");
}

TEST(Pdb, RejectsAFileWithoutAtoms) {
  EXPECT_EQ(molecule_rejection("a.pdb", ""), "a.pdb: the file is empty");
  EXPECT_EQ(molecule_rejection("a.pdb", "HEADER\nEND\n"), "a.pdb: the file has no atoms (no line ATOM or HETATM)");
}

TEST(Pdb, ReadsTheFilesOfApbs) {
  for (const char* name : {"actin-dimer/UHBD/prot3.pdb", "ion-protein/UHBD/small491.pdb", "protein-rna/PDB/model_outNB.pdb",
                           "protein-rna/PDB/model_outBoxB19.pdb", "alkanes/2-methylbutane.pdb"}) {
    const std::filesystem::path path = apbs_molecule(name);
    if (path.empty()) GTEST_SKIP() << "apbs-data is not installed";
    std::ifstream in(path);
    std::size_t atoms = 0;
    for (std::string line; std::getline(in, line);) atoms += line.starts_with("ATOM") || line.starts_with("HETATM");
    EXPECT_EQ(read_molecule(path).atom_count(), atoms) << name;
  }
}

// Written by APBS's own authors with the AMBER radii in the column behind the occupancy: an oracle for the elements and the set.
TEST(Pdb, GivesTheAlkanesOfApbsTheRadiiTheyCameWith) {
  const std::filesystem::path path = apbs_molecule("alkanes/propane.pdb");
  if (path.empty()) GTEST_SKIP() << "apbs-data is not installed";
  std::ifstream in(path);
  std::vector<double> expected;
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("ATOM")) expected.push_back(std::stod(line.substr(line.find_last_of(' '))));
  EXPECT_EQ(read_molecule(path, {.radius_set = RadiusSet::amber}).radii, expected);
}

}  // namespace
}  // namespace smopt::testing
