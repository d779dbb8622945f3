#include <gmock/gmock.h>

#include "smopt/io/mesh_io.h"
#include "tests/cli/smopt_program.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using ::testing::IsEmpty;

TEST(Convert, ThereAndBackGivesTheSameBytes) {
  const TemporaryFolder folder;
  const std::string original = put_mesh(folder, "in.off", rotated(icosphere(2, 12.3), {1, 2, 3}, 0.7));
  for (const std::string ending : {"ply", "obj", "vtp", "vert", "off.gz", "ply.gz"}) {
    const std::string other = path_in(folder, "other." + ending);
    const std::string back = path_in(folder, "back.off");
    EXPECT_EQ(run_smopt({"convert", original, other}).exit_code, 0) << ending;
    EXPECT_EQ(run_smopt({"convert", other, back}).exit_code, 0) << ending;
    EXPECT_EQ(bytes_of(back), bytes_of(original)) << ending;
  }
}

TEST(Convert, WritesAndReadsPipesAsOff) {
  const TemporaryFolder folder;
  const std::string original = put_mesh(folder, "in.off", cube());
  const ProgramResult out = run_smopt({"convert", original, "-"});
  EXPECT_EQ(out.exit_code, 0) << out.err;
  EXPECT_EQ(out.out, bytes_of(original));
  const std::string copy = path_in(folder, "copy.off");
  EXPECT_EQ(run_smopt({"convert", "-", copy}, out.out).exit_code, 0);
  EXPECT_EQ(bytes_of(copy), bytes_of(original));
}

TEST(Convert, RoundsToTheDigitsAskedFor) {
  const ProgramResult r =
      run_smopt({"convert", "-", "-", "--digits", "3"}, "OFF\n3 1 0\n1.23456 0 0\n0 12345.6 0\n0 0 -0.00123456\n3 0 1 2\n");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const TemporaryFolder folder;
  const TriangleMesh mesh = read_mesh(folder.file("out.off", r.out));
  EXPECT_EQ(mesh.points[0].x(), 1.23);
  EXPECT_EQ(mesh.points[1].y(), 12300);
  EXPECT_EQ(mesh.points[2].z(), -0.00123);
}

TEST(Convert, KeepsWhatIsBrokenButCanBeRead) {
  const std::string open = "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n7 7 7\n3 0 1 2\n";
  const ProgramResult r = run_smopt({"convert", "-", "-"}, open);
  EXPECT_EQ(r.exit_code, 0);
  EXPECT_EQ(r.out, open);
}

TEST(Convert, MayReplaceItsInput) {
  const TemporaryFolder folder;
  const std::string mesh = put_mesh(folder, "mesh.off", icosphere(1));
  const std::string before = bytes_of(mesh);
  EXPECT_EQ(run_smopt({"convert", mesh, mesh}).exit_code, 0);
  EXPECT_EQ(bytes_of(mesh), before);
  EXPECT_EQ(files_in(folder).size(), 1U);
}

TEST(Convert, APlaceThatCannotBeWrittenIsNamed) {
  const TemporaryFolder folder;
  const std::string mesh = put_mesh(folder, "mesh.off", icosphere(1));
  const ProgramResult r = run_smopt({"convert", mesh, path_in(folder, "no/such/folder/out.off")});
  EXPECT_EQ(r.exit_code, 3);
  EXPECT_THAT(r.err, ::testing::HasSubstr("no/such/folder/out.off"));
  EXPECT_THAT(r.out, IsEmpty());
}

}  // namespace
}  // namespace smopt::testing
