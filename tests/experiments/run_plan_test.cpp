#include "experiments/run/run_plan.h"

#include <gmock/gmock.h>

#include <set>

#include "smopt/error.h"
#include "tests/experiments/made_records.h"

namespace smopt::experiments {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::Throws;

Dataset molecule(const std::string& name) {
  Dataset dataset = testing::made_dataset(name);
  dataset.path = "/molecules/" + name + ".pqr";
  return dataset;
}

PlanOptions options_for(std::vector<Dataset> datasets, const std::vector<std::string>& methods) {
  PlanOptions options;
  options.datasets = std::move(datasets);
  for (const std::string& name : methods) options.cases.push_back(find_method_case(name));
  return options;
}

std::vector<std::string> ids_of(const RunPlan& plan) {
  std::vector<std::string> ids;
  for (const Step& step : plan.steps) ids.push_back(step.id);
  return ids;
}

TEST(RunPlan, IsAGraphWhoseStepsComeAfterThoseTheyNeed) {
  const RunPlan plan = make_plan(options_for({molecule("a"), molecule("b")}, {"initial", "smopt", "iso2mesh", "meshlab"}));
  std::set<std::string> before, made;
  for (const Step& step : plan.steps) {
    for (const std::string& id : step.after) EXPECT_TRUE(before.contains(id)) << step.id << " after " << id;
    for (const std::string& file : step.inputs) EXPECT_TRUE(file.front() == '/' || made.contains(file)) << step.id << " reads " << file;
    EXPECT_TRUE(before.insert(step.id).second) << step.id << " twice";
    for (const std::string& file : step.outputs) EXPECT_TRUE(made.insert(file).second) << file << " made twice";
  }
  EXPECT_EQ(plan.cases.size(), 8U);
}

TEST(RunPlan, WhatTable2TimesRunsAloneOnOneThread) {
  const RunPlan plan = make_plan(options_for({molecule("a")}, {"smopt", "laplacian", "meshlab"}));
  for (const char* id : {"a/smopt.improve", "a/laplacian.improve"}) {
    EXPECT_TRUE(plan.step(id).needs.is_alone) << id;
    EXPECT_THAT(plan.step(id).command, IsSupersetOf({"--threads", "1"})) << id;
  }
  EXPECT_FALSE(plan.step("a/meshlab.improve").needs.is_alone);
  EXPECT_FALSE(plan.step("a/smopt.measure").needs.is_alone);
}

TEST(RunPlan, ACaseThatTakesItsVerticesFromAnotherComesAfterItWhetherThatIsRecordedOrNot) {
  const RunPlan plan = make_plan(options_for({molecule("a")}, {"iso2mesh"}));
  EXPECT_THAT(plan.step("a/iso2mesh.improve").after, Contains("a/smopt.improve"));
  EXPECT_THAT(plan.step("a/iso2mesh.improve").command, IsSupersetOf({"--match", "steps/a/smopt.ply"}));
  EXPECT_THAT(ids_of(plan), Not(Contains("a/smopt.record")));
}

TEST(RunPlan, SolvesWhatTable1Shows) {
  Dataset solved = molecule("a"), other = molecule("b");
  solved.has_solvation = true;
  const RunPlan plan = make_plan(options_for({solved, other}, {"initial", "smopt", "laplacian"}));
  EXPECT_THAT(ids_of(plan), IsSupersetOf({"a/initial.solvate", "a/smopt.solvate"}));
  EXPECT_THAT(ids_of(plan), Not(Contains("a/laplacian.solvate")));
  EXPECT_THAT(ids_of(plan), Not(Contains("b/smopt.solvate")));
  EXPECT_EQ(plan.cases[2].why_no_solvation, "only for Table 1");
  EXPECT_EQ(plan.cases[3].why_no_solvation, "not for this molecule");
}

TEST(RunPlan, AQuickRunSolvesForQuickMoleculesOnly) {
  Dataset quick = molecule("a"), other = molecule("b");
  quick.has_solvation = other.has_solvation = true;
  quick.suites = {std::string(kQuickSuite)};
  PlanOptions options = options_for({quick, other}, {"initial"});
  options.solvation.is_quick = true;
  const RunPlan plan = make_plan(options);
  EXPECT_THAT(ids_of(plan), Contains("a/initial.solvate"));
  EXPECT_EQ(plan.cases[1].why_no_solvation, "not in a quick run");
}

TEST(RunPlan, WithoutSimulationsThereAreNone) {
  PlanOptions options = options_for({molecule("a")}, {"initial", "smopt"});
  options.simulates = false;
  for (const Step& step : make_plan(options).steps) {
    EXPECT_THAT(step.rule, ::testing::AnyOf("generate", "improve", "measure", "record"));
    EXPECT_THAT(step.command, Not(Contains("--molecule")));
  }
}

TEST(RunPlan, AReadyMeshIsConvertedAndHasNoMoleculeToBeSolvedFor) {
  Dataset mesh = testing::made_dataset("m");
  mesh.path.clear();
  mesh.mesh = "/meshes/m.off";
  mesh.has_solvation = true;
  const RunPlan plan = make_plan(options_for({mesh}, {"initial"}));
  EXPECT_THAT(plan.step("m/initial.generate").command, ElementsAre("smopt", "convert", "/meshes/m.off", "steps/m/initial.ply", "--quiet"));
  EXPECT_EQ(plan.cases.front().why_no_solvation, "no molecule");
  EXPECT_THAT(plan.step("m/initial.measure").command, Not(Contains("--molecule")));
}

TEST(RunPlan, APdbFileIsPreparedFirst) {
  Dataset pdb = molecule("p");
  pdb.is_prepared_by_pdb2pqr = true;
  const RunPlan plan = make_plan(options_for({pdb}, {"initial"}));
  EXPECT_EQ(plan.steps.front().rule, "prepare");
  EXPECT_THAT(plan.step("p/initial.generate").after, ElementsAre("p/molecule.prepare"));
  EXPECT_THAT(plan.step("p/initial.generate").inputs, ElementsAre("steps/p/molecule.pqr"));
}

TEST(RunPlan, IsReadBackAsItWasWritten) {
  Dataset a = molecule("a");
  a.has_solvation = true;
  PlanOptions options = options_for({a, molecule("b")}, {"initial", "smopt", "iso2mesh", "smopt2-no-flips"});
  options.cases[1].options["guard"] = "none";
  options.repeats = 7;
  options.step_seconds = 12.5;
  const RunPlan plan = make_plan(options);
  EXPECT_EQ(to_json(parse_plan(to_json(plan).dump(), "plan.json")), to_json(plan));
}

TEST(RunPlan, APlanThatIsNoneIsNamed) {
  for (const char* text : {"", "{}", R"({"options": {}, "molecules": [], "cases": []})"})
    EXPECT_THAT([&] { parse_plan(text, "folder/plan.json"); },
                ::testing::ThrowsMessage<InvalidInput>(::testing::HasSubstr("folder/plan.json")))
        << text;
}

TEST(RunPlan, RefusesUnknownMethodsAndOptions) {
  EXPECT_THAT([] { make_plan(options_for({molecule("a")}, {"smoppt"})); }, Throws<InvalidOption>());
  PlanOptions options = options_for({molecule("a")}, {"smopt"});
  options.cases.front().options["gard"] = "none";
  EXPECT_THAT([&] { make_plan(options); }, Throws<InvalidOption>());
}

}  // namespace
}  // namespace smopt::experiments
