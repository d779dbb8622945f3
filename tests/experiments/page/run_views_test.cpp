#include "experiments/page/run_views.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/experiments/made_records.h"
#include "tests/experiments/page/made_run.h"
#include "tests/experiments/page/unpacked_words.h"
#include "tests/support/files.h"
#include "tests/support/shapes.h"

namespace smopt::experiments {
namespace {

using ::testing::HasSubstr;
using testing::icosphere;
using testing::made_dataset;
using testing::made_record;
using testing::save_mesh;
using testing::save_record;
using testing::TemporaryFolder;

/// A run of one molecule with records of these methods, and no mesh.
RecordSet saved_records(const TemporaryFolder& folder, const std::vector<std::string>& methods, int pairs = 7) {
  for (const std::string& method : methods) {
    Json record = made_record(made_dataset("m"), method);
    record["metrics"]["after"]["intersecting_pairs"] = pairs;
    save_record(folder.path(), record);
  }
  return RecordSet::load(folder.path());
}

TEST(RunViews, OfARunWithoutMeshesAreNone) {
  const TemporaryFolder folder;
  const RunViews views = run_views(saved_records(folder, {"initial", "smopt"}), folder.path());
  EXPECT_TRUE(views.molecules.empty());
  EXPECT_TRUE(views.blobs.empty());
}

TEST(RunViews, HoldEveryMeshThatIsThere) {
  const TemporaryFolder folder;
  const RecordSet records = saved_records(folder, {"initial", "smopt", "hc"});
  save_mesh(folder.path(), "m", "initial", icosphere(1));
  save_mesh(folder.path(), "m", "without-cavities", icosphere(2));
  save_mesh(folder.path(), "m", "hc", icosphere(3));
  const Json meshes = run_views(records, folder.path()).molecules.at("m").at("meshes");
  ASSERT_EQ(meshes.size(), 3U);
  EXPECT_EQ(meshes.at("initial").at("triangles"), icosphere(1).triangle_count());
  EXPECT_EQ(meshes.at("without-cavities").at("triangles"), icosphere(2).triangle_count());
  EXPECT_EQ(meshes.at("hc").at("title"), "HC");
}

TEST(RunViews, KeepTrianglesThatTwoMeshesShareOnce) {
  const TemporaryFolder folder;
  const RecordSet records = saved_records(folder, {"initial", "hc"});
  save_mesh(folder.path(), "m", "initial", icosphere(2));
  save_mesh(folder.path(), "m", "hc", testing::noisy(icosphere(2), 0.1, 1));
  const RunViews views = run_views(records, folder.path());
  const Json& meshes = views.molecules.at("m").at("meshes");
  EXPECT_EQ(views.blobs.size(), 3U);
  EXPECT_EQ(meshes.at("initial").at("indices"), meshes.at("hc").at("indices"));
  EXPECT_NE(meshes.at("initial").at("positions"), meshes.at("hc").at("positions"));
}

/// A ball with one thin triangle, which is its worst place.
TriangleMesh ball_with_needle(FaceId where) {
  TriangleMesh mesh = icosphere(3);
  const Triangle thin = mesh.triangles[where];
  mesh.points[thin[0]] = 0.99 * mesh.points[thin[1]] + 0.01 * mesh.points[thin[0]];
  return mesh;
}

TEST(RunViews, OfALargeMoleculeShowOfEveryMethodTheBallAroundTheInitialMeshsWorstPlace) {
  const TemporaryFolder folder;
  const RecordSet records = saved_records(folder, {"initial", "hc"}, 0);
  const TriangleMesh initial = ball_with_needle(10), other = ball_with_needle(1200);
  save_mesh(folder.path(), "m", "initial", initial);
  save_mesh(folder.path(), "m", "hc", other);
  const Ball ball = ball_to_show(initial, 200, false);
  ASSERT_GT((ball.centre - ball_to_show(other, 200, false).centre).norm(), 0.5);

  const RunViews views = run_views(records, folder.path(), {.shown_triangles = 200});
  const Json& view = views.molecules.at("m");
  EXPECT_EQ(view.at("radius"), ball.radius);
  EXPECT_EQ(view.at("meshes").at("initial").at("shown_triangles"), 200);
  EXPECT_EQ(views.blobs[view.at("meshes").at("hc").at("positions")], mesh_view(other, ball, false).positions);
}

TEST(RunViews, LeaveOutWhatGoesBeyondTheBudgetAndSayIt) {
  const TemporaryFolder folder;
  const RecordSet records = saved_records(folder, {"initial", "smopt", "hc"});
  save_mesh(folder.path(), "m", "initial", icosphere(1));
  save_mesh(folder.path(), "m", "smopt", icosphere(4));
  save_mesh(folder.path(), "m", "hc", icosphere(1, 2));
  const RunViews views = run_views(records, folder.path(), {.packed_bytes = 4000});
  const Json& view = views.molecules.at("m");
  EXPECT_TRUE(view.at("meshes").contains("initial"));
  EXPECT_TRUE(view.at("meshes").contains("hc")) << "a smaller one after it still fits";
  EXPECT_THAT(view.at("left_out").at("smopt").at("why").get<std::string>(), HasSubstr("used up"));
  std::size_t bytes = 0;
  for (const std::string& blob : views.blobs) bytes += blob.size();
  EXPECT_LE(bytes, 4000U);
}

TEST(RunViews, LeaveOutAMeshThatCannotBeReadAndSayWhy) {
  const TemporaryFolder folder;
  const RecordSet records = saved_records(folder, {"initial", "hc"});
  save_mesh(folder.path(), "m", "initial", icosphere(1));
  std::ofstream(folder.path() / "meshes" / "m" / "hc.off") << "OFF\n3 1 0\n0 0\n";
  const Json view = run_views(records, folder.path()).molecules.at("m");
  EXPECT_THAT(view.at("left_out").at("hc").at("why").get<std::string>(), HasSubstr("hc.off"));
  EXPECT_EQ(view.at("meshes").size(), 1U);
}

TEST(RunViews, LookForPairsUnlessTheRecordSaysThatThereAreNone) {
  for (const int recorded : {0, 7}) {
    const TemporaryFolder folder;
    const RecordSet records = saved_records(folder, {"initial"}, recorded);
    save_mesh(folder.path(), "m", "initial", testing::joined(icosphere(2), testing::translated(icosphere(2), Vec3(1, 0.1, 0.2))));
    const Json pairs = run_views(records, folder.path()).molecules.at("m").at("meshes").at("initial").at("pairs");
    EXPECT_EQ(pairs.at("count") > 0, recorded > 0);
  }
}

TEST(RunViews, CanBeCancelled) {
  const TemporaryFolder folder;
  const RecordSet records = saved_records(folder, {"initial"});
  EXPECT_THROW(run_views(records, folder.path(), {}, [](std::string_view, double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace smopt::experiments
