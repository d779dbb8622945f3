#include "smopt/io/stl.h"

#include <gmock/gmock.h>

#include "smopt/io/bytes.h"
#include "tests/io/rejection.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using ::testing::HasSubstr;

std::string stl_rejection(std::string_view content) {
  return mesh_rejection("a.stl", content);
}

std::string facet(std::string_view a, std::string_view b, std::string_view c) {
  std::string text = "  facet normal 0 0 1\n    outer loop\n";
  for (const std::string_view corner : {a, b, c}) text += "      vertex " + std::string(corner) + "\n";
  return text + "    endloop\n  endfacet\n";
}
const std::string kText = "solid thing\n" + facet("0 0 0", "1 0 0", "0 1 0") + facet("1 0 0", "1 1 0", "0 1 -0") + "endsolid thing\n";
const TriangleMesh kMesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};

TEST(Stl, GivesTheSameFloatsBack) {
  TriangleMesh mesh = noisy(icosphere(3, 40), 0.5, 5);
  for (Vec3& p : mesh.points) p = (p * 1024).array().round() / 1024;  // 16 bits: floats hold them exactly
  const TriangleMesh read = mesh_in("a.stl", format_stl(mesh, {}));
  ASSERT_EQ(read.points.size(), mesh.points.size());
  ASSERT_EQ(read.triangles.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(read.points[read.triangles[i][k]], mesh.points[mesh.triangles[i][k]]);
  EXPECT_THAT(read, IsClosedManifold());
}

TEST(Stl, IsWrittenAsFloat32WithNormals) {
  const std::string bytes = format_stl({{{0.1, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}}, {});
  ASSERT_EQ(bytes.size(), 84U + 50U);
  EXPECT_NE(bytes.substr(0, 5), "solid");
  EXPECT_EQ(load<std::uint32_t>(&bytes[80], std::endian::little), 1U);
  EXPECT_EQ(load<float>(&bytes[84 + 8], std::endian::little), 1.0F);   // the normal's z
  EXPECT_EQ(load<float>(&bytes[84 + 12], std::endian::little), 0.1F);  // the first corner's x
}

TEST(Stl, MergesExactlyEqualPositionsOnly) {
  EXPECT_TRUE(is_bitwise_equal(mesh_in("a.stl", kText), kMesh));  // 0 and -0 are equal
  const std::string apart = "solid\n" + facet("0 0 0", "1 0 0", "0 1 0") + facet("1.0000000000000002 0 0", "1 1 0", "0 1 0") + "endsolid\n";
  EXPECT_EQ(mesh_in("a.stl", apart).points.size(), 5U);
}

TEST(Stl, ReadsTextOfSeveralSolidsInAnyCase) {
  std::string text = kText + kText;
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const TriangleMesh mesh = mesh_in("a.stl", text);
  EXPECT_EQ(mesh.points.size(), 4U);
  EXPECT_EQ(mesh.triangles.size(), 4U);
}

TEST(Stl, ReadsBinaryThatBeginsLikeText) {
  std::string bytes = format_stl(kMesh, {});
  bytes.replace(0, 5, "solid");
  EXPECT_EQ(mesh_in("a.stl", bytes).triangles, kMesh.triangles);
}

TEST(Stl, RejectsAWrongHeader) {
  EXPECT_EQ(stl_rejection("hello"), "a.stl: not an STL file: 5 bytes that do not begin with solid");
  EXPECT_EQ(stl_rejection("solid x\nvertex 0 0 0\n"), "a.stl:2: \"vertex\" where facet or endsolid is expected");
}

TEST(Stl, RejectsATruncatedFile) {
  const std::string binary = format_stl(kMesh, {});
  EXPECT_EQ(stl_rejection(binary.substr(0, 183)), "a.stl: the header counts 2 triangles, which take 184 bytes, and the file has 183");
  EXPECT_EQ(stl_rejection(binary.substr(0, 50)), "a.stl: not an STL file: 50 bytes that do not begin with solid");
  EXPECT_EQ(stl_rejection(kText.substr(0, kText.find("endsolid"))), "a.stl:15: the file ends before endsolid");
  EXPECT_EQ(stl_rejection(kText.substr(0, kText.find("endloop"))), "a.stl:7: the file ends before endloop");
}

TEST(Stl, RejectsCountsThatDoNotMatch) {
  std::string binary = format_stl(kMesh, {});
  EXPECT_EQ(stl_rejection(binary + "!"), "a.stl: the header counts 2 triangles, which take 184 bytes, and the file has 185");
  binary[80] = 3;
  EXPECT_EQ(stl_rejection(binary), "a.stl: the header counts 3 triangles, which take 234 bytes, and the file has 184");
  binary.replace(80, 4, "\xff\xff\xff\xff");
  EXPECT_EQ(stl_rejection(binary), "a.stl: the header counts 4294967295 triangles, which take 214748364834 bytes, and the file has 184");
  EXPECT_EQ(stl_rejection(kText + "hello\n"), "a.stl:17: \"hello\" where solid is expected");
}

TEST(Stl, RejectsAFaceOfFourVertices) {
  std::string text = kText;
  text.insert(text.find("    endloop"), "      vertex 1 1 1\n");
  EXPECT_EQ(stl_rejection(text), "a.stl:8: face 0 has 4 vertices, expected 3");
}

TEST(Stl, RejectsWhatIsNoNumber) {
  std::string text = kText;
  text.replace(text.find("1 0 0"), 5, "1 o 0");
  EXPECT_EQ(stl_rejection(text), "a.stl:5: coordinate y is \"o\", expected a number");
}

TEST(Stl, RejectsToWriteWhatAFloatCannotHold) {
  EXPECT_THROW(format_stl({{{1e39, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {}), InvalidInput);
}

}  // namespace
}  // namespace smopt::testing
