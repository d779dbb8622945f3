#include "experiments/run/step_run.h"

#include <gmock/gmock.h>

#include "smopt/error.h"
#include "smopt/io/sha256.h"
#include "tests/support/files.h"

namespace smopt::experiments {
namespace {

using smopt::testing::bytes_of;
using smopt::testing::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Throws;
using Json = nlohmann::ordered_json;

/// A step that runs a line of shell, which makes the file "out" of the file "in".
Step shell(const std::string& line) {
  Step step;
  step.id = "molecule/method.improve";
  step.rule = "improve";
  step.command = {"/bin/sh", "-c", line};
  step.inputs = {"in"};
  step.outputs = {"out"};
  step.limits = {60, 0};
  return step;
}

class StepRun : public ::testing::Test {
 protected:
  StepRun() { static_cast<void>(folder_.file("in", "1\n")); }

  StepOutcome run(const Step& step) { return run_step(step, place_, {}); }
  [[nodiscard]] Json stamp(const Step& step) const { return Json::parse(bytes_of(folder_.path() / stamp_path(step))); }
  [[nodiscard]] bool is_done_already(const Step& step) const { return earlier_outcome(step, place_).has_value(); }

  TemporaryFolder folder_;
  StepPlace place_ = step_place(folder_.path(), "/bin/sh");
};

TEST_F(StepRun, RunsTheCommandInTheRunsFolderAndLeavesAStamp) {
  const Step step = shell("cat in in > out");
  EXPECT_EQ(run(step).status, "done");
  EXPECT_EQ(bytes_of(folder_.path() / "out"), "1\n1\n");
  EXPECT_EQ(stamp(step).at("status"), "done");
  EXPECT_EQ(stamp(step).at("sha256").at("out"), sha256_hex("1\n1\n"));
  EXPECT_EQ(stamp(step).at("key"), step_key(step, place_));
  EXPECT_EQ(stamp(step).at("exit_status"), 0);
}

TEST_F(StepRun, TellsWhyACommandFailed) {
  EXPECT_EQ(run(shell("echo noise; echo 'smopt: steps/x.ply: no mesh' >&2; exit 3")).reason, "steps/x.ply: no mesh");
  EXPECT_EQ(run(shell("exit 7")).reason, "exit status 7");
  EXPECT_THAT(run(shell("kill -SEGV $$")).reason, HasSubstr("crashed (signal 11"));
  EXPECT_EQ(run(shell("exit 0")).status, "failed") << "without the file that it was to make";
}

TEST_F(StepRun, EndsACommandThatHangs) {
  Step step = shell("sleep 100");
  step.limits.seconds = 0.2;
  EXPECT_THAT(run(step).reason, MatchesRegex("not finished after .* s"));
  EXPECT_EQ(stamp(step).at("out_of_time"), true);
}

TEST_F(StepRun, AMethodThatIsNotInstalledIsNoFailure) {
  const StepOutcome outcome = run(shell("echo 'smopt: not installed: there is no octave' >&2; exit 1"));
  EXPECT_EQ(outcome.status, "not installed");
  EXPECT_EQ(outcome.reason, "there is no octave");
}

TEST_F(StepRun, NoIsAnAnswerWhereItMayBe) {
  Step step = shell("echo no > out; exit 1");
  EXPECT_EQ(run(step).status, "failed");
  step.may_say_no = true;
  EXPECT_EQ(run(step).status, "done");
}

TEST_F(StepRun, AMissingInputIsAReasonWithTheWayToGetIt) {
  Step step = shell("true");
  step.inputs = {"/nowhere/molecule.pqr"};
  step.hint = "the Debian package p brings it";
  EXPECT_THAT(run(step).reason, ::testing::AllOf(HasSubstr("/nowhere/molecule.pqr"), HasSubstr("the Debian package p brings it")));
}

TEST_F(StepRun, IsNotTriedWhereAPredecessorFailedAndTellsItsReason) {
  Step first = shell("echo 'smopt: too hard' >&2; exit 3");
  first.id = "molecule/initial.generate";
  run(first);
  Step second = shell("echo 2 > out");
  second.after = {first.id};
  EXPECT_EQ(run(second).reason, "too hard");
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out"));
}

TEST_F(StepRun, IsDoneAlreadyOnlyWithTheSameCommandInputsProgramAndOutputs) {
  const Step step = shell("cat in > out");
  EXPECT_FALSE(is_done_already(step));
  run(step);
  EXPECT_TRUE(is_done_already(step));
  EXPECT_FALSE(is_done_already(shell("cat in in > out")));
  static_cast<void>(folder_.file("out", "another\n"));
  EXPECT_FALSE(is_done_already(step)) << "the output was changed";
  run(step);
  static_cast<void>(folder_.file("in", "2\n"));
  EXPECT_FALSE(is_done_already(step)) << "the input was changed";
  run(step);
  std::filesystem::remove(folder_.path() / "out");
  EXPECT_FALSE(is_done_already(step)) << "the output is gone";
}

TEST_F(StepRun, WhatWasAskedToEndIsDoneAgain) {
  for (const char* line : {"kill -TERM $$", "exit 130", "exit 143"}) {
    const Step step = shell(line);
    EXPECT_TRUE(run(step).is_interrupted) << line;
    EXPECT_FALSE(is_done_already(step)) << line;
  }
  const Step failed = shell("exit 7");
  run(failed);
  EXPECT_TRUE(is_done_already(failed)) << "a failure of its own is remembered";
}

TEST_F(StepRun, OnlyAStepThatCouldUseAllThreadsIsToldHowManyThereAre) {
  place_.threads = 3;
  Step step = shell("echo \"$@\" > out");
  run(step);
  EXPECT_EQ(bytes_of(folder_.path() / "out"), "\n");
  step.needs.threads = kAllThreads;
  step.command.emplace_back("name");
  run(step);
  EXPECT_EQ(bytes_of(folder_.path() / "out"), "--threads 3\n");
  place_.threads = 2;
  EXPECT_TRUE(is_done_already(step)) << "the result does not depend on it";
}

TEST_F(StepRun, WhetherItEndsInTimeMayDependOnTheThreads) {
  Step step = shell("sleep 100");
  step.needs.threads = kAllThreads;
  step.command.emplace_back("name");
  step.limits.seconds = 0.2;
  place_.threads = 1;
  run(step);
  EXPECT_TRUE(is_done_already(step));
  place_.threads = 2;
  EXPECT_FALSE(is_done_already(step));
}

TEST_F(StepRun, TetgenIsAProgramOfItsOwn) {
  Step step = shell("cat in > out");
  const std::string key = step_key(step, place_);
  step.rule = "tetrahedralize";
  const std::string with_tetgen = step_key(step, place_);
  EXPECT_NE(place_.tetgen_sha256, "");
  place_.tetgen_sha256 = "another";
  EXPECT_NE(step_key(step, place_), with_tetgen);
  step.rule = "improve";
  EXPECT_EQ(step_key(step, place_), key);
}

TEST_F(StepRun, RunsTheVeryProgramThatRunsIt) {
  const StepPlace own = step_place(folder_.path(), {});
  EXPECT_TRUE(std::filesystem::equivalent(own.program, "/proc/self/exe"));
  EXPECT_EQ(own.program_sha256, sha256_of_file("/proc/self/exe"));
}

TEST_F(StepRun, AnotherProgramsResultsAreNotTaken) {
  Step step = shell("cat in > out");
  step.command = {kThisProgram, "-c", "cat in > out"};
  run(step);
  EXPECT_TRUE(is_done_already(step));
  place_.program_sha256 = "another";
  EXPECT_FALSE(is_done_already(step));
}

TEST_F(StepRun, AFailureIsRememberedAndAnAbsentProgramIsNot) {
  const Step fails = shell("exit 3"), absent = shell("echo 'smopt: not installed: x'; exit 1");
  run(fails);
  EXPECT_TRUE(is_done_already(fails));
  run(absent);
  EXPECT_FALSE(is_done_already(absent));
}

TEST_F(StepRun, AStampThatIsNoneIsNotTaken) {
  const Step step = shell("cat in > out");
  run(step);
  for (const char* text : {"", "{", "[]", "{}", R"({"status": 1, "reason": 2, "key": 3})"}) {
    static_cast<void>(folder_.file(stamp_path(step), text));
    EXPECT_FALSE(is_done_already(step)) << text;
  }
}

TEST_F(StepRun, WhoCancelsLeavesNoStamp) {
  const Step step = shell("sleep 100");
  EXPECT_THAT([&] { run_step(step, place_, [](std::string_view, double) { return false; }); }, Throws<Cancelled>());
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / stamp_path(step)));
}

}  // namespace
}  // namespace smopt::experiments
