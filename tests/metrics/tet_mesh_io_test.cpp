#include "metrics/tetgen/tet_mesh_io.h"

#include <gmock/gmock.h>

#include <cstring>
#include <sstream>

#include "metrics/tetgen/gmsh.h"
#include "metrics/tetgen/node_ele.h"
#include "metrics/tetgen/vtu.h"
#include "smopt/error.h"
#include "smopt/io/base64.h"
#include "tests/support/files.h"

namespace smopt::metrics {
namespace {

using namespace smopt::testing;
using ::testing::HasSubstr;

/// One tetrahedron, with a point that takes all digits.
TetMesh one_tetrahedron() {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1.0 / 3, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  mesh.boundary_faces = {{0, 2, 1}, {0, 1, 3}};
  mesh.surface_triangle = {4, 7};
  return mesh;
}

std::string array_bytes(const std::string& vtu, const std::string& name) {
  const std::size_t begin = vtu.find(">\n", vtu.find("Name=\"" + name + "\"")) + 2;
  return decode_base64(vtu.substr(begin, vtu.find('\n', begin) - begin)).value();
}

template <class T>
std::vector<T> array_values(const std::string& vtu, const std::string& name) {
  const std::string bytes = array_bytes(vtu, name);
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof(size));
  EXPECT_EQ(size, bytes.size() - sizeof(size));
  std::vector<T> values(size / sizeof(T));
  std::memcpy(values.data(), bytes.data() + sizeof(size), size);
  return values;
}

TEST(TetMeshIo, VtuHoldsPointsAndCells) {
  const std::string vtu = to_vtu(one_tetrahedron());
  EXPECT_THAT(vtu, HasSubstr("NumberOfPoints=\"4\" NumberOfCells=\"1\""));
  EXPECT_EQ(array_values<double>(vtu, "Points")[3], 1.0 / 3);
  EXPECT_THAT(array_values<std::int64_t>(vtu, "connectivity"), ::testing::ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(array_values<std::int64_t>(vtu, "offsets"), ::testing::ElementsAre(4));
  EXPECT_THAT(array_values<std::uint8_t>(vtu, "types"), ::testing::ElementsAre(10));
}

TEST(TetMeshIo, GmshHoldsNodesFacesAndTetrahedra) {
  const std::string msh = to_gmsh(one_tetrahedron());
  EXPECT_THAT(msh, ::testing::StartsWith("$MeshFormat\n4.1 0 8\n"));
  EXPECT_THAT(msh, HasSubstr("$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n0.3333333333333333 0 0\n"));
  EXPECT_THAT(msh, HasSubstr("$Elements\n2 3 1 3\n2 1 2 2\n1 1 3 2\n2 1 2 4\n3 1 4 1\n3 1 2 3 4\n$EndElements\n"));
}

TEST(TetMeshIo, NodeAndEleAreNumberedFromZeroAsTetGenWritesThem) {
  EXPECT_EQ(to_node(one_tetrahedron()), "4 3 0 0\n0 0 0 0\n1 0.3333333333333333 0 0\n2 0 1 0\n3 0 0 1\n");
  EXPECT_EQ(to_ele(one_tetrahedron()), "1 4 0\n0 0 1 2 3\n");
  EXPECT_EQ(to_face(one_tetrahedron()), "2 1\n0 0 2 1 5\n1 0 1 3 8\n");
}

TEST(TetMeshIo, TheEndingTellsTheFormat) {
  const TemporaryFolder folder;
  write_tet_mesh(folder.path() / "a.vtu", one_tetrahedron());
  write_tet_mesh(folder.path() / "b.msh", one_tetrahedron());
  write_tet_mesh(folder.path() / "c.ele", one_tetrahedron());
  EXPECT_EQ(bytes_of(folder.path() / "a.vtu"), to_vtu(one_tetrahedron()));
  EXPECT_EQ(bytes_of(folder.path() / "b.msh"), to_gmsh(one_tetrahedron()));
  EXPECT_EQ(bytes_of(folder.path() / "c.ele"), to_ele(one_tetrahedron()));
  EXPECT_EQ(bytes_of(folder.path() / "c.node"), to_node(one_tetrahedron()));
  EXPECT_EQ(bytes_of(folder.path() / "c.face"), to_face(one_tetrahedron()));
}

TEST(TetMeshIo, UnknownEndingsAreRefused) {
  EXPECT_FALSE(is_tet_mesh_format("a.off"));
  EXPECT_TRUE(is_tet_mesh_format("a.VTU"));
  EXPECT_THROW(write_tet_mesh("a.off", one_tetrahedron()), InvalidInput);
}

}  // namespace
}  // namespace smopt::metrics
