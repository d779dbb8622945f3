#include <gmock/gmock.h>

#include <filesystem>

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
using smopt::testing::TemporaryFolder;
using smopt::testing::without_times;

constexpr const char* kSnakemake = "/usr/bin/snakemake";
constexpr const char* kMethods[] = {"initial", "smopt", "laplacian"};

/// The run's molecules: four atoms that are meshed, and a file that is none, whose cases fail.
fs::path molecules_in(const TemporaryFolder& folder) {
  fs::create_directories(folder.path() / "data");
  static_cast<void>(folder.file("data/four.pqr",
                                "ATOM 1 N  ALA 1 0.0 0.0 0.0 -0.3 1.8\n"
                                "ATOM 2 CA ALA 1 1.4 0.2 0.1  0.1 1.9\n"
                                "ATOM 3 C  ALA 1 2.1 1.5 0.3  0.5 1.9\n"
                                "ATOM 4 O  ALA 1 1.6 2.6 0.7 -0.5 1.6\n"));
  static_cast<void>(folder.file("data/none.pqr", "nothing of the kind\n"));
  return folder.path() / "data";
}

TEST(Workflow, SnakemakeGivesTheRecordsOfTheProgramsOwnRunner) {
  if (!fs::exists(kSnakemake)) GTEST_SKIP() << "Debian's snakemake is not installed";
  const TemporaryFolder folder;
  const fs::path data = molecules_in(folder), own = folder.path() / "own", planned = folder.path() / "planned";
  const auto reproduce = [&](const fs::path& directory, const std::string& flag) {
    return run_program(SMOPT_PROGRAM, {"reproduce", "-o", directory.string(), "--data", data.string(), "--molecules", "four,none",
                                       "--methods", "initial,smopt,laplacian", "--repeats", "1", flag});
  };
  ASSERT_EQ(reproduce(own, "--resume").exit_code, 0);
  ASSERT_EQ(reproduce(planned, "--plan").exit_code, 0);
  const auto snakemake = [&](std::vector<std::string> how) {
    how.insert(how.end(), {"-s", SMOPT_SNAKEFILE, "--directory", planned.string(), "--config", std::string("smopt=") + SMOPT_PROGRAM});
    return run_program(kSnakemake, how);
  };
  EXPECT_EQ(snakemake({"--dry-run", "--cluster", "sh", "--jobs", "2"}).exit_code, 0) << "as on a cluster, without --cores";
  const ProgramResult ran = snakemake({"--cores", "2"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  for (const char* molecule : {"four", "none"}) {
    for (const char* method : kMethods) {
      const auto record = [&](const fs::path& directory) { return Json::parse(bytes_of(record_path(directory, molecule, method))); };
      EXPECT_EQ(without_times(record(planned)).dump(1), without_times(record(own)).dump(1)) << molecule << " " << method;
      EXPECT_EQ(record(own).at("status"), molecule == std::string("four") ? "done" : "failed");
    }
  }
}

TEST(Workflow, SnakemakeDoesAgainWhatDependsOnAnOptionOrAMoleculeThatHasChanged) {
  if (!fs::exists(kSnakemake)) GTEST_SKIP() << "Debian's snakemake is not installed";
  const TemporaryFolder folder;
  const fs::path data = molecules_in(folder), planned = folder.path() / "planned";
  const auto run_with = [&](const std::string& flag, const std::string& value) {
    ASSERT_EQ(run_program(SMOPT_PROGRAM, {"reproduce", "-o", planned.string(), "--data", data.string(), "--molecules", "four", "--methods",
                                          "initial,smopt", "--repeats", "1", "--plan", flag, value})
                  .exit_code,
              0);
    const ProgramResult ran = run_program(kSnakemake, {"-s", SMOPT_SNAKEFILE, "--directory", planned.string(), "--cores", "2", "--config",
                                                       std::string("smopt=") + SMOPT_PROGRAM});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
  };
  const auto record = [&](const char* method) { return Json::parse(bytes_of(record_path(planned, "four", method))); };
  run_with("--override", "smopt:rounds=3");
  const std::string initial = bytes_of(record_path(planned, "four", "initial"));
  EXPECT_EQ(record("smopt").at("options").at("rounds"), 3);
  run_with("--override", "smopt:rounds=4");
  EXPECT_EQ(record("smopt").at("options").at("rounds"), 4);
  EXPECT_EQ(bytes_of(record_path(planned, "four", "initial")), initial) << "which has nothing to do with it";
  static_cast<void>(folder.file("data/four.pqr", bytes_of(data / "four.pqr") + "ATOM 5 O  ALA 1 3.0 2.6 0.7 -0.5 1.6\n"));
  run_with("--override", "smopt:rounds=4");
  EXPECT_EQ(record("initial").at("molecule").at("atoms"), 5);
}

}  // namespace
}  // namespace smopt::experiments
