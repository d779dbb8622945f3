#include <gmock/gmock.h>

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

}  // namespace
}  // namespace smopt::testing
