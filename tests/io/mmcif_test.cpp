#include "smopt/io/mmcif.h"

#include <gmock/gmock.h>

#include "smopt/io/gzip.h"
#include "tests/io/structure_files.h"

namespace smopt::testing {
namespace {

using ::testing::ElementsAre;

/// The loop of the atoms with the least columns, and rows `element x y z`.
std::string loop_of(const std::string& rows) {
  return "loop_\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n" + rows;
}

TEST(Mmcif, ReadsTheColumnsInAnyOrder) {
  const Molecule m =
      molecule_in("a.cif",
                  "data_A\nloop_\n_atom_site.Cartn_z\n_atom_site.id\n_ATOM_SITE.TYPE_SYMBOL\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n"
                  "3 1 N 1 2\n6.5 2 Fe -4 .5\n");
  ASSERT_EQ(m.atom_count(), 2U);
  EXPECT_EQ(m.centers[0], Vec3(1, 2, 3));
  EXPECT_EQ(m.centers[1], Vec3(-4, 0.5, 6.5));
  EXPECT_THAT(m.radii, ElementsAre(1.55, 2.05));
  EXPECT_THAT(m.charges, ElementsAre(0, 0));
}

TEST(Mmcif, IsReadUnderEveryNameOfIt) {
  const std::string text = "data_A\n" + loop_of("C 1 2 3\n");
  for (const char* name : {"a.cif", "a.mmcif", "a.CIF"}) EXPECT_EQ(molecule_in(name, text).atom_count(), 1U) << name;
  EXPECT_EQ(molecule_in("a.cif.gz", gzip(text)).atom_count(), 1U);
}

TEST(Mmcif, ReadsASingleAtomWithoutALoop) {
  const Molecule m = molecule_in(
      "a.cif",
      "data_A\n_atom_site.Cartn_x 1\n_cell.length_a 5\n_atom_site.Cartn_y\n2\n_atom_site.Cartn_z 3\n_atom_site.type_symbol 'ZN'\n");
  ASSERT_EQ(m.atom_count(), 1U);
  EXPECT_EQ(m.centers[0], Vec3(1, 2, 3));
  EXPECT_EQ(m.radii[0], 1.39);
}

TEST(Mmcif, ReadsRowsHoweverTheyAreBrokenIntoLines) {
  EXPECT_THAT(xs_of(molecule_in("a.cif", "data_A " + loop_of("C 1\n2 3 C\n\n4 # a comment\r\n5 6 'C'\t\"7\"\n;8\n;\n9"))),
              ElementsAre(1, 4, 7));
}

TEST(Mmcif, KnowsQuotedTextsTextFieldsAndComments) {
  const std::string text =
      "# a comment before\ndata_A\n_a.x 'it's _atom_site.x'\n_a.y \"loop_\"\n_a.z\n;data_B\nloop_\n_atom_site.Cartn_x ' \"\n; _a.w x;y#z\n"
      "loop_\n_b.one\n_b.two\n'a' ;b\n. ?\n" +
      loop_of("C 1 2 3 # C 4 5 6\nC 7 8 9\n");
  EXPECT_THAT(xs_of(molecule_in("a.cif", text)), ElementsAre(1, 7));
}

TEST(Mmcif, ReadsTheFirstDataBlockOnly) {
  EXPECT_THAT(xs_of(molecule_in("a.cif", "data_A\n" + loop_of("C 1 2 3\n") + "DATA_B\n" + loop_of("C 4 5 6\n"))), ElementsAre(1));
}

TEST(Mmcif, LeavesOutStandardUncertainties) {
  EXPECT_EQ(molecule_in("a.cif", "data_A\n" + loop_of("C 1.25(3) 2 3\n")).centers[0], Vec3(1.25, 2, 3));
}

TEST(Mmcif, SaysWhatWasAssumed) {
  MoleculeReadReport report;
  molecule_in("a.cif", cif_of({{"C"}, {.element = "O", .residue = "HOH", .number = 2}, {"C"}, {.model = 2}, {.model = 3}}), {}, &report);
  EXPECT_THAT(report.notes, ElementsAre("only the first model is read: 2 atoms of others left out",
                                        "radii by element (set \"bondi\"), charges 0", "1 atoms of water left out"));
}

TEST(Mmcif, RejectsWhatIsNoCif) {
  EXPECT_EQ(molecule_rejection("a.cif", ""), "a.cif: the file is empty");
  EXPECT_EQ(molecule_rejection("a.cif", "\n# nothing"), "a.cif:2: \"\" where a data block (data_…) was expected");
  EXPECT_EQ(molecule_rejection("a.cif", "HEADER    OF A PDB FILE\n"), "a.cif:1: \"HEADER\" where a data block (data_…) was expected");
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\n_a.b c\nd\n"), "a.cif:3: the value \"d\" has no name");
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\n_a.b\n_a.c d\n"), "a.cif:2: \"_a.b\" has no value");
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\nloop_\n1 2\n"), "a.cif:2: the loop has no columns");
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\n_a.b 'c\n"), "a.cif:2: the quoted text has no end on its line");
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\n_a.b\n;c\nd ;\n"),
            "a.cif:3: the text field has no end (a line that begins with a semicolon)");
}

