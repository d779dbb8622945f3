#include "smopt/io/obj.h"

#include <gmock/gmock.h>

#include "tests/io/rejection.h"

namespace smopt::testing {
namespace {

std::string obj_rejection(std::string_view content) {
  return mesh_rejection("a.obj", content);
}

const std::string kPoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const TriangleMesh kMesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};

TEST(Obj, ReadsEveryFormOfAnIndex) {
  for (const std::string face : {"f 1 2 3", "f 1/7 2/8 3/9", "f 1/7/4 2/8/5 3/9/6", "f 1//4 2//5 3//6", "f -3 -2 -1", "f -3//-1 2 -1/1"})
    EXPECT_TRUE(is_bitwise_equal(mesh_in("a.obj", kPoints + face + "\n"), kMesh)) << face;
}

TEST(Obj, CountsBackwardsFromTheVerticesReadSoFar) {
  const TriangleMesh mesh = mesh_in("a.obj", kPoints + "f -3 -2 -1\nv 5 5 5\nf -3 -2 -1\n");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 2, 3}}));
}

TEST(Obj, AFaceMayComeBeforeItsVertices) {
  EXPECT_TRUE(is_bitwise_equal(mesh_in("a.obj", "f 1 2 3\n" + kPoints), kMesh));
}

TEST(Obj, PassesOverOtherStatements) {
  EXPECT_TRUE(is_bitwise_equal(mesh_in("a.obj",
                                       "# made by hand\nmtllib a.mtl\no thing\ng part\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\n"
                                       "vn 0 0 1\nvt 0 0\nusemtl red\ns off\nf 1 2 3 # first\nl 1 2\np 1\n"),
                               kMesh));
}

TEST(Obj, IsWrittenWithIndicesFromOne) {
  EXPECT_EQ(format_obj(kMesh, {}), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
}

TEST(Obj, RejectsWhatIsNoObj) {
  EXPECT_EQ(obj_rejection("OFF\n0 0 0\n"), "a.obj:1: \"OFF\" is not an OBJ statement");
  EXPECT_EQ(obj_rejection("# nothing\n"), "a.obj:1: the file has no vertices");
}

TEST(Obj, RejectsATruncatedFile) {
  EXPECT_EQ(obj_rejection(kPoints + "f 1 2"), "a.obj:4: face 0 has 2 vertices, expected 3");
  EXPECT_EQ(obj_rejection("v 0 0 0\nv 1 0"), "a.obj:2: coordinate z is missing");
}

TEST(Obj, RejectsAnIndexOutOfRange) {
  EXPECT_EQ(obj_rejection(kPoints + "f 1 2 4\nf 1 2 3\n"),
            "a.obj:4: face 0: vertex index 4 is out of range, there are 3 vertices, counted from 1");
  EXPECT_EQ(obj_rejection(kPoints + "f 1 2 -4\n"), "a.obj:4: face 0: vertex index -4 is out of range");
  EXPECT_EQ(obj_rejection(kPoints + "f 0 1 2\n"), "a.obj:4: face 0: vertex index 0 is out of range");
  EXPECT_EQ(obj_rejection(kPoints + "f 1 2 4294967298\n"), "a.obj:4: face 0: vertex index 4294967298 is out of range");
  EXPECT_EQ(obj_rejection(kPoints + "f 1 2 -9223372036854775808\n"), "a.obj:4: face 0: vertex index -9223372036854775808 is out of range");
}

TEST(Obj, RejectsAFaceOfFourVertices) {
  EXPECT_EQ(obj_rejection(kPoints + "v 1 1 0\nf 1 2 3\nf 1 2 4 3\n"), "a.obj:6: face 1 has 4 vertices, expected 3");
}

TEST(Obj, RejectsWhatIsNoNumber) {
  EXPECT_EQ(obj_rejection("v 0 zero 0\n"), "a.obj:1: coordinate y is \"zero\", expected a number");
  EXPECT_EQ(obj_rejection(kPoints + "f 1 b/2 3\n"), "a.obj:4: face 0: \"b/2\" is not an index");
}

}  // namespace
}  // namespace smopt::testing
