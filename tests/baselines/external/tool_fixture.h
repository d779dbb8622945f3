#pragma once

#include <gmock/gmock.h>

#include <map>
#include <optional>
#include <string>

#include "smopt/improve/method.h"
#include "tests/baselines/method_run.h"
#include "tests/support/files.h"
#include "tests/support/shapes.h"

namespace smopt::baselines {

/// Tests of an entry that runs somebody else's program. Until the test asks for fakes, PATH is that of the system.
class ToolTest : public ::testing::Test {
 protected:
  ~ToolTest() override;

  /// From here on PATH leads to the fakes alone, and to sh and what shell scripts use.
  void use_fakes();
  /// A shell script of this name in PATH.
  void fake(const std::string& name, const std::string& script);
  /// Sets a variable until the end of the test; takes it away where there is no value.
  void set_variable(const std::string& name, const char* value);

  [[nodiscard]] std::filesystem::path folder() const { return folder_.path(); }

 private:
  testing::TemporaryFolder folder_;
  std::map<std::string, std::optional<std::string>> before_;
};

/// What the MethodFailed says that running the method throws; a failure of the test when it throws none.
std::string failure_of(const Method& method, const std::map<std::string, std::string>& options = {});

/// The processes whose command line contains `text`.
int processes_with(const std::string& text);

}  // namespace smopt::baselines
