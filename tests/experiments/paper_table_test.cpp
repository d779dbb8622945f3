#include "experiments/paper_table.h"

#include <gmock/gmock.h>

#include "smopt/error.h"

namespace smopt::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::Optional;
using ::testing::Throws;
using ::testing::ThrowsMessage;

TEST(PaperTable, HoldsWhatThePaperPrints) {
  EXPECT_THAT(paper_table(1).value("AChE monomer", "vertices_improved"), Optional<std::string>("63361"));
  EXPECT_THAT(paper_table(1).value("3K1Q", "tetgen_initial"), Optional<std::string>("Failed"));
  EXPECT_THAT(paper_table(2).value("70S ribosome", "cpu_s_manifold_and_cavities"), Optional<std::string>("447.80"));
  EXPECT_THAT(paper_table(3).value("AChE tetramer", "intersecting_pairs_iso2mesh"), Optional<std::string>("256"));
}

TEST(PaperTable, HasNothingForAMoleculeThatThePaperDoesNotHave) {
  EXPECT_FALSE(paper_table(1).value(std::nullopt, "atoms"));
  EXPECT_FALSE(paper_table(1).value("fas2", "atoms"));
}

TEST(PaperTable, AnUnknownColumnIsAnError) {
  EXPECT_THAT([] { (void)paper_table(1).value("AChE monomer", "atmos"); }, Throws<InvalidOption>());
}

TEST(PaperTable, ARowOfAnotherLengthIsRefusedByItsLine) {
  EXPECT_THAT([] { PaperTable("molecule,atoms\nA,1\nB\n"); }, ThrowsMessage<InvalidInput>(HasSubstr("line 3")));
}

}  // namespace
}  // namespace smopt::experiments
