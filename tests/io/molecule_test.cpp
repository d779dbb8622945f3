#include "smopt/io/molecule.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <numeric>

#include "smopt/io/gzip.h"
#include "tests/io/rejection.h"
#include "tests/support/files.h"

namespace smopt::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Molecule molecule_in(std::string_view content) {
  const TemporaryFolder folder;
  return read_molecule(folder.file("a.pqr", content));
}

std::string pqr_rejection(std::string_view content) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.file("a.pqr", content);
  return rejection(folder.path(), [&] { read_molecule(path); });
}

/// The only atom of a line, as x, y, z, charge, radius.
std::vector<double> atom_of(std::string_view line) {
  const Molecule m = molecule_in(line);
  EXPECT_EQ(m.atom_count(), 1U) << line;
  return {m.centers[0].x(), m.centers[0].y(), m.centers[0].z(), m.charges[0], m.radii[0]};
}

TEST(Molecule, ReadsTheFieldsOfAnAtom) {
  const auto numbers = ElementsAre(-36.576, -12.088, -13.641, 0.185, 1.824);
  EXPECT_THAT(atom_of("ATOM      1  N   NTER    4     -36.576 -12.088 -13.641  0.185 1.824\n"), numbers);
  EXPECT_THAT(atom_of("ATOM      1  N   NTER A  4     -36.576 -12.088 -13.641  0.185 1.824"), numbers);
  EXPECT_THAT(atom_of("HETATM    1  N   NTER    4     -36.576 -12.088 -13.641  0.185 1.824\r\n"), numbers);
  EXPECT_THAT(atom_of("HETATM99999  N   NTE A4321     -36.576 -12.088 -13.641  0.185 1.824\n"), numbers);
  EXPECT_THAT(atom_of("ATOM 1 N NTER 4 -36.576 -12.088 -13.641 0.185 1.824\n"), numbers);
  EXPECT_THAT(atom_of("  ATOM\t1\tN\tNTER\tA\t4A\t-36.576\t-12.088\t-13.641\t0.185\t1.824\n"), numbers);
}

TEST(Molecule, ReadsColumnsThatRunTogether) {
  EXPECT_THAT(atom_of("ATOM      1  N   NTER    4      68.227-100.558 -13.641  0.185 1.824\n"),
              ElementsAre(68.227, -100.558, -13.641, 0.185, 1.824));
  EXPECT_THAT(atom_of("ATOM      1  N   NTER    4    -136.576-112.088-113.641 -0.185 1.824\n"),
              ElementsAre(-136.576, -112.088, -113.641, -0.185, 1.824));
  EXPECT_THAT(atom_of("ATOM      1  N   NTE A   4    1068.2271100.5581013.641  0.185 1.824\n"),
              ElementsAre(1068.227, 1100.558, 1013.641, 0.185, 1.824));
  EXPECT_THAT(atom_of("ATOM      1  N   NTE A   4      68.227  10.558  13.641-0.185 1.824\n"),
              ElementsAre(68.227, 10.558, 13.641, -0.185, 1.824));
}

TEST(Molecule, ReadsNumbersThatRunTogetherOutsideTheColumns) {
  EXPECT_THAT(atom_of("ATOM 1 N NTER 4 68.227-100.558 35.885 0.185 1.824\n"), ElementsAre(68.227, -100.558, 35.885, 0.185, 1.824));
  EXPECT_THAT(atom_of("ATOM 1 N NTER A 4 -12.088-13.641-1e-3-0.185 1.824\n"), ElementsAre(-12.088, -13.641, -1e-3, -0.185, 1.824));
}

// The three ways to read a line agree on a molecule written in columns, whatever runs together in it.
TEST(Molecule, ReadsTheSameFromColumnsOfAnyMagnitude) {
  for (const double scale : {1.0, 10.0, 100.0, -1.0, -10.0, -100.0}) {
    const double x = 1.234 * scale;
    const double y = -1.345 * scale;
    const double z = -0.056 * scale;
    const std::string line =
        fmt::format("ATOM  {:5d}  CA  GLY A{:4d}    {:8.3f}{:8.3f}{:8.3f}{:8.4f}{:7.4f}\n", 10000, 1234, x, y, z, -0.1234, 1.7);
    const Molecule m = molecule_in(line);
    EXPECT_TRUE(m.centers.at(0).isApprox(Vec3(x, y, z), 1e-9)) << line;
    EXPECT_EQ(m.charges.at(0), -0.1234) << line;
    EXPECT_EQ(m.radii.at(0), 1.7) << line;
  }
}

