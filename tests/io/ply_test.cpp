#include "smopt/io/ply.h"

#include <gmock/gmock.h>

#include <bit>

#include "smopt/io/bytes.h"
#include "tests/io/rejection.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using ::testing::HasSubstr;

std::string ply_rejection(std::string_view content) {
  return mesh_rejection("a.ply", content);
}

const std::string kVertexHeader = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaceHeader = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kHeader = "ply\nformat ascii 1.0\ncomment made by hand\n" + kVertexHeader + kFaceHeader + "end_header\n";
const TriangleMesh kMesh = {{{0, 0, 0.5}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};

template <class T>
void append(std::string& out, T value, std::endian order) {
  std::string bytes;
  append_little_endian(bytes, value);
  if (order == std::endian::big) std::reverse(bytes.begin(), bytes.end());
  out += bytes;
}

/// kMesh in binary, with properties, types and elements that only some writers use.
std::string binary_with_extras(std::endian order) {
  std::string out = "ply\nformat binary_";
  out += order == std::endian::big ? "big" : "little";
  out +=
      "_endian 1.0\nobj_info none\nelement camera 1\nproperty list uint8 int16 path\nproperty double zoom\n"
      "element vertex 3\nproperty uchar red\nproperty float32 x\nproperty double y\nproperty int16 z2\nproperty float z\n"
      "element face 1\nproperty list ushort uint vertex_index\nproperty list uchar float uv\nend_header\n";
  append(out, std::uint8_t{2}, order);
  append(out, std::int16_t{-5}, order);
  append(out, std::int16_t{6}, order);
  append(out, 2.5, order);
  for (const Vec3& p : kMesh.points) {
    append(out, std::uint8_t{10}, order);  // a newline, which is none here
    append(out, static_cast<float>(p.x()), order);
    append(out, p.y(), order);
    append(out, std::int16_t{-1}, order);
    append(out, static_cast<float>(p.z()), order);
  }
  append(out, std::uint16_t{3}, order);
  for (const VertexId v : kMesh.triangles[0]) append(out, v, order);
  append(out, std::uint8_t{1}, order);
  append(out, 0.25F, order);
  return out;
}

TEST(Ply, IsReadFromText) {
  EXPECT_TRUE(is_bitwise_equal(mesh_in("a.ply", kHeader + "0 0 0.5\n1 0 0\n0 1 0\n3 0 1 2\n"), kMesh));
}

TEST(Ply, IsReadFromEitherByteOrder) {
  EXPECT_TRUE(is_bitwise_equal(mesh_in("a.ply", binary_with_extras(std::endian::little)), kMesh));
  EXPECT_TRUE(is_bitwise_equal(mesh_in("a.ply", binary_with_extras(std::endian::big)), kMesh));
}

TEST(Ply, PassesOverOtherPropertiesAndElementsInText) {
  EXPECT_TRUE(is_bitwise_equal(
      mesh_in(
          "a.ply",
          "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty double x\r\nproperty uchar red\r\nproperty int y\r\nproperty float z\r\n"
          "element edge 1\r\nproperty int vertex1\r\nproperty int vertex2\r\nelement face 1\r\nproperty list uchar uint vertex_indices\r\n"
          "property float quality\r\nend_header\r\n0 255 0 0.5\r\n1 0 0 0\r\n0 0 1 0\r\n0 1\r\n3 0 1 2 0.7\r\n"),
      kMesh));
}

TEST(Ply, IsWrittenAsLittleEndianDoubles) {
  const std::string bytes = format_ply(kMesh, {});
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  ASSERT_TRUE(bytes.starts_with(header));
  ASSERT_EQ(bytes.size(), header.size() + 3 * 3 * 8 + 1 + 3 * 4);
  EXPECT_EQ(bytes.substr(header.size() + 16, 8), std::string("\0\0\0\0\0\0\xe0\x3f", 8));  // 0.5
  EXPECT_EQ(bytes.substr(bytes.size() - 9), std::string("\0\0\0\0\1\0\0\0\2\0\0\0", 12).substr(3));
}

TEST(Ply, RejectsAWrongHeader) {
  EXPECT_EQ(ply_rejection("OFF\n"), "a.ply:1: not a PLY file: its first line is not ply");
  EXPECT_EQ(ply_rejection("ply\nformat ascii 2.0\n"), "a.ply:2: the format's version is not 1.0");
  EXPECT_EQ(ply_rejection("ply\nformat utf8 1.0\n"), "a.ply:2: format \"utf8\" is not ascii, binary_little_endian or binary_big_endian");
  EXPECT_EQ(ply_rejection("ply\nformat ascii 1.0\nproperty float x\n"), "a.ply:3: \"property\" is not expected in a PLY header");
  EXPECT_EQ(ply_rejection("ply\nformat ascii 1.0\nelement vertex 3\nproperty half x\n"), "a.ply:4: \"half\" is not a PLY type");
  EXPECT_EQ(ply_rejection("ply\nformat ascii 1.0\n" + kVertexHeader), "a.ply:6: the file ends before end_header");
  EXPECT_EQ(ply_rejection("ply\n" + kVertexHeader + "end_header\n"), "a.ply:6: the header has no line format");
  EXPECT_EQ(ply_rejection("ply\nformat ascii 1.0\n" + kFaceHeader + "end_header\n3 0 1 2\n"), "a.ply:5: the header has no element vertex");
  EXPECT_EQ(ply_rejection("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n"),
            "a.ply:5: element vertex does not have one x, one y and one z");
  EXPECT_EQ(ply_rejection("ply\nformat ascii 1.0\n" + kVertexHeader + "element face 1\nproperty int vertex_indices\nend_header\n"),
            "a.ply:9: element face does not have one list vertex_indices");
}

TEST(Ply, RejectsATruncatedFile) {
  EXPECT_EQ(ply_rejection(kHeader + "0 0 0.5\n1 0 0\n0 1 0\n"),
            "a.ply:13: the header counts 1 of element face, more than the rest of the file has room for");
  EXPECT_EQ(ply_rejection(kHeader + "0 0 0.5     \n1 0 0   \n"), "a.ply:12: the file ends after 2 of 3 vertex lines");
  const std::string binary = format_ply(tetrahedron(), {});
  EXPECT_EQ(ply_rejection(binary.substr(0, binary.size() - 1)), "a.ply: the file ends after 3 of 4 face elements");
  EXPECT_EQ(ply_rejection(binary.substr(0, binary.find("end_header\n") + 11 + 95)),
            "a.ply: the header counts 4 of element vertex, more than the rest of the file has room for");
}

TEST(Ply, RejectsCountsThatAreTooLow) {
  EXPECT_EQ(ply_rejection(kHeader + "0 0 0.5\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n"),
            "a.ply:15: \"3\" follows the last element that the header counts");
  EXPECT_EQ(ply_rejection(format_ply(kMesh, {}) + "abc"), "a.ply: 3 bytes follow the last element that the header counts");
}

TEST(Ply, RejectsCountsThatAreTooHigh) {
  std::string text = kHeader + "0 0 0.5\n1 0 0\n0 1 0\n3 0 1 2\n";
  text.replace(text.find("vertex 3"), 8, "vertex 4");
  EXPECT_EQ(ply_rejection(text), "a.ply:14: more values than the element has properties");
}

TEST(Ply, RejectsAbsurdCountsBeforeItAllocates) {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string start = "ply\nformat " + format + " 1.0\n";
    const std::string rest = "property double x\nproperty double y\nproperty double z\nend_header\n0 0 0\n";
    EXPECT_EQ(ply_rejection(start + "element vertex 1000000000000\n" + rest),
              "a.ply:3: element vertex is counted 1000000000000, more than 4294967294");
    EXPECT_EQ(ply_rejection(start + "element vertex -1\n" + rest), "a.ply:3: element vertex is counted -1, less than none");
    EXPECT_THAT(ply_rejection(start + "element vertex 4000000000\n" + rest),
                HasSubstr("the header counts 4000000000 of element vertex, more than the rest of the file"));
    EXPECT_THAT(ply_rejection(start + "element void 4000000000\n" + "element vertex 1\n" + rest),
                HasSubstr("element void has no property"));
  }
}

