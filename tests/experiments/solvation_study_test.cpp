#include <gmock/gmock.h>

#include <cmath>

#include "experiments/solvation_study/findings.h"
#include "experiments/solvation_study/icosphere.h"
#include "experiments/solvation_study/study_json.h"
#include "experiments/solvation_study/study_markdown.h"
#include "metrics/extent.h"
#include "metrics/topology.h"
#include "tests/experiments/made_records.h"
#include "tests/support/files.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt::experiments {
namespace {

using metrics::SolvationStatus;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const StudyLog kSilent = [](const std::string&) {};

TEST(ObservedLimit, FindsLimitAndOrderOfAPower) {
  for (const double order : {0.5, 1.0, 2.0, 3.3}) {
    const auto value = [&](double h) { return -500 + 7 * std::pow(h, order); };
    const double ratio = 1.5, h = 0.4;
    const auto limit = observed_limit(value(h * ratio * ratio), value(h * ratio), value(h), ratio);
    ASSERT_TRUE(limit) << order;
    EXPECT_NEAR(limit->order, order, 1e-9);
    EXPECT_NEAR(limit->value, -500, 1e-8);
    EXPECT_NEAR(limit->distance, 7 * std::pow(h, order) / 500, 1e-9);
  }
}

TEST(ObservedLimit, IsNothingWhereTheValuesDoNotConverge) {
  EXPECT_FALSE(observed_limit(1, 2, 3.5, 2)) << "differences grow";
  EXPECT_FALSE(observed_limit(1, 2, 3, 2)) << "differences stay";
  EXPECT_FALSE(observed_limit(1, 2, 1.5, 2)) << "to and fro";
  EXPECT_FALSE(observed_limit(1, 2, 2, 2)) << "no order can be seen";
  EXPECT_FALSE(observed_limit(1, 1, 1, 2));
  EXPECT_FALSE(observed_limit(NAN, 1, 2, 2));
}

TEST(Icosphere, IsAClosedSphereWithOutwardTriangles) {
  for (const int divisions : {0, 1, 3}) {
    const TriangleMesh sphere = icosphere(divisions, 2.5);
    EXPECT_EQ(sphere.vertex_count(), 10 * std::pow(4, divisions) + 2);
    EXPECT_THAT(sphere, testing::IsClosedManifold());
    for (const Vec3& point : sphere.points) EXPECT_NEAR(point.norm(), 2.5, 1e-14);
    std::vector<std::string> notes;
    const auto extent = metrics::measure_extent(sphere, metrics::measure_topology(sphere, notes), notes);
    EXPECT_LT(*extent.volume, 4.0 / 3 * M_PI * std::pow(2.5, 3));
    EXPECT_GT(*extent.volume, 0.5 * 4.0 / 3 * M_PI * std::pow(2.5, 3));
  }
}

/// In salt that screens within the sphere, so that the error is the mesh's.
TEST(BornStudy, FindsTheIonsEnergyAndTheOrderOfItsError) {
  BornIon ion;
  ion.medium.outer = 4;
  ion.medium.ionic_strength = 1000;
  const BornSeries series = study_born(ion, {2, 3}, kSilent);
  ASSERT_EQ(series.rows.size(), 2U);
  ASSERT_TRUE(series.rows[0].error && series.rows[1].error && series.rows[1].order);
  EXPECT_FALSE(series.rows[0].order);
  EXPECT_LT(*series.rows[1].error, 0.05);
  EXPECT_GT(*series.rows[1].order, 0.9);
  EXPECT_NEAR(series.rows[0].edge / series.rows[1].edge, 2, 0.05);
}

/// Without salt the solution is a constant potential, on which no mesh errs.
TEST(BornStudy, SeesNoOrderInErrorsThatAreNotTheMeshs) {
  BornIon ion;
  ion.medium.ionic_strength = 0;
  const BornSeries series = study_born(ion, {2, 3}, kSilent);
  ASSERT_TRUE(series.rows[0].error && series.rows[1].error);
  EXPECT_LT(*series.rows[1].error, kErrorOfSums);
  EXPECT_FALSE(series.rows[1].order);
}

/// Two charges close together.
Dataset two_atoms(const testing::TemporaryFolder& folder) {
  Dataset dataset = testing::made_dataset("two");
  dataset.path = folder.file("two.pqr", "ATOM 1 N ALA 1 0 0 0 -0.5 1.8\nATOM 2 C ALA 1 1.5 0 0 0.7 1.9\n");
  return dataset;
}

TEST(Refinement, SolvesEveryVariantAtEverySpacing) {
  const testing::TemporaryFolder folder;
  SolvationStudyOptions options;
  options.coarsest_spacing = 0.6;
  options.refinement = 1.3;
  const Refinement refinement = study_refinement(two_atoms(folder), options, kSilent);
  EXPECT_THAT(refinement.spacings, ElementsAre(0.6, ::testing::DoubleNear(0.6 / 1.3, 1e-12), ::testing::DoubleNear(0.6 / 1.69, 1e-12)));
  ASSERT_EQ(refinement.series.size(), 5U);
  for (const RefinementSeries& series : refinement.series) {
    for (std::size_t level = 0; level < 3; ++level) {
      const Solve& solve = series.solves.at(level);
      ASSERT_TRUE(solve.is_success()) << to_string(series.variant) << ": " << describe(solve);
      EXPECT_TRUE(solve.result->potential.empty());
    }
    EXPECT_GT(series.solves[1].vertices, series.solves[0].vertices) << to_string(series.variant);
    EXPECT_GT(series.solves[2].vertices, series.solves[1].vertices) << to_string(series.variant);
  }
  const auto volume = [&](std::size_t series) { return refinement.series[series].solves[0].result->volume; };
  EXPECT_LT(volume(2), volume(0)) << "the improvement shrinks";
  EXPECT_NEAR(volume(3), volume(0), 1e-6 * volume(0)) << "volume-preserving";
  EXPECT_NE(volume(1), volume(0)) << "on the level set, not between the grid's nodes";
  EXPECT_GT(volume(4), volume(2)) << "the shrinking is undone";
}

TEST(Comparison, SolvesOnInitialAndImprovedMeshes) {
  const testing::TemporaryFolder folder;
  const MoleculeComparison comparison = compare_meshes(two_atoms(folder), {}, kSilent);
  EXPECT_EQ(comparison.atoms, 2U);
  EXPECT_TRUE(comparison.apbs.empty());
  for (const SurfaceVariant variant : {SurfaceVariant::generated, SurfaceVariant::initial, SurfaceVariant::smopt}) {
    ASSERT_NE(comparison.find(variant), nullptr);
    EXPECT_TRUE(comparison.find(variant)->is_success()) << to_string(variant);
  }
  EXPECT_EQ(comparison.find(SurfaceVariant::projected), nullptr);
}

TEST(Comparison, AMeshThatCannotBeSolvedOnIsAFailureWithItsReason) {
  TriangleMesh open = testing::icosphere(1);
  open.triangles.pop_back();
  const Solve failed = solve(open, {{Vec3::Zero()}, {1}, {1}});
  EXPECT_FALSE(failed.is_success());
  EXPECT_THAT(describe(failed), AllOf(StartsWith("failed: "), HasSubstr("open")));
}

Solve solved(double polar, SolvationStatus status = SolvationStatus::success) {
  Solve solve;
  solve.vertices = 10242;
  solve.result.emplace();
  solve.result->polar = polar;
  solve.result->status = status;
  if (status != SolvationStatus::success) solve.result->reason = "the reason";
  solve.result->iterations = 11;
  solve.result->seconds = 4;
  return solve;
}

/// What the solver should do.
SolvationStudy made_study() {
  SolvationStudy study;
  study.born.push_back({{}, {{0.2, solved(-80), 0.001, std::nullopt}, {0.1, solved(-81), 0.0004, 1.3}}});
  Refinement refinement{testing::made_dataset("fas2"), {1, 0.7, 0.5}, {}};
  refinement.series.push_back({SurfaceVariant::smopt, {solved(-520), solved(-510), solved(-505)}, observed_limit(-520, -510, -505, 1.41)});
  study.refinements.push_back(refinement);
  MoleculeComparison comparison{
      testing::ache_monomer(),
      8000,
      {{SurfaceVariant::generated, solved(-2600)}, {SurfaceVariant::initial, solved(-2600)}, {SurfaceVariant::smopt, solved(-2500)}},
      {}};
  ApbsRow row{ApbsSurface::molecular, 0.6, ApbsResult{}, {}};
  row.result->polar = -2200;
  row.result->grid.nodes = {33, 33, 33};
  comparison.apbs = {row, row};
  comparison.apbs.back().spacing = 0.3;
  comparison.apbs.back().result->polar = -2100;
  study.comparisons.push_back(comparison);
  return study;
}

TEST(Findings, SayWhatHolds) {
  const std::vector<std::string> sentences = findings(made_study());
  EXPECT_THAT(sentences,
              Contains(AllOf(StartsWith("Holds: Born's ion"), HasSubstr("order 1.30 or better"), HasSubstr("0.1000 % at 10242"))));
  EXPECT_THAT(sentences,
              Contains(AllOf(StartsWith("Holds: The fas2, smopt: at 0.500 Å"), HasSubstr("1.00 % from its extrapolation, -500.0"))));
  EXPECT_THAT(sentences,
              Contains(AllOf(StartsWith("AChE monomer: the solver converges on the initial mesh too"), HasSubstr("11 iterations"))));
  EXPECT_THAT(sentences, Contains(StartsWith("Holds: AChE monomer, improved, 10242 vertices: 4.0 s")));
  EXPECT_THAT(sentences, Contains(AllOf(HasSubstr("APBS with the molecular surface: -2000.0 kcal/mol"),
                                        HasSubstr("-2600.0 kcal/mol, the same sign, 1.300 times"))));
}

TEST(Findings, SayWhatDoesNot) {
  SolvationStudy study = made_study();
  study.born[0].rows[1].order = 0.9;
  study.refinements[0].series[0].limit->distance = 0.03;
  study.comparisons[0].meshes[0].solve = solved(NAN, SolvationStatus::nonfinite);
  study.comparisons[0].meshes[2].solve.result->seconds = 91;
  study.comparisons[0].apbs[0].result.reset();
  const std::vector<std::string> sentences = findings(study);
  EXPECT_THAT(sentences, Contains(StartsWith("Does not hold: Born's ion")));
  EXPECT_THAT(sentences, Contains(StartsWith("Does not hold: The fas2, smopt")));
  EXPECT_THAT(sentences, Contains(HasSubstr("converges on the improved mesh, not on the initial one, as in the paper")));
  EXPECT_THAT(sentences, Contains(StartsWith("Does not hold: AChE monomer, improved")));
  EXPECT_THAT(sentences, Contains(AllOf(StartsWith("Not shown"), HasSubstr("APBS with the molecular surface"))));
  study.born[0].rows[1].order = 1.3;
  study.born[0].rows[0].error = 0.006;
  EXPECT_THAT(findings(study), Contains(StartsWith("Does not hold: Born's ion")));
  study.refinements[0].series[0].limit.reset();
  EXPECT_THAT(findings(study), Contains(StartsWith("Not shown: The fas2, smopt")));
}

TEST(SolvationStudy, ThePageAndTheFileTellEverySolve) {
  SolvationStudy study = made_study();
  study.comparisons[0].meshes[0].solve = solved(-1, SolvationStatus::not_converged);
  study.refinements[0].series[0].solves[1] = {};
  study.refinements[0].series[0].solves[1].failure = "no luck";
  const std::string page = study_markdown(study, "the command");
  for (const char* text : {"## Born's ion", "## The fas2 refined", "failed: no luck", "not_converged: the reason", "33 × 33 × 33",
                           "## What this shows", "Made by `the command`."})
    EXPECT_THAT(page, HasSubstr(text));
  const auto json = study_json(study);
  EXPECT_EQ(json.at("born").at(0).at("meshes").at(1).at("solve").at("polar_kcal_per_mol"), -81);
  EXPECT_EQ(json.at("refinement").at(0).at("meshes").at(0).at("solves").at(1).at("reason"), "no luck");
  EXPECT_EQ(json.at("initial_and_improved").at(0).at("apbs").at(0).at("polar"), -2200);
  EXPECT_EQ(json.at("findings").size(), findings(study).size());
}

}  // namespace
}  // namespace smopt::experiments