TEST(Molecule, PassesOverEveryOtherLine) {
  const Molecule m = molecule_in(
      "REMARK   1 ATOM is a word here\n\nATOM 1 N A 1 1 2 3 0.5 1.5\nTER\nANISOU 1 N\nATOMS 3\nHETATM 2 ZN B 2 4 5 6 2 0\nCONECT 1 "
      "2\nEND\n");
  ASSERT_EQ(m.atom_count(), 2U);
  EXPECT_EQ(m.centers[1], Vec3(4, 5, 6));
  EXPECT_THAT(m.charges, ElementsAre(0.5, 2));
  EXPECT_THAT(m.radii, ElementsAre(1.5, 0)) << "a radius of zero is one";
}

TEST(Molecule, ReadsAPackedFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_molecule(folder.file("a.pqr.gz", gzip("ATOM 1 N A 1 1 2 3 0.5 1.5\n"))).atom_count(), 1U);
}

TEST(Molecule, RejectsAMissingFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(rejection(folder.path(), [&] { read_molecule(folder.path() / "a.pqr"); }), "a.pqr: No such file or directory");
}

TEST(Molecule, RejectsAnotherFormat) {
  const TemporaryFolder folder;
  EXPECT_EQ(rejection(folder.path(), [&] { read_molecule(folder.path() / "a.off"); }),
            "a.off: not a molecule format by its name; known are pqr, pdb, ent, cif, mmcif, xyzr (each also .gz)");
}

TEST(Molecule, RejectsAFileWithoutAtoms) {
  EXPECT_EQ(pqr_rejection(""), "a.pqr: the file is empty");
  EXPECT_EQ(pqr_rejection("REMARK nothing\nEND\n"), "a.pqr: the file has no atoms (no line ATOM or HETATM)");
}

TEST(Molecule, RejectsARadiusBelowZero) {
  EXPECT_EQ(pqr_rejection("REMARK\nATOM 1 N A 1 1 2 3 0.5 -1.5\n"), "a.pqr:2: radius is -1.5, expected one that is not negative");
}

TEST(Molecule, RejectsNumbersThatAreNotFinite) {
  EXPECT_EQ(pqr_rejection("ATOM 1 N A 1 1 2 3 0.5 nan\n"), "a.pqr:1: radius is nan, expected a finite number");
  EXPECT_EQ(pqr_rejection("ATOM 1 N A 1 1 -inf 3 0.5 1\n"), "a.pqr:1: coordinate y is -inf, expected a finite number");
}

TEST(Molecule, RejectsWhatIsNoNumber) {
  EXPECT_EQ(pqr_rejection("ATOM 1 N A 1 1 2 3 0.5 1.5\nATOM 2 N A 1 1 2 three 0.5 1.5\n"),
            "a.pqr:2: coordinate z is \"three\", expected a number");
  EXPECT_EQ(pqr_rejection("ATOM      1  N   NTER    4     -36.576 -12.0x8 -13.641  0.185 1.824\n"),
            "a.pqr:1: coordinate y is \"-12.0x8\", expected a number");
}

