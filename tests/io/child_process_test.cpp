#include "smopt/io/child_process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>
#include <vector>

#include "tests/support/files.h"

namespace smopt {
namespace {

/// Its peak memory, MB, as run from a process that holds `ballast_mb` itself.
double peak_of(const std::vector<std::string>& command, std::size_t ballast_mb) {
  const std::vector<char> ballast(ballast_mb << 20, 1);
  return run_process(command, {60, 0}, "test", {}).peak_memory_mb;
}

TEST(ChildProcess, PeakMemoryIsTheProgramsNotItsParents) {
  constexpr double kShell = 50;  // more than a shell needs
  EXPECT_LT(peak_of({"/bin/sh", "-c", "sleep 0.2"}, 400), kShell);
  EXPECT_GT(peak_of({"/bin/sh", "-c", "sleep 0.2"}, 400), 0);
}

TEST(ChildProcess, PeakMemoryCountsWhatTheProgramTakes) {
  if (!std::filesystem::exists("/usr/bin/python3")) GTEST_SKIP() << "no python3";
  const double peak = peak_of({"/usr/bin/python3", "-c", "import time; x = b'x' * (200 << 20); del x; time.sleep(0.2)"}, 400);
  EXPECT_GT(peak, 200);
  EXPECT_LT(peak, 300);
}

ProcessOutcome run_shell(const std::string& script, const ProcessLimits& limits, const ProcessSurroundings& surroundings = {}) {
  return run_process({"/bin/sh", "-c", script}, limits, "test", {}, surroundings);
}

TEST(ChildProcess, SetsVariablesBesideThoseThatAreThere) {
  const std::string script = "echo \"$SMOPT_A $SMOPT_B ${PATH:+path}\"";
  EXPECT_EQ(run_shell(script, {60}, {{{"SMOPT_A", "one"}, {"SMOPT_B", "two words"}}, {}}).output, "one two words path\n");
}

TEST(ChildProcess, ReplacesVariablesThatAreThere) {
  EXPECT_EQ(run_shell("echo \"$HOME\"; env | grep -c ^HOME=", {60}, {{{"HOME", "/nowhere"}}, {}}).output, "/nowhere\n1\n");
}

TEST(ChildProcess, RunsInTheFolderItIsGiven) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(run_shell("pwd -P", {60}, {{}, folder.path()}).output, std::filesystem::canonical(folder.path()).string() + "\n");
  EXPECT_EQ(run_shell("true", {60}, {{}, folder.path() / "missing"}).exit_status, 127);
}

TEST(ChildProcess, CountsProcessorTimeOfWhatTheProgramWaitedFor) {
  const std::string work = "i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done";
  EXPECT_GT(run_shell("sh -c '" + work + "'; sleep 0.2", {60}).cpu_seconds, 0.02);
  EXPECT_LT(run_shell("sleep 0.2", {60}).cpu_seconds, 0.05);
}

/// A shell whose child writes `file` when it is asked to end, and the name of that file.
std::string tidying_child(const std::filesystem::path& file) {
  return "sh -c 'trap \"echo tidied > " + file.string() + "; exit\" TERM; while :; do sleep 0.01; done' & sleep 0.3; ";
}

TEST(ChildProcess, LetsWhatWasStartedTidyUpBeforeItIsKilled) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(run_shell(tidying_child(folder.path() / "a"), {60, 0, 5}).exit_status, 0);
  EXPECT_EQ(testing::bytes_of(folder.path() / "a"), "tidied\n") << "left behind by a program that ended";
  EXPECT_TRUE(run_shell(tidying_child(folder.path() / "b") + "sleep 50", {1, 0, 5}).out_of_time);
  EXPECT_EQ(testing::bytes_of(folder.path() / "b"), "tidied\n") << "started by a program that ran out of time";
}

TEST(ChildProcess, KillsWhatDoesNotEndWhenAsked) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "beats";
  const ProcessOutcome outcome = run_shell("trap '' TERM; while :; do echo . >> " + file.string() + "; sleep 0.01; done", {0.3, 0, 0.2});
  EXPECT_TRUE(outcome.out_of_time);
  EXPECT_EQ(outcome.signal, SIGKILL);
  EXPECT_LT(outcome.seconds, 10);
  const std::string before = testing::bytes_of(file);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(testing::bytes_of(file), before);
}

}  // namespace
}  // namespace smopt