TEST(Mmcif, RejectsAFileWithoutAtoms) {
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\n_a.b c\n"), "a.cif: the first data block has no atoms (_atom_site.…)");
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\n" + loop_of("")), "a.cif: the first data block has no atoms (_atom_site.…)");
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\nloop_\n_atom_site_label\n_atom_site_fract_x\nC1 0.25\n"),
            "a.cif: a CIF of a small molecule (_atom_site_…), whose coordinates are fractions of a cell; mmCIF is read");
}

TEST(Mmcif, RejectsColumnsThatAreMissingOrTwiceThere) {
  EXPECT_EQ(molecule_rejection("a.cif",
                               "data_A\nloop_\n_atom_site.id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.type_symbol\n1 2 3 C\n"),
            "a.cif:3: the atoms have no column _atom_site.Cartn_z");
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\nloop_\n_atom_site.Cartn_x\n_atom_site.cartn_x\n1 2\n"),
            "a.cif:4: \"_atom_site.cartn_x\" is there twice");
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\n_atom_site.Cartn_x 1\n_atom_site.Cartn_y 1\n_atom_site.Cartn_z 1\n"),
            "a.cif:2: the atoms have no column _atom_site.type_symbol");
}

TEST(Mmcif, RejectsARowThatEndsEarly) {
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\n" + loop_of("C 1 2 3\nC 4 5\n#\n")),
            "a.cif:8: the last row of the atoms has 3 values, expected 4");
}

TEST(Mmcif, RejectsCoordinatesThatAreNoFiniteNumbers) {
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\n" + loop_of("C 1 2 3\nC 4 5x 6\n")), "a.cif:8: Cartn_y is \"5x\", expected a number");
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\n" + loop_of("C 1 2 ?\n")), "a.cif:7: Cartn_z is \"?\", expected a number");
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\n" + loop_of("C\n\nnan 2 3\n")), "a.cif:9: Cartn_x is nan, expected a finite number");
}

TEST(Mmcif, CountsTheLinesOfTextFields) {
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\n_a.b\n;one\ntwo\n\n;\n# seven\n" + loop_of("C 1 2 x\n")),
            "a.cif:13: Cartn_z is \"x\", expected a number");
}

TEST(Mmcif, RejectsAnElementWithoutARadius) {
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\n" + loop_of("C 1 2 3\nXx 1 2 3\n")), "a.cif:8: \"Xx\" is not an element");
  EXPECT_EQ(molecule_rejection("a.cif", "data_A\n" + loop_of("? 1 2 3\n")), "a.cif:7: the element of atom \"\" is missing");
}

}  // namespace
}  // namespace smopt::testing