TEST(Molecule, NeverTakesAnotherFieldForAMissingOne) {
  const std::string message = "a.pqr:1: the atom's line does not end in x, y, z, charge and radius";
  EXPECT_EQ(pqr_rejection("ATOM      1  N   NTER    4     -36.576 -12.088 -13.641  0.185\n"), message);
  EXPECT_EQ(pqr_rejection("ATOM      1  N   NTE A   4     -36.576 -12.088 -13.641  0.185\n"), message);
  EXPECT_EQ(pqr_rejection("ATOM      1  N   NTER    4     -36.576 -12.088\n"), message);
  EXPECT_EQ(pqr_rejection("ATOM 1 N5-A LIG 4 1.0 2.0 3.0 0.1\n"), message);
  EXPECT_EQ(pqr_rejection("ATOM 1 N NTER 4 68.227-100.558 35.885 0.185\n"), message);
  EXPECT_EQ(pqr_rejection("ATOM\n"), message);
  // A PDB file under another name: occupancy and temperature factor are followed by the element.
  EXPECT_NE(pqr_rejection("ATOM      1  N   GLY A   4     -36.576 -12.088 -13.641  1.00 20.00           N  \n"), "");
}

TEST(Molecule, RejectsFilesThatAreNoText) {
  const auto refused = [](const std::string& name, const std::string& content) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.file(name, content);
    return rejection(folder.path(), [&] { read_molecule(path); });
  };
  for (const std::string ending : {"pqr", "pdb", "cif", "xyzr"}) {
    const std::string name = "a." + ending;
    EXPECT_EQ(refused(name, std::string("\x89PNG\r\n\x1a\n\0\0\0", 11)), name + ": not a molecule: the file is a PNG image");
    EXPECT_EQ(refused(name, "<!DOCTYPE html>\n<html>ATOM</html>\n"), name + ": not a molecule: the file is HTML or XML");
    EXPECT_EQ(refused(name, "OFF\n3 1 0\n"), name + ": not a molecule: the file is an OFF mesh");
    EXPECT_EQ(refused(name, std::string("\x7f"
                                        "ELF\0\0",
                                        6)),
              name + ": not a molecule: the file is binary");
  }
  EXPECT_EQ(refused("a.pdb", "data_1ABC\n"), "a.pdb: the file is mmCIF, not pdb; name it .cif");
}

TEST(Molecule, WarnsOfRadiiThatNoAtomHas) {
  const auto notes_of = [](std::string_view line) {
    const TemporaryFolder folder;
    MoleculeReadReport report;
    read_molecule(folder.file("a.pqr", line), {}, &report);
    return report.notes;
  };
  // A PDB file without elements under the name of a PQR: occupancy and temperature factor are where charge and radius should be.
  EXPECT_THAT(notes_of("ATOM      1  N   GLY A   4     -36.576 -12.088 -13.641  1.00 20.00\n"),
              ElementsAre("the largest radius is 20 Å, more than any atom's: is this a PDB file with temperature factors?"));
  EXPECT_THAT(notes_of("ATOM      1  N   GLY A   4     -36.576 -12.088 -13.641  1.00 3.48\n"), IsEmpty());
}

/// Number of atom lines and sum of charges of a well-behaved file, by nothing but streams.
std::pair<std::size_t, double> counted_by_streams(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::size_t atoms = 0;
  double charge = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream fields(line);
    const std::vector<std::string> words(std::istream_iterator<std::string>(fields), {});
    if (words.empty() || (words[0] != "ATOM" && words[0] != "HETATM")) continue;
    ++atoms;
    charge += std::stod(words[words.size() - 2]);
  }
  return {atoms, charge};
}

TEST(Molecule, ReadsTheMoleculesOfApbs) {
  for (const char* name : {"misc/mache.pqr", "misc/achbp.pqr", "misc/fas2.pqr", "actin-dimer/complex.pqr", "bem/test_proteins/1a63.pqr"}) {
    const std::filesystem::path path = apbs_molecule(name);
    if (path.empty()) GTEST_SKIP() << "apbs-data is not installed";
    const auto [atoms, charge] = counted_by_streams(path);
    const Molecule m = read_molecule(path);
    EXPECT_EQ(m.atom_count(), atoms) << name;
    EXPECT_NEAR(std::accumulate(m.charges.begin(), m.charges.end(), 0.0), charge, 1e-9) << name;
  }
  EXPECT_EQ(read_molecule(apbs_molecule("misc/mache.pqr")).atom_count(), 8279U) << "the paper's AChE monomer";
}

}  // namespace
}  // namespace smopt::testing
