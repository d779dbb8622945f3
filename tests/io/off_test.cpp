#include "smopt/io/off.h"

#include <gmock/gmock.h>

#include "tests/io/rejection.h"

namespace smopt::testing {
namespace {

using ::testing::HasSubstr;

const std::string kPoints = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string kFaces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const TriangleMesh kMesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

std::string off_rejection(std::string_view content) {
  return mesh_rejection("a.off", content);
}

TEST(Off, IsWrittenAsOff) {
  EXPECT_EQ(format_off({{{0.1, -2, 1e30}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {}), "OFF\n3 1 0\n0.1 -2 1e+30\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(format_off({{{2.0 / 3, 1, 0}}, {}}, {.digits = 3}), "OFF\n1 0 0\n0.667 1 0\n");
}

TEST(Off, MayHaveCommentsBlankLinesAndCrLf) {
  std::string text = "# first\nOFF # keyword\n\n# counts\n4 4 6 # edges\n" + kPoints + "\n#faces\n" + kFaces + "# end\n\n";
  EXPECT_TRUE(is_bitwise_equal(mesh_in("a.off", text), kMesh));
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) text.insert(at, "\r");
  EXPECT_TRUE(is_bitwise_equal(mesh_in("a.off", text), kMesh));
}

TEST(Off, MayHaveTheCountsOnTheKeywordsLine) {
  EXPECT_TRUE(is_bitwise_equal(mesh_in("a.off", "OFF 4 4 0\n" + kPoints + kFaces), kMesh));
}

TEST(Off, MayLackTheLastNewlineAndTheNumberOfEdges) {
  EXPECT_TRUE(is_bitwise_equal(mesh_in("a.off", "OFF\n4 4\n" + kPoints + kFaces.substr(0, kFaces.size() - 1)), kMesh));
}

TEST(Off, MayHaveColoursAndNormals) {
  EXPECT_TRUE(
      is_bitwise_equal(mesh_in("a.off", "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 255\n3 0 1 2 0.5 0.5 0.5\n"),
                       {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
  EXPECT_EQ(mesh_in("a.off", "CNOFF 1 0 0\n1 2 3 0 0 1 9 9 9 9\n").points.front(), Vec3(1, 2, 3));
}

TEST(Off, ReadsEveryWayToWriteANumber) {
  EXPECT_TRUE(is_bitwise_equal(mesh_in("a.off", "OFF\n2 0 0\n+1 1.e1 .5\n-1E-1\t1e-400 \t-0\n"), {{{1, 10, 0.5}, {-0.1, 0, -0.0}}, {}}));
  EXPECT_TRUE(mesh_in("a.off", "OFF\n1 0 0\nnan -inf INFINITY\n").points.front().hasNaN());
}

TEST(Off, AMeshOfNothingIsAMesh) {
  EXPECT_TRUE(is_bitwise_equal(mesh_in("a.off", "OFF\n0 0 0\n"), {}));
}

TEST(Off, RejectsAWrongHeader) {
  EXPECT_EQ(off_rejection("4 4 0\n" + kPoints + kFaces), "a.off:1: not an OFF file: it does not begin with OFF");
  EXPECT_EQ(off_rejection("4OFF\n4 4 0\n" + kPoints + kFaces), "a.off:1: not an OFF file: it does not begin with OFF");
  EXPECT_EQ(off_rejection("OFF BINARY\n"), "a.off:1: number of vertices is \"BINARY\", expected an integer");
  EXPECT_EQ(off_rejection("OFF\n0\n"), "a.off:2: number of faces is missing");
  EXPECT_EQ(off_rejection("OFF\n"), "a.off:1: the file ends before the numbers of vertices and faces");
}

TEST(Off, RejectsATruncatedFile) {
  EXPECT_EQ(off_rejection("OFF\n4 4 0\n" + kPoints + "3 0 2 1\n3 0 1 3         \n3 0 3 2\n"), "a.off:9: the file ends after 3 of 4 faces");
  EXPECT_EQ(off_rejection("OFF\n4 0 0\n0 0 0\n1 0 0            \n0 1 0\n"), "a.off:5: the file ends after 3 of 4 vertices");
  EXPECT_EQ(off_rejection("OFF\n1 0 0\n0    0   \n"), "a.off:3: coordinate z is missing");
  EXPECT_EQ(off_rejection("OFF\n4 1 0\n" + kPoints + "3   0   2\n"), "a.off:7: vertex index is missing");
}

TEST(Off, RejectsCountsThatAreTooLow) {
  EXPECT_EQ(off_rejection("OFF\n4 3 0\n" + kPoints + kFaces),
            "a.off:10: \"3\" follows 4 vertices and 3 faces, as many as the header counts");
  EXPECT_EQ(off_rejection("OFF\n3 4 0\n" + kPoints + kFaces), "a.off:6: face 0 has 0 vertices, expected 3");
}

TEST(Off, RejectsCountsThatAreTooHigh) {
  EXPECT_EQ(off_rejection("OFF\n4 5 0\n" + kPoints + kFaces), "a.off:10: the file ends after 4 of 5 faces");
  EXPECT_EQ(off_rejection("OFF\n5 3 0\n" + kPoints + kFaces), "a.off:7: vertex 4 has 4 columns, those before it have 3");
}

TEST(Off, RejectsTrailingGarbage) {
  EXPECT_THAT(off_rejection("OFF\n4 4 0\n" + kPoints + kFaces + "hello"), HasSubstr("a.off:11: \"hello\" follows"));
  EXPECT_THAT(off_rejection("OFF\n4 4 0\n" + kPoints + kFaces + std::string("\0\x01", 2)), HasSubstr("a.off:11: \"??\" follows"));
}

TEST(Off, RejectsAnIndexOutOfRange) {
  EXPECT_EQ(off_rejection("OFF\n4 1 0\n" + kPoints + "3 0 1 4\n"),
            "a.off:7: face 0: vertex index 4 is out of range, there are 4 vertices, counted from 0");
  EXPECT_EQ(off_rejection("OFF\n4 1 0\n" + kPoints + "3 0 1 -1\n"),
            "a.off:7: face 0: vertex index -1 is out of range, there are 4 vertices, counted from 0");
  EXPECT_EQ(off_rejection("OFF\n4 1 0\n" + kPoints + "3 0 1 4294967296\n"),
            "a.off:7: face 0: vertex index 4294967296 is out of range, there are 4 vertices, counted from 0");
}

TEST(Off, RejectsAFaceOfFourVertices) {
  EXPECT_EQ(off_rejection("OFF\n4 2 0\n" + kPoints + "3 0 1 2\n4 0 1 2 3\n"), "a.off:8: face 1 has 4 vertices, expected 3");
}

TEST(Off, RejectsWhatIsNoNumber) {
  EXPECT_EQ(off_rejection("OFF\n1 0 0\n0 1.5x 0\n"), "a.off:3: coordinate y is \"1.5x\", expected a number");
  EXPECT_EQ(off_rejection("OFF\n1 0 0\n0 0 1,5\n"), "a.off:3: coordinate z is \"1,5\", expected a number");
  EXPECT_EQ(off_rejection("OFF\n1 0 0\n1e999 0 0\n"), "a.off:3: coordinate x is \"1e999\", expected a number");
  EXPECT_EQ(off_rejection("OFF\n4 1 0\n" + kPoints + "3 0 1.0 2\n"), "a.off:7: vertex index is \"1.0\", expected an integer");
}

TEST(Off, RejectsAbsurdCountsBeforeItAllocates) {
  EXPECT_EQ(off_rejection("OFF\n1000000000000 4 0\n" + kPoints), "a.off:2: number of vertices is 1000000000000, more than 4294967294");
  EXPECT_EQ(off_rejection("OFF\n4294967295 4 0\n" + kPoints), "a.off:2: number of vertices is 4294967295, more than 4294967294");
  EXPECT_EQ(off_rejection("OFF\n4000000000 4 0\n" + kPoints),
            "a.off:2: number of vertices is 4000000000, but the file ends after 29 more bytes");
  EXPECT_EQ(off_rejection("OFF\n4 4000000000 0\n" + kPoints),
            "a.off:2: number of faces is 4000000000, but the file ends after 27 more bytes");
  EXPECT_EQ(off_rejection("OFF\n-4 4 0\n" + kPoints), "a.off:2: number of vertices is -4, less than none");
}

}  // namespace
}  // namespace smopt::testing
