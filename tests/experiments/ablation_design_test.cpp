#include "experiments/ablation/design.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "baselines/baselines.h"
#include "experiments/datasets.h"
#include "smopt/error.h"

namespace smopt::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::ThrowsMessage;
using ::testing::UnorderedElementsAre;

constexpr const char* kDefault = "default";

std::set<std::string> names_of(const std::vector<DesignCase>& cases) {
  std::set<std::string> names;
  for (const DesignCase& c : cases) names.insert(c.method_case.name);
  return names;
}

std::size_t combinations(const std::vector<VariedFactor>& varied) {
  std::size_t product = 1;
  for (const VariedFactor& factor : varied) product *= factor.levels.size();
  return product;
}

/// Both plans of ablation.json.
class AblationPlans : public ::testing::TestWithParam<bool> {
 protected:
  [[nodiscard]] const AblationPlan& plan() const { return ablation_plan(GetParam()); }
};

TEST_P(AblationPlans, EveryCaseHasOptionsThatTheMethodTakes) {
  const Method& method = baselines::all_methods().find(plan().method);
  for (const DesignCase& c : chosen_cases(plan(), {})) {
    EXPECT_NO_THROW(OptionValues(method.options, c.method_case.options)) << c.method_case.name;
    EXPECT_NO_THROW(parse_cavity_policy(c.method_case.cavities)) << c.method_case.name;
    EXPECT_EQ(c.method_case.method, plan().method);
    EXPECT_FALSE(c.method_case.title.empty());
    EXPECT_TRUE(c.method_case.is_timed) << c.method_case.name << ": its time is in the tables";
  }
}

TEST_P(AblationPlans, MoleculesAreDatasets) {
  EXPECT_EQ(find_datasets(all_datasets(), plan().molecules).size(), plan().molecules.size());
}

TEST_P(AblationPlans, OneAtATimeHasTheDefaultOnceAndEachOtherLevelOnce) {
  const std::vector<DesignCase> cases = one_at_a_time(plan(), plan().one_at_a_time);
  std::size_t expected = 1;
  for (const VariedFactor& factor : plan().one_at_a_time) expected += factor.levels.size() - 1;
  EXPECT_EQ(cases.size(), expected);
  EXPECT_EQ(names_of(cases).size(), expected) << "all distinct";
  EXPECT_EQ(cases.front().method_case.name, kDefault);
  EXPECT_THAT(cases.front().method_case.options, IsEmpty());
  const std::vector<std::size_t> defaults = default_levels(plan());
  for (std::size_t i = 1; i < cases.size(); ++i) {
    int changed = 0;
    for (std::size_t f = 0; f < defaults.size(); ++f) changed += cases[i].levels[f] != defaults[f] ? 1 : 0;
    EXPECT_EQ(changed, 1) << cases[i].method_case.name;
  }
}

TEST_P(AblationPlans, AFactorialIsBalancedAndHasTheDefaultOnce) {
  for (const auto& varied : {plan().factorial, plan().thresholds}) {
    const std::vector<DesignCase> cases = full_factorial(plan(), varied);
    EXPECT_EQ(cases.size(), combinations(varied));
    EXPECT_EQ(names_of(cases).size(), cases.size()) << "all distinct";
    EXPECT_EQ(names_of(cases).count(kDefault), 1U);
    for (const auto& [factor, levels] : varied) {
      std::map<std::size_t, std::size_t> times;
      for (const DesignCase& c : cases) ++times[c.levels[factor]];
      for (const std::size_t level : levels) EXPECT_EQ(times[level], cases.size() / levels.size()) << plan().factors[factor].name;
    }
  }
}

TEST_P(AblationPlans, EveryTwoFactorsOfAFactorialMeetEquallyOftenInAllLevels) {
  const std::vector<DesignCase> cases = full_factorial(plan(), plan().factorial);
  for (const VariedFactor& one : plan().factorial) {
    for (const VariedFactor& other : plan().factorial) {
      if (one.factor == other.factor) continue;
      std::map<std::pair<std::size_t, std::size_t>, std::size_t> times;
      for (const DesignCase& c : cases) ++times[{c.levels[one.factor], c.levels[other.factor]}];
      EXPECT_EQ(times.size(), one.levels.size() * other.levels.size());
      for (const auto& [pair, count] : times) EXPECT_EQ(count, cases.size() / times.size());
    }
  }
}

