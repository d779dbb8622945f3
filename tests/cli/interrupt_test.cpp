#include <gmock/gmock.h>

#include <csignal>
#include <thread>

#include "tests/cli/smopt_program.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using ::testing::ElementsAre;

constexpr int kInterrupted = 130;

/// Longest time from a signal to the end of the program: far above what it takes, far below what the task would have taken.
constexpr std::chrono::seconds kSoon{60};

/// Waits until the program has worked for so long (processor time, so that a busy machine does not matter): it has read its input then.
void let_it_work(RunningProgram& program, double cpu_seconds) {
  while (program.is_running() && program.cpu_seconds() < cpu_seconds) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

class Interrupt : public ::testing::TestWithParam<int> {};

TEST_P(Interrupt, StopsALongImprovementWithoutAFile) {
  const TemporaryFolder folder;
  const std::string mesh = put_mesh(folder, "in.off", icosphere(3));
  RunningProgram program(smopt_program(), {"improve", mesh, "-o", path_in(folder, "out.off"), "--report", path_in(folder, "report.json"),
                                           "--method", "laplacian", "--rounds", "2000000000"});
  let_it_work(program, 0.3);
  ASSERT_TRUE(program.is_running());
  program.send(GetParam());
  const ProgramResult r = program.wait(kSoon);
  EXPECT_FALSE(r.is_out_of_time);
  EXPECT_EQ(r.exit_code, kInterrupted) << r.err;
  EXPECT_THAT(files_in(folder), ElementsAre("in.off"));
}

TEST_P(Interrupt, StopsGuardedSmoothingAndKeepsTheOldFile) {
  const TemporaryFolder folder;
  const std::string mesh = put_mesh(folder, "in.off", rough_sphere(6));
  const std::string old = folder.file("out.off", "what was there before").string();
  // Nearly every triangle counts as bad, so that every round moves nearly everything.
  RunningProgram program(smopt_program(), {"improve", mesh, "-o", old, "--rounds", "1000000", "--edge-ratio", "0.99", "--min-angle", "59",
                                           "--bad-angles", "ignore"});
  let_it_work(program, 0.5);
  ASSERT_TRUE(program.is_running());
  program.send(GetParam());
  const ProgramResult r = program.wait(kSoon);
  EXPECT_FALSE(r.is_out_of_time);
  EXPECT_EQ(r.exit_code, kInterrupted) << r.err;
  EXPECT_EQ(bytes_of(old), "what was there before");
  EXPECT_THAT(files_in(folder), ElementsAre("in.off", "out.off"));
}

TEST_P(Interrupt, StopsASolverWithoutAFile) {
  const TemporaryFolder folder;
  const std::string mesh = put_mesh(folder, "in.off", icosphere(5, 2));
  const std::string ion = folder.file("in.pqr", "ATOM 1 NA NA 1 0.0 0.0 0.5 1.0 2.0\n").string();
  // All pairs one by one, and more digits than doubles have.
  RunningProgram program(smopt_program(), {"solvate", mesh, ion, "-o", path_in(folder, "out.vtp"), "--direct", "--residual", "1e-30",
                                           "--max-iterations", "1000000"});
  let_it_work(program, 1.0);
  ASSERT_TRUE(program.is_running());
  program.send(GetParam());
  const ProgramResult r = program.wait(kSoon);
  EXPECT_FALSE(r.is_out_of_time);
  EXPECT_EQ(r.exit_code, kInterrupted) << r.err;
  EXPECT_THAT(files_in(folder), ElementsAre("in.off", "in.pqr"));
}

TEST_P(Interrupt, StopsEveryCommandThatWaitsForItsInput) {
  const TemporaryFolder folder;
  const std::string output = path_in(folder, "out.off");
  const std::vector<std::vector<std::string>> commands = {{"improve", "-", "-o", output},
                                                          {"measure", "-"},
                                                          {"convert", "-", output},
                                                          {"generate", "-", "-o", output},
                                                          {"tetrahedralize", "-", "-o", path_in(folder, "out.vtu")},
                                                          {"solvate", "-", "no.pqr", "-o", path_in(folder, "out.vtp")}};
  for (const auto& command : commands) {
    RunningProgram program(smopt_program(), command, {}, RunningProgram::Input::open_pipe);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));  // to where it reads; sooner, the test is easier and not wrong
    ASSERT_TRUE(program.is_running()) << command[0];
    program.send(GetParam());
    const ProgramResult r = program.wait(std::chrono::seconds(10));
    EXPECT_FALSE(r.is_out_of_time) << command[0];
    EXPECT_TRUE(r.exit_code == kInterrupted || r.signal == GetParam()) << command[0] << r.exit_code;
    EXPECT_EQ(files_in(folder).size(), 0U) << command[0];
  }
}

TEST_P(Interrupt, EndsTetGenToo) {
  const TemporaryFolder folder;
  const TemporaryFolder temporary;
  const std::string mesh = put_mesh(folder, "in.off", icosphere(6));
  setenv("TMPDIR", temporary.path().c_str(), 1);
  {
    RunningProgram program(smopt_program(), {"tetrahedralize", mesh, "-o", path_in(folder, "out.vtu"), "--switches", "pq1.1a0.0000001"});
    unsetenv("TMPDIR");
    while (program.is_running() && files_in(temporary).size() < 2) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_TRUE(program.is_running());
    program.send(GetParam());
    const ProgramResult r = program.wait(kSoon);
    EXPECT_FALSE(r.is_out_of_time);
    EXPECT_EQ(r.exit_code, kInterrupted) << r.err;
    EXPECT_THAT(files_in(folder), ElementsAre("in.off"));
  }
  EXPECT_THAT(files_in(temporary), ::testing::IsEmpty()) << "the worker's files";
}

INSTANTIATE_TEST_SUITE_P(Cli, Interrupt, ::testing::Values(SIGINT, SIGTERM),
                         [](const auto& signal) { return signal.param == SIGINT ? "Sigint" : "Sigterm"; });

}  // namespace
}  // namespace smopt::testing
