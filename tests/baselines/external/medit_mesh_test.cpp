#include "baselines/external/medit_mesh.h"

#include <gmock/gmock.h>

#include <limits>

#include "smopt/error.h"
#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

void expect_rejected(const std::string& text, const std::string& complaint) {
  EXPECT_THAT([&] { parse_medit(text, "x.mesh"); }, ThrowsMessage<InvalidInput>(HasSubstr(complaint))) << text;
}

TEST(MeditMesh, ReadsBackTheSameDoubles) {
  TriangleMesh mesh = noisy(icosphere(2), 0.1, 3);
  mesh.points[0] = Vec3(0.1, -1e-300, std::numeric_limits<double>::max());
  const TriangleMesh back = parse_medit(format_medit(mesh), "x.mesh");
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_EQ(back.triangles, mesh.triangles);
}

TEST(MeditMesh, TakesFieldsOnAnyLineAndPassesOverOtherSections) {
  const TriangleMesh mesh = parse_medit(
      "\n# by hand\nMeshVersionFormatted\n2\nDimension 3 Corners 2 1 3\nTriangles 1 1 2 3 7\nNormals\n1\n0 0 1e-1\nVertices\n3\n0 0 0 1\n"
      "1 0 0 1 0 1 0\n1\nRequiredVertices\n1\n2\nEnd\nVertices 9\n",
      "x.mesh");
  EXPECT_EQ(mesh.points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(MeditMesh, RejectsBrokenFilesWithTheLine) {
  const std::string head = "MeshVersionFormatted 2\nDimension 3\n";
  expect_rejected("", "x.mesh");
  expect_rejected("OFF\n", "x.mesh:1: expected MeshVersionFormatted");
  expect_rejected("MeshVersionFormatted 2\nDimension 2\n", "x.mesh:2: expected three dimensions");
  expect_rejected(head + "Vertices 1\n0 0 zero 0\n", "x.mesh:4");
  expect_rejected(head + "Vertices 2\n0 0 0 0\n", "x.mesh");
  expect_rejected(head + "Vertices 99999999\n0 0 0 0\n", "x.mesh:3");
  expect_rejected(head + "Vertices 1\n0 0 0 0\nTriangles 1\n1 1 2 0\n", "a triangle names vertex 2 of 1");
  expect_rejected(head + "Vertices 1\n0 0 0 0\nTriangles 1\n1 1 0 0\n", "x.mesh:6: no vertex has the number 0");
}

}  // namespace
}  // namespace smopt::baselines
