#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/smopt_program.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A sphere with a vertex next to another, too near for TetGen to tell them apart.
TriangleMesh sphere_with_near_duplicate() {
  TriangleMesh mesh = icosphere(2);
  const auto [a, b, c] = mesh.triangles.front();
  const auto near = static_cast<VertexId>(mesh.points.size());
  mesh.points.push_back(mesh.points[a] + 1e-10 * (mesh.points[b] + mesh.points[c] - 2 * mesh.points[a]));
  mesh.triangles.erase(mesh.triangles.begin());
  mesh.triangles.insert(mesh.triangles.end(), {{a, b, near}, {b, c, near}, {c, a, near}});
  return mesh;
}

TEST(Tetrahedralize, SucceedsOnASphere) {
  const TemporaryFolder folder;
  const ProgramResult r = run_smopt({"tetrahedralize", put_mesh(folder, "in.off", icosphere(2))});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.out, StartsWith("success: "));
  EXPECT_THAT(files_in(folder), ElementsAre("in.off"));
}

TEST(Tetrahedralize, JsonHasTheKeysOfTheContract) {
  const json contract = json::parse(R"({"status": "", "reason": null, "code": 0, "switches": "", "tetrahedra": 0, "seconds": 0.0,
                                        "peak_memory_mb": 0.0, "tetgen_version": ""})");
  const TemporaryFolder folder;
  for (const auto& [mesh, status, code] : {std::tuple(icosphere(2), "success", 0), std::tuple(sphere_with_near_duplicate(), "failed", 1)}) {
    const ProgramResult r = run_smopt({"tetrahedralize", put_mesh(folder, "in.off", mesh), "--json", "--switches", "pY"});
    EXPECT_EQ(r.exit_code, code) << r.out;
    const json answer = json::parse(r.out);
    EXPECT_EQ(why_not_shaped_like(contract, answer), "");
    EXPECT_EQ(answer["status"], status);
    EXPECT_EQ(answer["switches"], "pY");
  }
}

TEST(Tetrahedralize, AnIntersectingPairExitsWith1AndTheReason) {
  const TemporaryFolder folder;
  const std::string crossing = put_mesh(folder, "in.off", crossing_spheres());
  const ProgramResult r = run_smopt({"tetrahedralize", crossing, "-o", path_in(folder, "out.vtu")});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_EQ(r.signal, 0);
  EXPECT_THAT(r.out, AllOf(StartsWith("failed: "), HasSubstr("intersect")));
  EXPECT_THAT(files_in(folder), ElementsAre("in.off"));
}

TEST(Tetrahedralize, NearDuplicatePointsExitWith1AndTheReason) {
  const TemporaryFolder folder;
  const std::string mesh = put_mesh(folder, "in.off", sphere_with_near_duplicate());
  const ProgramResult r = run_smopt({"tetrahedralize", mesh, "-o", path_in(folder, "out.msh")});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_THAT(r.out, AllOf(StartsWith("failed: "), HasSubstr("near-duplicate points")));
  EXPECT_THAT(files_in(folder), ElementsAre("in.off"));
}

TEST(Tetrahedralize, NoisyMeshesOfEveryKindNeverEndTheProgram) {
  const TemporaryFolder folder;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const ProgramResult r = run_smopt({"tetrahedralize", put_mesh(folder, "in.off", noisy(icosphere(3), 0.15, seed))});
    EXPECT_EQ(r.exit_code, 1) << "seed " << seed << r.err;
    EXPECT_THAT(r.out, StartsWith("failed: ")) << "seed " << seed;
  }
}

TEST(Tetrahedralize, WritesTheFormatsOfOthers) {
  const TemporaryFolder folder;
  const std::string mesh = put_mesh(folder, "in.off", icosphere(1));
  EXPECT_EQ(run_smopt({"tetrahedralize", mesh, "-o", path_in(folder, "out.vtu")}).exit_code, 0);
  EXPECT_THAT(bytes_of(path_in(folder, "out.vtu")), HasSubstr("UnstructuredGrid"));
  EXPECT_EQ(run_smopt({"tetrahedralize", mesh, "-o", path_in(folder, "out.msh")}).exit_code, 0);
  EXPECT_THAT(bytes_of(path_in(folder, "out.msh")), StartsWith("$MeshFormat\n4.1 "));
  EXPECT_EQ(run_smopt({"tetrahedralize", mesh, "-o", path_in(folder, "out.node")}).exit_code, 0);
  const std::string nodes = bytes_of(path_in(folder, "out.node"));
  EXPECT_GE(std::stoul(nodes.substr(nodes.find_first_of("0123456789"))), icosphere(1).vertex_count());
  EXPECT_THAT(files_in(folder), ::testing::IsSupersetOf({"out.node", "out.ele"}));
}

TEST(Tetrahedralize, TheTimeLimitIsAReason) {
  const TemporaryFolder folder;
  const ProgramResult r = run_smopt({"tetrahedralize", put_mesh(folder, "in.off", icosphere(5)), "--time-limit", "0.01"});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_THAT(r.out, HasSubstr("time limit"));
}

TEST(Tetrahedralize, APlaceThatCannotBeWrittenIsNamedBeforeTetGenIsAsked) {
  const TemporaryFolder folder;
  const ProgramResult r =
      run_smopt({"tetrahedralize", put_mesh(folder, "in.off", crossing_spheres()), "-o", path_in(folder, "no/such/folder/out.vtu")});
  EXPECT_EQ(r.exit_code, 3) << r.out;
  EXPECT_THAT(r.err, HasSubstr("no/such/folder/out.vtu"));
}

}  // namespace
}  // namespace smopt::testing
