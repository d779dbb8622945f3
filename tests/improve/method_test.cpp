#include "smopt/improve/method.h"

#include <algorithm>

#include "baselines/baselines.h"
#include "smopt/error.h"
#include "smopt/improve/improve.h"
#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace smopt::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Given = std::map<std::string, std::string>;

const TriangleMesh& start() {
  static const TriangleMesh mesh = noisy(icosphere(2), 0.05, 1);
  return mesh;
}

struct Outcome {
  TriangleMesh mesh;
  MethodReport report;
};

Outcome run(const Method& method, const Given& given = {}) {
  TriangleMesh mesh = start();
  MethodReport report = method.run(mesh, OptionValues(method.options, given), {});
  return {std::move(mesh), std::move(report)};
}

/// What an InvalidOption says; empty when nothing is thrown.
template <class Action>
std::string complaint(const Action& action) {
  try {
    action();
  } catch (const InvalidOption& error) {
    return error.what();
  }
  return {};
}

/// Values that the option's own description allows.
std::vector<std::string> documented_values(const MethodOption& option) {
  std::vector<std::string> values = option.choices;
  values.push_back(option.default_value);
  return values;
}

std::vector<std::string> wrong_values(const MethodOption& option) {
  switch (option.kind) {
    case MethodOption::Kind::integer:
      return {"", "many", "1.5", "3x", " 3", "99999999999999999999", "-1"};
    case MethodOption::Kind::number:
      if (option.default_value.starts_with("-")) return {"", "wide", "1e", "0.1.2", "nan", "inf"};
      return {"", "wide", "1e", "0.1.2", "nan", "inf", "-1"};
    case MethodOption::Kind::choice:
      return {"", "no such choice"};
    case MethodOption::Kind::text:
      break;
  }
  return {};
}

class EveryMethod : public ::testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] const Method& method() const { return baselines::all_methods().find(GetParam()); }
};

/// Without those that start programs of others, which need not be installed; they have tests of their own.
std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method& method : baselines::all_methods().all())
    if (!method.name.starts_with("external:")) names.push_back(method.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, ::testing::ValuesIn(method_names()), [](const auto& test) { return test.param; });

TEST_P(EveryMethod, RunsWithItsDefaults) {
  const auto [mesh, report] = run(method());
  EXPECT_THAT(mesh, IsClosedManifold());
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_FALSE(is_same(mesh, start()));
  EXPECT_FALSE(report.stopped_because.empty());
  EXPECT_TRUE(std::any_of(report.seconds.begin(), report.seconds.end(), [](const auto& stage) { return stage.first == "smoothing"; }));
}

TEST_P(EveryMethod, GivesTheSameBytesTwice) {
  EXPECT_TRUE(is_same(run(method()).mesh, run(method()).mesh));
}

TEST_P(EveryMethod, RunsWithEachDocumentedValueOfEachOption) {
  for (const MethodOption& option : method().options) {
    for (const std::string& value : documented_values(option)) {
      SCOPED_TRACE("--" + option.name + " " + value);
      EXPECT_THAT(run(method(), {{option.name, value}}).mesh, IsClosedManifold());
    }
  }
}

TEST_P(EveryMethod, RejectsWrongValuesNamingTheOption) {
  for (const MethodOption& option : method().options)
    for (const std::string& value : wrong_values(option))
      EXPECT_THAT(complaint([&] {
                    run(method(), {{option.name, value}});
                  }),
                  HasSubstr(option.name))
          << "--" << option.name << " '" << value << "'";
}

TEST_P(EveryMethod, RejectsAnOptionThatItDoesNotHave) {
  EXPECT_THAT(complaint([&] { run(method(), {{"nonsense", "1"}}); }), HasSubstr("--nonsense"));
}

TEST_P(EveryMethod, DescribesItselfAndItsOptions) {
  EXPECT_FALSE(method().summary.empty());
  EXPECT_FALSE(method().source.empty());
  for (const MethodOption& option : method().options) {
    EXPECT_FALSE(option.help.empty()) << option.name;
    EXPECT_EQ(option.choices.empty(), option.kind != MethodOption::Kind::choice) << option.name;
    EXPECT_EQ(std::count_if(method().options.begin(), method().options.end(), [&](const auto& o) { return o.name == option.name; }), 1);
  }
}

TEST_P(EveryMethod, StopsWithCancelledWhenTheCallbackSaysSo) {
  TriangleMesh mesh = start();
  EXPECT_THROW(method().run(mesh, OptionValues(method().options, {}), [](std::string_view, double) { return false; }), Cancelled);
}

TEST(Methods, AreFoundByNameAndListedWhenThereIsNoSuch) {
  EXPECT_EQ(baselines::all_methods().find("smopt").name, "smopt");
  EXPECT_THAT(complaint([] { (void)baselines::all_methods().find("magic"); }),
              AllOf(HasSubstr("magic"), HasSubstr("smopt"), HasSubstr("laplacian")));
}

TEST(Methods, OnlySmoptDeletesCavitiesUnlessToldTo) {
  for (const Method& method : baselines::all_methods().all())
    EXPECT_EQ(method.default_cavities, method.name.starts_with("smopt") ? CavityPolicy::delete_cavities : CavityPolicy::keep)
        << method.name;
}

