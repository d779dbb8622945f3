#include "smopt/io/xyzr.h"

#include <gmock/gmock.h>

#include "smopt/io/gzip.h"
#include "tests/io/structure_files.h"

namespace smopt::testing {
namespace {

using ::testing::ElementsAre;

TEST(Xyzr, ReadsASphereALine) {
  const Molecule m = molecule_in("a.xyzr", "1 2 3 1.5\n  -4.5\t5 6e-1 0\r\n");
  ASSERT_EQ(m.atom_count(), 2U);
  EXPECT_EQ(m.centers[0], Vec3(1, 2, 3));
  EXPECT_EQ(m.centers[1], Vec3(-4.5, 5, 0.6));
  EXPECT_THAT(m.radii, ElementsAre(1.5, 0));
  EXPECT_THAT(m.charges, ElementsAre(0, 0));
}

TEST(Xyzr, PassesOverCommentsEmptyLinesAndLabels) {
  EXPECT_THAT(xs_of(molecule_in("a.xyzr", "# spheres\n\n1 2 3 1.5 1 CA_GLY_4\n4 5 6 1 # the last\n")), ElementsAre(1, 4));
}

TEST(Xyzr, IsReadPacked) {
  EXPECT_EQ(molecule_in("a.xyzr.gz", gzip("1 2 3 1.5\n")).atom_count(), 1U);
}

TEST(Xyzr, SaysThatThereAreNoCharges) {
  MoleculeReadReport report;
  molecule_in("a.xyzr", "1 2 3 1.5\n", {}, &report);
  EXPECT_THAT(report.notes, ElementsAre("charges 0"));
}

TEST(Xyzr, RejectsWhatIsNoSphere) {
  EXPECT_EQ(molecule_rejection("a.xyzr", "1 2 3 1\n1 2 3\n"), "a.xyzr:2: radius is missing");
  EXPECT_EQ(molecule_rejection("a.xyzr", "ATOM 1 N\n"), "a.xyzr:1: coordinate x is \"ATOM\", expected a number");
  EXPECT_EQ(molecule_rejection("a.xyzr", "1 2 3 -1\n"), "a.xyzr:1: radius is -1, expected one that is not negative");
  EXPECT_EQ(molecule_rejection("a.xyzr", "1 2 3 nan\n"), "a.xyzr:1: radius is nan, expected a finite number");
  EXPECT_EQ(molecule_rejection("a.xyzr", "1 inf 3 1\n"), "a.xyzr:1: coordinate y is inf, expected a finite number");
}

TEST(Xyzr, RejectsAFileWithoutAtoms) {
  EXPECT_EQ(molecule_rejection("a.xyzr", ""), "a.xyzr: the file is empty");
  EXPECT_EQ(molecule_rejection("a.xyzr", "# nothing\n"), "a.xyzr: the file has no atoms (no line x y z r)");
}

}  // namespace
}  // namespace smopt::testing
