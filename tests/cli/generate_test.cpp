#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <numbers>

#include "smopt/io/mesh_io.h"
#include "tests/cli/smopt_program.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// One atom of radius 2 Å in the origin: its Gaussian surface is the sphere of radius 2 Å for every decay when the isovalue is 1.
constexpr const char* kIon = "ATOM      1  NA   NA     1       0.000   0.000   0.000  1.0000 2.0000\n";
constexpr double kIonRadius = 2;

TEST(Generate, OneAtomIsASphereOfItsRadius) {
  const TemporaryFolder folder;
  const std::string molecule = folder.file("ion.pqr", kIon).string();
  const std::string output = path_in(folder, "ion.off");
  const ProgramResult r = run_smopt({"generate", molecule, "-o", output, "--spacing", "0.1"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("1 atoms"));
  EXPECT_THAT(r.out, IsEmpty());
  const TriangleMesh mesh = read_mesh(output);
  EXPECT_THAT(mesh, IsClosedManifold());
  const double sphere = 4.0 / 3 * std::numbers::pi * kIonRadius * kIonRadius * kIonRadius;
  EXPECT_NEAR(enclosed_volume(mesh), sphere, 0.01 * sphere);
}

TEST(Generate, TheIsovalueEnclosesLessAsItGrows) {
  const TemporaryFolder folder;
  const std::string molecule = folder.file("ion.pqr", kIon).string();
  // exp(-d (r² - R²)) = c on the sphere of radius sqrt(R² - ln(c) / d).
  const double decay = 0.5;
  const double isovalue = 3;
  const ProgramResult r = run_smopt({"generate", molecule, "-o", "-", "--decay", "0.5", "--isovalue", "3", "--spacing", "0.1", "--quiet"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.err, IsEmpty());
  const double radius = std::sqrt(kIonRadius * kIonRadius - std::log(isovalue) / decay);
  for (const Vec3& p : read_mesh(folder.file("out.off", r.out)).points) EXPECT_NEAR(p.norm(), radius, 0.01);
}

TEST(Generate, TheMoleculeMayComeThroughAPipe) {
  const TemporaryFolder folder;
  const std::string molecule = folder.file("ion.pqr", kIon).string();
  const ProgramResult from_file = run_smopt({"generate", molecule, "-o", "-"});
  const ProgramResult from_pipe = run_smopt({"generate", "-", "-o", "-"}, kIon);
  EXPECT_EQ(from_pipe.exit_code, 0) << from_pipe.err;
  EXPECT_FALSE(from_file.out.empty());
  EXPECT_EQ(from_pipe.out, from_file.out);
}

TEST(Generate, AnErrorDividesCubesInsteadOfAUniformGrid) {
  const TemporaryFolder folder;
  const std::string molecule = folder.file("ion.pqr", kIon).string();
  const std::string output = path_in(folder, "ion.off");
  const ProgramResult r = run_smopt({"generate", molecule, "-o", output, "--error", "0.02", "--json", "--quiet"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const auto report = nlohmann::json::parse(r.out);
  EXPECT_EQ(report["sampling"]["kind"], "adaptive");
  EXPECT_EQ(report["options"]["error"], 0.02);
  EXPECT_LE(report["distance_to_level_set"]["largest"].get<double>(), 0.02);
  const TriangleMesh mesh = read_mesh(output);
  EXPECT_THAT(mesh, IsClosedManifold());
  for (const Vec3& p : mesh.points) EXPECT_NEAR(p.norm(), kIonRadius, 0.02);
}

TEST(Generate, SpacingAndErrorAreTwoWaysOfWhichOneIsChosen) {
  const TemporaryFolder folder;
  const std::string molecule = folder.file("ion.pqr", kIon).string();
  const ProgramResult r = run_smopt({"generate", molecule, "-o", "-", "--error", "0.1", "--spacing", "0.5"});
  EXPECT_EQ(r.exit_code, 2);
  EXPECT_THAT(r.err, HasSubstr("--spacing"));
}

TEST(Generate, ProjectsTheVerticesOntoTheLevelSet) {
  const TemporaryFolder folder;
  const std::string molecule = folder.file("ion.pqr", kIon).string();
  const std::string output = path_in(folder, "ion.off");
  const ProgramResult r = run_smopt({"generate", molecule, "-o", output, "--project", "--json", "--quiet"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const auto report = nlohmann::json::parse(r.out);
  EXPECT_EQ(report["projection"]["arrived"], report["output"]["vertices"]);
  EXPECT_GT(report["projection"]["distance_before"]["largest"].get<double>(), 0.001);
  for (const Vec3& p : read_mesh(output).points) EXPECT_NEAR(p.norm(), kIonRadius, 1e-5);
}

TEST(Generate, ImprovesInOneCommandAsImproveDoesInTwo) {
  const std::filesystem::path molecule = apbs_molecule("misc/fas2.pqr");
  if (molecule.empty()) GTEST_SKIP() << "apbs-data is not installed";
  const TemporaryFolder folder;
  const std::string raw = path_in(folder, "raw.off");
  const std::string in_two = path_in(folder, "two.off");
  const std::string in_one = path_in(folder, "one.off");
  ASSERT_EQ(run_smopt({"generate", molecule.string(), "-o", raw}).exit_code, 0);
  ASSERT_EQ(run_smopt({"improve", raw, "-o", in_two}).exit_code, 0);
  const ProgramResult r = run_smopt({"generate", molecule.string(), "-o", in_one, "--improve", "--json", "--quiet"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(bytes_of(in_one), bytes_of(in_two));
  EXPECT_EQ(nlohmann::json::parse(r.out)["improvement"]["method"], "smopt");
}

/// A large atom with a small one in the middle of a hole: at decay 1 and these places a shell of atoms encloses a cavity.
std::string shell_of_atoms() {
  std::string pqr;
  int serial = 0;
  for (int i = -2; i <= 2; ++i) {
    for (int j = -2; j <= 2; ++j) {
      for (int k = -2; k <= 2; ++k) {
        if (std::max({std::abs(i), std::abs(j), std::abs(k)}) == 2)
          pqr += fmt::format("ATOM {} C RES 1 {:.3f} {:.3f} {:.3f} 0 1.5\n", ++serial, 1.5 * i, 1.5 * j, 1.5 * k);
      }
    }
  }
  return pqr + "ATOM 999 C RES 1 20.0 0.0 0.0 0 1.5\n";
}

TEST(Generate, KeepsTheComponentsThatAreAskedFor) {
  const TemporaryFolder folder;
  const std::string molecule = folder.file("shell.pqr", shell_of_atoms()).string();
  const std::string output = path_in(folder, "shell.off");
  for (const auto& [components, chi] : {std::pair{"all", 6}, std::pair{"outer", 4}, std::pair{"main", 2}}) {
    const ProgramResult r = run_smopt({"generate", molecule, "-o", output, "--components", components});
    ASSERT_EQ(r.exit_code, 0) << r.err;
    EXPECT_EQ(euler_characteristic(read_mesh(output)), chi) << components;
  }
  EXPECT_EQ(run_smopt({"generate", molecule, "-o", output, "--components", "some"}).exit_code, 2);
}

TEST(Generate, RaisesSmallRadiiUnlessToldNotTo) {
  const TemporaryFolder folder;
  const std::string molecule = folder.file("h.pqr", "ATOM 1 H RES 1 0 0 0 0 0.3\nATOM 2 C RES 1 9 0 0 0 2\n").string();
  const std::string output = path_in(folder, "h.off");
  const auto smallest_x = [&](const std::vector<std::string>& options) {
    std::vector<std::string> command = {"generate", molecule, "-o", output, "--spacing", "0.05"};
    command.insert(command.end(), options.begin(), options.end());
    const ProgramResult r = run_smopt(command);
    EXPECT_EQ(r.exit_code, 0) << r.err;
    double least = 0;
    for (const Vec3& p : read_mesh(output).points) least = std::min(least, p.x());
    return least;
  };
  EXPECT_NEAR(smallest_x({}), -0.6, 0.01);
  EXPECT_NEAR(smallest_x({"--min-radius", "0"}), -0.3, 0.01);
  EXPECT_NEAR(smallest_x({"--min-radius", "1"}), -1, 0.01);
}

TEST(Generate, TakesRadiiByElementWhereTheFileHasNoneAndSaysSo) {
  const TemporaryFolder folder;
  const std::string line = "ATOM      1  CA  ALA A   1       0.000   0.000   0.000  1.00  0.00           C\n";
  const std::string molecule = folder.file("c.pdb", line).string();
  const std::string output = path_in(folder, "c.off");
  for (const auto& [set, radius] : {std::pair{"bondi", 1.7}, std::pair{"amber", 1.908}}) {
    const ProgramResult r = run_smopt({"generate", molecule, "-o", output, "--radii", set, "--spacing", "0.1"});
    ASSERT_EQ(r.exit_code, 0) << r.err;
    EXPECT_THAT(r.err, HasSubstr("note: "));
    for (const Vec3& p : read_mesh(output).points) EXPECT_NEAR(p.norm(), radius, 0.01);
  }
}

TEST(Generate, RefusesWhatIsNoMoleculeOrHasNoSurfaceAndWritesNothing) {
  const TemporaryFolder folder;
  const std::string ion = folder.file("ion.pqr", kIon).string();
  const std::string negative = folder.file("negative.pqr", "ATOM 1 C RES 1 0 0 0 0 -1\n").string();
  const std::string nan = folder.file("nan.xyzr", "0 0 0 nan\n").string();
  const std::string wrong = folder.file("molecule.xyz", "1\n\nC 0 0 0\n").string();
  const std::string output = path_in(folder, "out.off");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{ion, "--isovalue", "50"}, "never reaches the isovalue 50"},
      {{negative}, "negative.pqr:1"},
      {{nan}, "nan.xyzr:1"},
      {{wrong}, "not a molecule format"},
      {{ion, "--spacing", "0.0005", "--max-memory", "1GB"}, "memory"},
      {{ion, "--error", "0.00001", "--max-memory", "1GB"}, "memory"},
  };
  for (const auto& [arguments, message] : cases) {
    std::vector<std::string> command = {"generate", "-o", output};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const ProgramResult r = run_smopt(command);
    EXPECT_EQ(r.exit_code, 3) << message << ": " << r.err;
    EXPECT_THAT(r.err, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(output)) << message;
  }
}

}  // namespace
}  // namespace smopt::testing
