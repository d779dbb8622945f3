#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <random>
#include <thread>

#include "experiments/record.h"
#include "experiments/run_layout.h"
#include "tests/experiments/records_alike.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace smopt::experiments {
namespace {

namespace fs = std::filesystem;
using smopt::testing::bytes_of;
using smopt::testing::ProgramResult;
using smopt::testing::run_program;
using smopt::testing::RunningProgram;
using smopt::testing::TemporaryFolder;
using smopt::testing::without_times;

constexpr int kKills = 10;
constexpr const char* kMethods[] = {"initial", "smopt", "laplacian", "iso2mesh"};

std::vector<std::string> reproduce(const fs::path& directory, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments = {
      "reproduce", "-o", directory.string(), "--molecules", "fas2", "--methods", "initial,smopt,laplacian,iso2mesh", "--repeats", "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::vector<fs::path> files_ending_in(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().string().ends_with(ending)) files.push_back(entry.path());
  return files;
}

/// Runs until something new is done (or a moment has gone by), and a random while longer; then it is killed. \return whether it was.
bool run_and_kill(const fs::path& directory, std::mt19937& random) {
  RunningProgram program(SMOPT_PROGRAM, reproduce(directory, {"--resume"}));
  std::this_thread::sleep_for(std::chrono::milliseconds(std::uniform_int_distribution(20, 900)(random)));
  if (!program.is_running()) return false;
  program.send(SIGKILL);
  return program.wait().signal == SIGKILL;
}

TEST(Resume, ARunThatIsKilledAgainAndAgainEndsWithTheSameRecords) {
  if (smopt::testing::apbs_molecule("misc/fas2.pqr").empty()) GTEST_SKIP() << "apbs-data is not installed";
  const TemporaryFolder folder;
  const fs::path undisturbed = folder.path() / "undisturbed", killed = folder.path() / "killed";
  ASSERT_EQ(run_program(SMOPT_PROGRAM, reproduce(undisturbed)).exit_code, 0);
  const unsigned seed = std::random_device()();
  SCOPED_TRACE(::testing::Message() << "seed " << seed);
  std::mt19937 random(seed);
  int kills = 0;
  for (int i = 0; i < kKills; ++i) kills += run_and_kill(killed, random) ? 1 : 0;
  const ProgramResult last = run_program(SMOPT_PROGRAM, reproduce(killed, {"--resume"}));
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_GE(kills, 3) << "the run is too short for this test";
  for (const char* method : kMethods) {
    const auto record = [&](const fs::path& directory) { return Json::parse(bytes_of(record_path(directory, "fas2", method))); };
    EXPECT_EQ(without_times(record(killed)).dump(1), without_times(record(undisturbed)).dump(1)) << method;
  }
  EXPECT_THAT(files_ending_in(killed, ".tmp"), ::testing::IsEmpty()) << "nothing half-written stays";
}

}  // namespace
}  // namespace smopt::experiments