TEST(OptionValues, HaveTheDefaultsFilledIn) {
  const std::vector<MethodOption> options = {{"rounds", MethodOption::Kind::integer, "7", "", "", {}},
                                             {"beta", MethodOption::Kind::number, "0.5", "", "", {}}};
  const OptionValues values(options, {{"beta", "2.5e-1"}});
  EXPECT_EQ(values.integer("rounds", 0), 7);
  EXPECT_EQ(values.number("beta", 0), 0.25);
  EXPECT_EQ(values.all(), (Given{{"rounds", "7"}, {"beta", "2.5e-1"}}));
  EXPECT_THAT(complaint([&] { (void)values.integer("rounds", 8); }), HasSubstr("--rounds"));
  EXPECT_THAT(complaint([&] { (void)values.number("beta", 0.3); }), HasSubstr("--beta"));
  EXPECT_THAT(complaint([&] { (void)values.text("gamma"); }), HasSubstr("--gamma"));
}

TEST(OptionValues, RejectAValueOfTheWrongKindBeforeAnythingRuns) {
  const Method& smopt = baselines::all_methods().find("smopt");
  EXPECT_THAT(complaint([&] { OptionValues(smopt.options, {{"rounds", "many"}}); }), HasSubstr("--rounds"));
  EXPECT_THAT(complaint([&] { OptionValues(smopt.options, {{"min-angle", "wide"}}); }), HasSubstr("--min-angle"));
  EXPECT_THAT(complaint([&] { OptionValues(smopt.options, {{"step", "long"}}); }), AllOf(HasSubstr("--step"), HasSubstr("umbrella")));
}

TEST(CavityPolicies, AreWrittenAsTheyAreRead) {
  for (const CavityPolicy policy : {CavityPolicy::delete_cavities, CavityPolicy::keep, CavityPolicy::main})
    EXPECT_EQ(parse_cavity_policy(to_string(policy)), policy);
  EXPECT_THAT(complaint([] { parse_cavity_policy("some"); }), AllOf(HasSubstr("--cavities"), HasSubstr("some")));
}

// ---- smopt ----

const Method& smopt() {
  return baselines::all_methods().find("smopt");
}

TEST(SmoptMethod, WithItsDefaultsIsThePipelineWithItsDefaults) {
  TriangleMesh by_method = with_points_in_faces(start(), 2), by_library = by_method;
  const MethodReport report = smopt().run(by_method, OptionValues(smopt().options, {}), {});
  const ImproveReport expected = improve(by_library, {});
  EXPECT_TRUE(is_same(by_method, by_library));
  EXPECT_EQ(report.redundant_valence3, expected.redundant.valence3);
  EXPECT_EQ(report.redundant_valence3, start().triangle_count());
  EXPECT_EQ(report.redundant_valence4, expected.redundant.valence4);
  EXPECT_EQ(report.moves.accepted, expected.smoothing.moves.accepted);
  EXPECT_EQ(report.rounds.size(), expected.smoothing.rounds.size());
  EXPECT_EQ(report.stopped_because, expected.smoothing.stopped_because);
}

TEST(SmoptMethod, EachOptionDoesWhatItSays) {
  EXPECT_TRUE(run(smopt(), {{"rounds", "0"}}).report.rounds.empty());
  EXPECT_TRUE(is_same(run(smopt(), {{"rounds", "0"}}).mesh, start()));
  EXPECT_EQ(run(smopt(), {{"rounds", "1"}}).report.rounds.size(), 1U);
  EXPECT_GT(run(smopt(), {{"min-angle", "50"}}).report.moves.accepted, run(smopt()).report.moves.accepted);
  EXPECT_GT(run(smopt(), {{"edge-ratio", "0.9"}}).report.moves.accepted, run(smopt()).report.moves.accepted);
  EXPECT_EQ(run(smopt(), {{"halvings", "0"}}).report.moves.shortened, 0U);
  EXPECT_NEAR(enclosed_volume(run(smopt(), {{"step", "volume-preserving"}}).mesh), enclosed_volume(start()), 1e-12);
  EXPECT_FALSE(is_same(run(smopt(), {{"step", "tangential"}}).mesh, run(smopt()).mesh));
}

TEST(SmoptMethod, KeepsRedundantPointsWhenToldTo) {
  const TriangleMesh with_points = with_points_in_faces(start(), 2);
  TriangleMesh mesh = with_points;
  const MethodReport report = smopt().run(mesh, OptionValues(smopt().options, {{"redundant", "keep"}, {"rounds", "0"}}), {});
  EXPECT_TRUE(is_same(mesh, with_points));
  EXPECT_EQ(report.redundant_valence3, 0U);
}

TEST(SmoptMethod, ReadsAToleranceInAngstromOrRelativeToTheEdges) {
  const auto removed = [](const std::string& tolerance, double scale) {
    TriangleMesh mesh = scaled(noisy(with_points_in_faces(icosphere(1), 1), 0.001, 1), scale);
    return smopt().run(mesh, OptionValues(smopt().options, {{"tolerance", tolerance}, {"rounds", "0"}}), {}).redundant_valence3;
  };
  EXPECT_EQ(removed("0.01", 1), 80U);
  EXPECT_LT(removed("0.01", 1000), 20U);
  EXPECT_EQ(removed("0.02rel", 1), 80U);
  EXPECT_EQ(removed("0.02rel", 1000), 80U);
  EXPECT_LT(removed("1e-5rel", 1), 20U);
  for (const char* wrong : {"", "rel", "thin", "-1", "1e-4Å", "1e-4 rel", "nan", "-1rel"})
    EXPECT_THAT(complaint([&] { run(smopt(), {{"tolerance", wrong}}); }), HasSubstr("--tolerance")) << wrong;
}

TEST(SmoptMethod, RejectsValuesOutOfRangeNamingTheOption) {
  for (const auto& [name, value] : Given{{"rounds-per-screening", "0"}, {"edge-ratio", "1"}, {"min-angle", "60"}})
    EXPECT_THAT(complaint([&] { run(smopt(), {{name, value}}); }), HasSubstr(name)) << value;
}

}  // namespace
}  // namespace smopt