TEST_P(AblationPlans, EqualSettingsHaveOneNameAndOneNameHasEqualSettings) {
  std::map<std::string, std::pair<std::map<std::string, std::string>, std::string>> settings;
  std::size_t in_all_designs = 0;
  for (const auto& cases :
       {one_at_a_time(plan(), plan().one_at_a_time), full_factorial(plan(), plan().factorial), full_factorial(plan(), plan().thresholds)}) {
    for (const DesignCase& c : cases) {
      const auto [entry, is_new] = settings.try_emplace(c.method_case.name, c.method_case.options, c.method_case.cavities);
      EXPECT_THAT(entry->second, Pair(c.method_case.options, c.method_case.cavities)) << c.method_case.name;
      ++in_all_designs;
    }
  }
  const std::vector<DesignCase> chosen = chosen_cases(plan(), {});
  EXPECT_EQ(chosen.size(), settings.size()) << "each is run once, however many designs ask for it";
  EXPECT_LT(chosen.size(), in_all_designs);
}

INSTANTIATE_TEST_SUITE_P(Both, AblationPlans, ::testing::Bool(), [](const auto& tested) { return tested.param ? "Quick" : "Full"; });

TEST(AblationDesign, TheFullFactorialIsOfAboutAHundredCases) {
  EXPECT_LE(combinations(ablation_plan(false).factorial), 100U);
  EXPECT_LT(chosen_cases(ablation_plan(true), {}).size(), chosen_cases(ablation_plan(false), {}).size() / 3);
}

TEST(AblationDesign, ChosenDesignsAloneAreRun) {
  const AblationPlan& plan = ablation_plan(false);
  EXPECT_EQ(chosen_cases(plan, {false, false, true}).size(), combinations(plan.thresholds));
  EXPECT_EQ(chosen_cases(plan, {false, true, false}).size(), combinations(plan.factorial));
  EXPECT_THAT(chosen_cases(plan, {false, false, false}), IsEmpty());
}

/// A plan of two switches and two thresholds.
nlohmann::ordered_json small_plan() {
  return nlohmann::ordered_json::parse(R"({
    "method": "smopt", "molecules": ["fas2"], "quick_molecules": ["fas2"],
    "factors": [
      {"name": "guard", "title": "Guard", "about": "a", "default": "exact",
       "levels": [{"name": "exact", "options": {"guard": "exact"}}, {"name": "paper-1", "title": "the paper's", "options": {"guard": "paper", "vicinity": "1"}}]},
      {"name": "cavities", "title": "Cavities", "about": "b", "default": "delete",
       "levels": [{"name": "delete", "cavities": "delete"}, {"name": "keep", "cavities": "keep"}]},
      {"name": "edge-ratio", "title": "Ratio", "about": "c", "default": "0.1",
       "levels": [{"name": "0.1", "options": {"edge-ratio": "0.1"}}, {"name": "0.3", "options": {"edge-ratio": "0.3"}}]},
      {"name": "min-angle", "title": "Angle", "about": "d", "unit": "°", "default": "10",
       "levels": [{"name": "10", "options": {"min-angle": "10"}}, {"name": "20", "options": {"min-angle": "20"}}]}],
    "designs": {"one-at-a-time": {"guard": "all"}, "factorial": {"guard": "all", "cavities": ["delete", "keep"]},
                "thresholds": {"edge-ratio": "all", "min-angle": "all"}},
    "quick_designs": {"one-at-a-time": {}, "factorial": {}, "thresholds": {"edge-ratio": ["0.1"], "min-angle": ["10"]}}
  })");
}

AblationPlan parse(const nlohmann::ordered_json& json) {
  return parse_ablation_plan(json.dump(), false);
}

TEST(AblationDesign, ACaseHasTheOptionsOfAllItsLevels) {
  const AblationPlan plan = parse(small_plan());
  const DesignCase c = design_case(plan, {1, 1, 0, 1});
  EXPECT_EQ(c.method_case.name, "guard-paper-1+cavities-keep+min-angle-20");
  EXPECT_EQ(c.method_case.title, "Guard: the paper's; Cavities: keep; Angle: 20°");
  EXPECT_THAT(c.method_case.options, UnorderedElementsAre(Pair("guard", "paper"), Pair("vicinity", "1"), Pair("min-angle", "20")));
  EXPECT_EQ(c.method_case.cavities, "keep");
  EXPECT_EQ(design_case(plan, default_levels(plan)).method_case.cavities, "delete");
}

TEST(AblationDesign, TheLastFactorChangesFastest) {
  const std::vector<DesignCase> cases = full_factorial(parse(small_plan()), parse(small_plan()).factorial);
  std::vector<std::string> names;
  for (const DesignCase& c : cases) names.push_back(c.method_case.name);
  EXPECT_THAT(names, ::testing::ElementsAre("default", "cavities-keep", "guard-paper-1", "guard-paper-1+cavities-keep"));
}

