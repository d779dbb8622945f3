#include "baselines/vertex_target.h"

#include <gmock/gmock.h>

#include "smopt/error.h"
#include "smopt/io/mesh_io.h"
#include "tests/support/files.h"
#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;

std::optional<std::size_t> target_of(const std::map<std::string, std::string>& given) {
  return vertex_target(OptionValues(vertex_target_options(), given));
}

TEST(VertexTarget, IsNothingWhenNothingIsGiven) {
  EXPECT_EQ(target_of({}), std::nullopt);
  EXPECT_EQ(target_of({{"vertices", "0"}}), std::nullopt);
}

TEST(VertexTarget, IsTheNumberThatIsGiven) {
  EXPECT_EQ(target_of({{"vertices", "1234"}}), 1234U);
}

TEST(VertexTarget, CountsTheVerticesThatTheTrianglesOfTheFileUse) {
  const TemporaryFolder folder;
  TriangleMesh mesh = icosphere(1);
  mesh.points.emplace_back(9, 9, 9);
  const std::string file = (folder.path() / "mesh.ply").string();
  write_mesh(file, mesh);
  EXPECT_EQ(target_of({{"match", file}}), 42U);
}

TEST(VertexTarget, RejectsBothAtOnce) {
  EXPECT_THROW(target_of({{"vertices", "100"}, {"match", "mesh.off"}}), InvalidOption);
}

TEST(VertexTarget, RejectsFewerVerticesThanAnyClosedSurfaceHas) {
  EXPECT_THROW(target_of({{"vertices", "3"}}), InvalidOption);
  EXPECT_THROW(target_of({{"vertices", "-1"}}), InvalidOption);
  EXPECT_EQ(target_of({{"vertices", "4"}}), 4U);
}

TEST(VertexTarget, NamesTheFileThatCannotBeRead) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "none.off").string();
  EXPECT_THAT([&] { target_of({{"match", file}}); }, ::testing::ThrowsMessage<InvalidInput>(::testing::HasSubstr("none.off")));
}

}  // namespace
}  // namespace smopt::baselines
