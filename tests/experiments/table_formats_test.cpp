#include <gmock/gmock.h>

#include "experiments/tables/csv.h"
#include "experiments/tables/latex.h"
#include "experiments/tables/markdown.h"
#include "experiments/tables/table.h"

namespace smopt::experiments {
namespace {

using ::testing::HasSubstr;

Table made_table() {
  return {"tableX",
          "A caption",
          {{"molecule", "Molecule"}, {"count", "Count"}, {"note", "Note"}},
          {{"A & B", 12345L, "x|y, \"z\""}, {"C_1", Decimal{0.125, 2}, Cell()}},
          {"100 % done."}};
}

TEST(TableFormats, MarkdownAlignsItsColumnsAndEscapesBars) {
  EXPECT_EQ(to_markdown(made_table()),
            "**A caption**\n"
            "\n"
            "| Molecule | Count | Note      |\n"
            "| -------- | ----: | --------- |\n"
            "| A & B    | 12345 | x\\|y, \"z\" |\n"
            "| C_1      |  0.12 | —         |\n"
            "\n"
            "100 % done.\n");
}

TEST(TableFormats, CsvQuotesAndLeavesMissingValuesEmpty) {
  EXPECT_EQ(to_csv(made_table()),
            "molecule,count,note\n"
            "A & B,12345,\"x|y, \"\"z\"\"\"\n"
            "C_1,0.12,\n");
}

TEST(TableFormats, LatexEscapesItsSpecialCharacters) {
  const std::string text = to_latex(made_table());
  EXPECT_THAT(text, HasSubstr("A \\& B & 12345 & x|y, \"z\" \\\\\n"));
  EXPECT_THAT(text, HasSubstr("C\\_1 & 0.12 & --- \\\\\n"));
  EXPECT_THAT(text, HasSubstr("100 \\% done."));
  EXPECT_THAT(text, HasSubstr("\\begin{tabular}{lrl}"));
  EXPECT_THAT(text, HasSubstr("\\end{table}\n"));
}

TEST(TableFormats, ALineBreakInAReasonDoesNotBreakTheRow) {
  Table table = made_table();
  table.rows[0][2] = "two\nlines";
  EXPECT_THAT(to_markdown(table), HasSubstr("| two lines"));
  EXPECT_THAT(to_latex(table), HasSubstr("two lines"));
  EXPECT_THAT(to_csv(table), HasSubstr("\"two\nlines\""));
}

}  // namespace
}  // namespace smopt::experiments