TEST(Ply, RejectsAnIndexOutOfRange) {
  EXPECT_EQ(ply_rejection(kHeader + "0 0 0.5\n1 0 0\n0 1 0\n3 0 1 3\n"),
            "a.ply:14: face 0: vertex index 3 is out of range, there are 3 vertices, counted from 0");
  TriangleMesh mesh = kMesh;
  mesh.triangles[0][2] = 0xFFFFFFFF;
  EXPECT_EQ(ply_rejection(format_ply(mesh, {})), "a.ply: face 0: vertex index -1 is out of range, there are 3 vertices, counted from 0");
}

TEST(Ply, RejectsAFaceOfFourVertices) {
  EXPECT_EQ(ply_rejection(kHeader + "0 0 0.5\n1 0 0\n0 1 0\n4 0 1 2 0\n"), "a.ply:14: face 0 has 4 vertices, expected 3");
  std::string binary = format_ply(kMesh, {});
  binary[binary.size() - 13] = 4;
  EXPECT_EQ(ply_rejection(binary), "a.ply: face 0 has 4 vertices, expected 3");
}

TEST(Ply, RejectsWhatIsNoNumber) {
  EXPECT_EQ(ply_rejection(kHeader + "0 0 x\n1 0 0\n0 1 0\n3 0 1 2\n"), "a.ply:11: value is \"x\", expected a number");
}

}  // namespace
}  // namespace smopt::testing