/// What is done to the small plan, and what must be said of it.
struct BadPlan {
  const char* name;
  void (*spoil)(nlohmann::ordered_json&);
  std::vector<const char*> said;
};

class BadPlans : public ::testing::TestWithParam<BadPlan> {};

TEST_P(BadPlans, AreRefusedAndTheEntryIsNamed) {
  nlohmann::ordered_json json = small_plan();
  ASSERT_NO_THROW(parse(json));
  GetParam().spoil(json);
  for (const char* part : GetParam().said) EXPECT_THAT([&] { parse(json); }, ThrowsMessage<InvalidInput>(HasSubstr(part)));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadPlans,
    ::testing::Values(
        BadPlan{"AnUnknownMethod", [](nlohmann::ordered_json& j) { j["method"] = "smoppt"; }, {"method", "smoppt"}},
        BadPlan{"ALevelWithoutAName",
                [](nlohmann::ordered_json& j) { j["factors"][1]["levels"][0].erase("name"); },
                {"factor 1 (cavities)", "name"}},
        BadPlan{"AnOptionThatTheMethodHasNot",
                [](nlohmann::ordered_json& j) { j["factors"][0]["levels"][1]["options"]["gard"] = "none"; },
                {"factor 0 (guard)", "gard"}},
        BadPlan{"AValueThatTheOptionHasNot",
                [](nlohmann::ordered_json& j) { j["factors"][0]["levels"][1]["options"]["guard"] = "nobody"; },
                {"factor 0 (guard)", "nobody"}},
        BadPlan{"ACavityPolicyThatIsNone",
                [](nlohmann::ordered_json& j) { j["factors"][1]["levels"][1]["cavities"] = "fill"; },
                {"cavities", "fill"}},
        BadPlan{"ADefaultThatIsNotTheMethods",
                [](nlohmann::ordered_json& j) { j["factors"][0]["default"] = "paper-1"; },
                {"factor 0 (guard)", "paper"}},
        BadPlan{"ADefaultThatIsNoLevel",
                [](nlohmann::ordered_json& j) { j["factors"][2]["default"] = "0.2"; },
                {"factor 2 (edge-ratio)", "0.2"}},
        BadPlan{"ALevelTwice",
                [](nlohmann::ordered_json& j) { j["factors"][3]["levels"][1]["name"] = "10"; },
                {"factor 3 (min-angle)", "twice"}},
        BadPlan{"AFactorTwice", [](nlohmann::ordered_json& j) { j["factors"][1]["name"] = "guard"; }, {"factor 1 (guard)", "twice"}},
        BadPlan{"ANameThatIsNoFileName",
                [](nlohmann::ordered_json& j) { j["factors"][0]["levels"][1]["name"] = "../x"; },
                {"factor 0", "../x"}},
        BadPlan{"ADesignOfAnUnknownFactor",
                [](nlohmann::ordered_json& j) { j["designs"]["factorial"]["gard"] = "all"; },
                {"factorial", "gard"}},
        BadPlan{"ADesignWithAnUnknownLevel",
                [](nlohmann::ordered_json& j) {
                  j["designs"]["factorial"]["guard"] = {"exact", "none"};
                },
                {"factorial", "guard", "none"}},
        BadPlan{"ADesignWithoutTheDefault",
                [](nlohmann::ordered_json& j) { j["designs"]["factorial"]["cavities"] = {"keep"}; },
                {"factorial", "cavities", "delete"}},
        BadPlan{"TwoFactorsThatSetTheSameOption",
                [](nlohmann::ordered_json& j) { j["factors"][2]["levels"][1]["options"]["min-angle"] = "5"; },
                {"thresholds", "min-angle", "edge-ratio"}},
        BadPlan{"AGridOfWords",
                [](nlohmann::ordered_json& j) {
                  j["designs"]["thresholds"] = {{"edge-ratio", "all"}, {"guard", "all"}};
                },
                {"thresholds", "guard", "no number"}},
        BadPlan{"AGridOfOneFactor",
                [](nlohmann::ordered_json& j) { j["designs"]["thresholds"].erase("min-angle"); },
                {"thresholds", "two factors"}},
        BadPlan{"NoDesigns", [](nlohmann::ordered_json& j) { j.erase("designs"); }, {"designs"}}),
    [](const auto& tested) { return tested.param.name; });

TEST(AblationDesign, ATextThatIsNoJsonIsRefused) {
  EXPECT_THAT([] { parse_ablation_plan("{", false); }, ThrowsMessage<InvalidInput>(HasSubstr("ablation")));
}

}  // namespace
}  // namespace smopt::experiments
