#include "baselines/external/external_methods.h"

#include "smopt/error.h"
#include "tests/baselines/external/tool_fixture.h"

namespace smopt::baselines {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

/// With nothing installed at all.
class ExternalMethods : public ToolTest {
 protected:
  ExternalMethods() {
    use_fakes();
    set_variable("ISO2MESH", nullptr);
    register_external_tools(registry_);
  }

  MethodRegistry registry_;
};

TEST_F(ExternalMethods, AreListedWithTheirNeedsWhereNothingIsInstalled) {
  EXPECT_THAT(registry_.all(), SizeIs(3));
  for (const Method& method : registry_.all()) {
    EXPECT_THAT(method.name, StartsWith("external:"));
    EXPECT_THAT(method.note, HasSubstr("needs ")) << method.name;
    EXPECT_FALSE(method.summary.empty() || method.source.empty()) << method.name;
    for (const MethodOption& option : method.options) EXPECT_FALSE(option.help.empty()) << method.name << " --" << option.name;
  }
}

TEST_F(ExternalMethods, SayThatTheyAreNotInstalledAndLeaveTheMeshAlone) {
  for (const Method& method : registry_.all()) {
    TriangleMesh mesh = testing::icosphere(0);
    EXPECT_THROW(method.run(mesh, OptionValues(method.options, {}), {}), NotInstalled) << method.name;
    EXPECT_EQ(mesh.points, testing::icosphere(0).points);
  }
}

TEST_F(ExternalMethods, RejectWrongValuesBeforeTheyLookForTheirPrograms) {
  for (const Method& method : registry_.all()) {
    for (const MethodOption& option : method.options) {
      if (option.kind == MethodOption::Kind::text) continue;
      for (const char* value : {"", "no such value", "-1"})
        EXPECT_THROW(run_method(method, testing::icosphere(0), {{option.name, value}}), InvalidOption)
            << method.name << " --" << option.name << " '" << value << "'";
    }
  }
}

}  // namespace
}  // namespace smopt::baselines
