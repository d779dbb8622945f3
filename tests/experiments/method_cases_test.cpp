#include "experiments/method_cases.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "baselines/baselines.h"
#include "smopt/error.h"

namespace smopt::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::ThrowsMessage;
using ::testing::UnorderedElementsAre;

TEST(MethodCases, EachNamesARegisteredMethodAndItsOptions) {
  for (const MethodCase& method_case : all_method_cases()) {
    const Method& method = baselines::all_methods().find(method_case.method);
    EXPECT_NO_THROW(OptionValues(method.options, method_case.options)) << method_case.name;
    EXPECT_FALSE(method_case.title.empty()) << method_case.name;
  }
}

TEST(MethodCases, TakeVerticesOnlyWhereTheMethodHasThatOption) {
  for (const MethodCase& method_case : all_method_cases()) {
    if (method_case.vertices_of.empty()) continue;
    EXPECT_NO_THROW(OptionValues(baselines::all_methods().find(method_case.method).options, {{"vertices", "100"}})) << method_case.name;
    EXPECT_THAT(find_method_case(method_case.vertices_of).vertices_of, IsEmpty()) << "or they might wait for each other";
  }
}

TEST(MethodCases, HaveNamesOfTheirOwnAndThePapersAreAmongThem) {
  std::set<std::string> names, in_paper;
  for (const MethodCase& method_case : all_method_cases()) {
    EXPECT_TRUE(names.insert(method_case.name).second) << method_case.name;
    if (method_case.is_in_paper_tables) in_paper.insert(method_case.name);
  }
  EXPECT_THAT(in_paper, UnorderedElementsAre("smopt", "iso2mesh", "laplacian", "meshlab"));
  for (const Method& method : baselines::all_methods().all()) EXPECT_TRUE(names.contains(method.name)) << method.name << " has no title";
}

TEST(MethodCases, AllAreTheInitialMeshAndEveryCaseButTheAblations) {
  const std::vector<std::string> all = all_compared_methods();
  EXPECT_EQ(all.front(), kInitial);
  std::size_t ablations = 0;
  for (const MethodCase& method_case : all_method_cases()) {
    ablations += method_case.is_ablation ? 1 : 0;
    EXPECT_EQ(std::find(all.begin(), all.end(), method_case.name) == all.end(), method_case.is_ablation) << method_case.name;
  }
  EXPECT_EQ(all.size(), all_method_cases().size() + 1 - ablations);
}

TEST(MethodCases, AnAblationChangesOneOptionOfAListedMethod) {
  std::set<std::string> changed;
  for (const MethodCase& method_case : all_method_cases()) {
    if (!method_case.is_ablation) continue;
    const MethodCase whole = find_method_case(method_case.method);
    EXPECT_EQ(whole.name, "smopt2") << method_case.name;
    ASSERT_EQ(method_case.options.size(), whole.options.size() + 1) << method_case.name;
    const auto& [option, value] = *method_case.options.begin();
    changed.insert(option);
    const Method& method = baselines::all_methods().find(method_case.method);
    EXPECT_NE(OptionValues(method.options, {}).text(option), value) << method_case.name << " is the method with its defaults";
    EXPECT_FALSE(method_case.is_in_paper_tables);
  }
  EXPECT_THAT(changed, UnorderedElementsAre("flips", "collapses", "splits", "volume"));
}

TEST(MethodCases, ANameThatIsNotListedIsTheMethodWithItsDefaults) {
  const MethodCase unlisted = find_method_case("my-method");
  EXPECT_EQ(unlisted.method, "my-method");
  EXPECT_EQ(unlisted.title, "my-method");
  EXPECT_THAT(unlisted.options, IsEmpty());
  EXPECT_FALSE(unlisted.is_in_paper_tables);
}

TEST(MethodCases, AreReadWithTheirOptions) {
  const auto cases = parse_method_cases(
      R"({"cases": [{"name": "a", "title": "A", "method": "b", "vertices_of": "c", "options": {"rounds": "3"}}, {"name": "d", "title": "D", "is_ablation": true}]})");
  ASSERT_EQ(cases.size(), 2U);
  EXPECT_EQ(cases[0].method, "b");
  EXPECT_EQ(cases[0].vertices_of, "c");
  EXPECT_THAT(cases[0].options, UnorderedElementsAre(Pair("rounds", "3")));
  EXPECT_EQ(cases[1].method, "d");
  EXPECT_TRUE(cases[1].is_ablation && !cases[0].is_ablation);
}

TEST(MethodCases, SayWhichEntryIsWrong) {
  EXPECT_THAT([] { parse_method_cases(R"({"cases": [{"name": "a", "title": "A"}, {"name": "b"}]})"); },
              ThrowsMessage<InvalidInput>(::testing::AllOf(HasSubstr("case 1"), HasSubstr("title"))));
}

}  // namespace
}  // namespace smopt::experiments
