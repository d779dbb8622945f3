#include <gmock/gmock.h>

#include "experiments/convergence/change_tables.h"
#include "experiments/convergence/convergence_tables.h"
#include "experiments/convergence/edge_ratio_bars.h"
#include "experiments/convergence/molecule_study.h"
#include "experiments/convergence/published.h"
#include "experiments/convergence/published_table.h"
#include "experiments/convergence/richardson.h"
#include "experiments/convergence/study_json.h"
#include "experiments/convergence/study_markdown.h"
#include "smopt/error.h"
#include "tests/support/files.h"

namespace smopt::experiments {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

TEST(PublishedFigures, AreThoseOfTheIssue) {
  const PublishedFigures& figures = published_figures();
  ASSERT_THAT(figures.meshes, SizeIs(3));
  EXPECT_THAT(figures.source, HasSubstr("not an oracle"));
  const PublishedMesh& ache = figures.meshes[0];
  EXPECT_EQ(ache.vertices, 56761);
  EXPECT_EQ(ache.euler_characteristic, 118);
  EXPECT_EQ(ache.euler_characteristic_main, -36);
  EXPECT_EQ(ache.area, 24515);
  EXPECT_EQ(ache.volume, 85365);
  EXPECT_EQ(figures.meshes[2].area, std::nullopt);
}

TEST(PublishedFigures, ThatAreIncompleteAreRefusedByTheirNumber) {
  EXPECT_THAT([] { parse_published(R"({"program": "p", "source": "s", "meshes": [{"molecule": "m"}]})"); },
              ThrowsMessage<InvalidInput>(HasSubstr("mesh 0")));
  EXPECT_THAT([] { parse_published("{"); }, ThrowsMessage<InvalidInput>(HasSubstr("published figures")));
}

TEST(RichardsonLimit, OfAQuadraticIsItsConstant) {
  const auto quantity = [](double h) { return 5 + 0.3 * h * h; };
  const Limit limit = richardson_limit(quantity(0.8), quantity(0.4), quantity(0.2));
  EXPECT_NEAR(limit.value, 5, 1e-12);
  EXPECT_NEAR(limit.residual, 0, 1e-12);
  EXPECT_NEAR(limit.order, 2, 1e-9);
}

TEST(RichardsonLimit, TellsBiasOfFourthOrderByItsResidual) {
  const auto quantity = [](double h) { return 5 + 0.3 * h * h + 0.1 * h * h * h * h; };
  const Limit limit = richardson_limit(quantity(0.8), quantity(0.4), quantity(0.2));
  EXPECT_LT(std::abs(limit.value - 5), limit.residual);
}

/// Seven atoms around a hole, of which two nearly touch.
constexpr const char* kRing = R"(ATOM 1 C X 1  3.50  0.00 0.00 0 1.7
ATOM 2 C X 1  2.18  2.74 0.00 0 1.7
ATOM 3 C X 1 -0.78  3.41 0.00 0 1.7
ATOM 4 C X 1 -3.15  1.52 0.00 0 1.7
ATOM 5 C X 1 -3.15 -1.52 0.00 0 1.7
ATOM 6 H X 1 -0.78 -3.41 0.00 0 0.2
ATOM 7 C X 1  2.18 -2.74 0.00 0 1.7
)";

class StudyOfARing : public ::testing::Test {
 protected:
  StudyOfARing() {
    Dataset dataset;
    dataset.name = "ring";
    dataset.title = "Ring";
    dataset.path = folder_.file("ring.pqr", kRing);
    StudyOptions options;
    options.errors = {1, 0.5, 0.25};
    study_ = study_molecule(dataset, options, [this](const std::string& what) { log_.push_back(what); });
  }

  testing::TemporaryFolder folder_;
  std::vector<std::string> log_;
  MoleculeStudy study_;
};

TEST_F(StudyOfARing, HasARowForEveryErrorAndSpacingAndTellsOfEach) {
  EXPECT_THAT(study_.adaptive, SizeIs(3));
  EXPECT_THAT(study_.steps, SizeIs(2));
  EXPECT_THAT(study_.uniform, SizeIs(3));
  EXPECT_THAT(log_, SizeIs(6));
  EXPECT_EQ(study_.raised_radii, 1U);
}

TEST_F(StudyOfARing, KeepsTheErrorAndComesNearTheLimit) {
  for (const AdaptiveRow& row : study_.adaptive) EXPECT_LE(row.nearness.distance.largest, row.error);
  EXPECT_NEAR(study_.adaptive.back().surface.all.volume / study_.volume.value, 1, 0.02);
  EXPECT_NEAR(study_.uniform.back().surface.all.area / study_.area.value, 1, 0.01);
}

TEST_F(StudyOfARing, CountsChangesThatSumUp) {
  for (std::size_t i = 0; i < study_.steps.size(); ++i) {
    std::int64_t sum = 0;
    for (const ExplainedChange& change : study_.steps[i].changes) sum += change.place.change;
    EXPECT_EQ(sum, study_.adaptive[i + 1].surface.all.euler_characteristic - study_.adaptive[i].surface.all.euler_characteristic);
  }
}

TEST_F(StudyOfARing, FillsEveryColumnOfItsTables) {
  const std::span studies(&study_, 1);
  for (const Table& table : {convergence_table(study_), limit_table(studies), change_table(studies), event_table(studies),
                             hardest_changes_table(studies, 10), published_table(studies)}) {
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.name;
  }
}

TEST_F(StudyOfARing, FillsThePageAndTheJson) {
  const std::string page = study_markdown(std::span(&study_, 1), "the-command");
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  EXPECT_THAT(page, HasSubstr("the-command"));
  EXPECT_THAT(page, HasSubstr("Ring: 7 atoms"));
  const auto json = study_json(std::span(&study_, 1));
  EXPECT_EQ(json["molecules"][0]["adaptive"].size(), 3U);
  EXPECT_EQ(json["molecules"][0]["changes"].size(), 2U);
}

TEST(EdgeRatioBars, ShowSharesThatSumUpToAll) {
  metrics::Histogram histogram(0, 1, 50);
  for (int i = 0; i < 100; ++i) histogram.add(0.005 + 0.01 * i);
  const std::string bars = edge_ratio_bars(histogram);
  EXPECT_THAT(bars, HasSubstr("0.0–0.1  10.0 %"));
  EXPECT_EQ(std::count(bars.begin(), bars.end(), '\n'), 10);
}

}  // namespace
}  // namespace smopt::experiments
