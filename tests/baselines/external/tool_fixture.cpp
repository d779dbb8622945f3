#include "tests/baselines/external/tool_fixture.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "smopt/error.h"

namespace smopt::baselines {
namespace {

namespace fs = std::filesystem;

/// What the fakes' scripts call.
constexpr const char* kShellPrograms[] = {"sh", "cp", "sleep", "kill", "cat", "echo", "mkdir", "rm", "touch", "dirname"};

}  // namespace

ToolTest::~ToolTest() {
  for (const auto& [name, value] : before_) value ? setenv(name.c_str(), value->c_str(), 1) : unsetenv(name.c_str());
}

void ToolTest::use_fakes() {
  const fs::path programs = folder() / "bin";
  fs::create_directory(programs);
  for (const char* name : kShellPrograms)
    if (fs::exists(fs::path("/bin") / name)) fs::create_symlink(fs::path("/bin") / name, programs / name);
  set_variable("PATH", programs.c_str());
}

void ToolTest::fake(const std::string& name, const std::string& script) {
  const fs::path path = folder_.file("bin/" + name, "#!/bin/sh\n" + script + "\n");
  fs::permissions(path, fs::perms::owner_all);
}

void ToolTest::set_variable(const std::string& name, const char* value) {
  const char* old = std::getenv(name.c_str());
  before_.emplace(name, old != nullptr ? std::optional<std::string>(old) : std::nullopt);
  value != nullptr ? setenv(name.c_str(), value, 1) : unsetenv(name.c_str());
}

std::string failure_of(const Method& method, const std::map<std::string, std::string>& options) {
  try {
    run_method(method, testing::icosphere(0), options);
  } catch (const MethodFailed& failure) {
    return failure.what();
  }
  ADD_FAILURE() << "did not fail";
  return {};
}

int processes_with(const std::string& text) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") == std::string::npos)
      count += testing::bytes_of(entry.path() / "cmdline").find(text) != std::string::npos ? 1 : 0;
  }
  return count;
}

}  // namespace smopt::baselines
