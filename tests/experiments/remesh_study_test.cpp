#include "experiments/remesh_study/study.h"

#include <gmock/gmock.h>

#include <fstream>
#include <set>

#include "experiments/record_set.h"
#include "experiments/remesh_study/goals.h"
#include "experiments/remesh_study/simulations.h"
#include "experiments/remesh_study/study_case.h"
#include "experiments/remesh_study/worst_places.h"
#include "metrics/dihedral.h"
#include "metrics/vertex_spacing.h"
#include "smopt/error.h"
#include "smopt/io/child_process.h"
#include "smopt/io/mesh_io.h"
#include "tests/experiments/made_records.h"
#include "tests/support/files.h"
#include "tests/support/shapes.h"

namespace smopt::experiments {
namespace {

using smopt::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

/// A record that reaches every aim.
Json ideal_record(const std::string& molecule = "fas2") {
  Json record = testing::made_record(testing::made_dataset(molecule), "smopt2");
  const Json before = {{"vertices", 65000}, {"intersecting_pairs", 0}, {"area", 200.0}, {"volume", 1000.0}};
  Json after = before;
  after["angle_deg"] = {{"min", 31.0}, {"max", 105.0}};
  after["min_angle_share"] = {{"below_30", 0.0}};
  after["valence"] = {{"share_5_6_7", 0.999}};
  record["metrics"] = {{"before", before}, {"after", after}};
  record["level_set_distance"] = {{"before", {{"mean", 0.02}}}, {"after", {{"mean", 0.02}, {"unresolved", 0}}}};
  record["distance_to_input"] = {{"largest", 0.1}, {"diagonal", 50.0}};
  for (const char* switches : {"p", "pY", "pq1.4"}) record["tetgen"][switches] = {{"status", "success"}, {"seconds", 1.25}};
  record["solvation"] = {{"status", "success"}, {"iterations", 15}};
  record["reference"] = {{"solvation", {{"status", "success"}, {"iterations", 15}}}};
  record["tetgen_ready"] = {{"smallest_dihedral_deg", 60.0}, {"vertex_spacing", 2e-6}};
  record["cpu_seconds"]["total"] = 0.5;
  record["peak_memory_mb"] = 512.0;
  record["two_threads"] = {{"seconds", 0.3}, {"same_bytes", true}};
  return record;
}

std::vector<Quantity> all_quantities(StudiedMeshes meshes) {
  std::vector<Quantity> quantities = shape_quantities(meshes);
  for (Quantity& quantity : use_quantities(meshes)) quantities.push_back(std::move(quantity));
  return quantities;
}

Judged judged(const Json& record, const std::string& id, StudiedMeshes meshes = StudiedMeshes::molecules) {
  for (const Quantity& quantity : all_quantities(meshes))
    if (quantity.head.id == id) return quantity.judge(record);
  throw std::runtime_error("no quantity " + id);
}

/// The ideal record of a mesh of so many vertices.
Json of_size(int vertices, const std::string& molecule = "fas2") {
  Json record = ideal_record(molecule);
  record["metrics"]["before"]["vertices"] = vertices;
  return record;
}

constexpr int kMillion = 1'000'000;

/// The record with one value changed.
Json with(const std::string& pointer, const Json& value) {
  Json record = ideal_record();
  record[Json::json_pointer(pointer)] = value;
  return record;
}

TEST(RemeshGoals, OfAnIdealRecordAreAllReached) {
  const std::set<std::string> without_goal = {"vertices_before",       "vertices_after",     "deviation_A",
                                              "smallest_dihedral_deg", "vertex_spacing_ppm", "peak_memory_mb"};
  for (const Quantity& quantity : all_quantities(StudiedMeshes::molecules)) {
    const Json record = quantity.head.id == "seconds_2_threads" ? of_size(kMillion) : ideal_record();
    EXPECT_EQ(quantity.judge(record).verdict, without_goal.contains(quantity.head.id) ? Verdict::not_judged : Verdict::aim)
        << quantity.head.id;
  }
}

TEST(RemeshGoals, ShowWhatTetgenStumblesOverAndTheMemory) {
  EXPECT_EQ(judged(ideal_record(), "smallest_dihedral_deg").text, "60.00");
  EXPECT_EQ(judged(ideal_record(), "vertex_spacing_ppm").text, "2.00");
  EXPECT_EQ(judged(ideal_record(), "peak_memory_mb").text, "512");
}

TEST(RemeshGoals, AreThoseOfTheIssue) {
  struct Case {
    const char* id;
    const char* pointer;
    double met, missed;  ///< on either side of the must
  };
  const Case cases[] = {{"min_angle_deg", "/metrics/after/angle_deg/min", 15, 14.99},
                        {"max_angle_deg", "/metrics/after/angle_deg/max", 140, 140.01},
                        {"below_30_percent", "/metrics/after/min_angle_share/below_30", 0.005, 0.0051},
                        {"valence_5_6_7_percent", "/metrics/after/valence/share_5_6_7", 0.97, 0.9699},
                        {"volume_change_percent", "/metrics/after/volume", 1000.09, 1000.11},
                        {"volume_change_percent", "/metrics/after/volume", 999.91, 999.89},
                        {"area_change_percent", "/metrics/after/area", 194.1, 193.9},
                        {"area_change_percent", "/metrics/after/area", 205.9, 206.1},
                        {"level_set_distance_ratio", "/level_set_distance/after/mean", 0.0299, 0.0301},
                        {"seconds_1_thread", "/cpu_seconds/total", 2, 2.01}};
  for (const Case& c : cases) {
    EXPECT_EQ(judged(with(c.pointer, c.met), c.id).verdict, Verdict::must) << c.id;
    EXPECT_EQ(judged(with(c.pointer, c.missed), c.id).verdict, Verdict::missed) << c.id;
  }
  EXPECT_EQ(judged(with("/metrics/after/intersecting_pairs", 1), "intersecting_pairs").verdict, Verdict::missed);
  Json million = of_size(kMillion);
  for (const auto& [seconds, verdict] : {std::pair(8.0, Verdict::aim), {30.0, Verdict::must}, {30.1, Verdict::missed}}) {
    million["two_threads"]["seconds"] = seconds;
    EXPECT_EQ(judged(million, "seconds_2_threads").verdict, verdict) << seconds;
  }
}

TEST(RemeshGoals, ANumberThatDoesNotExistMissesItsMust) {
  const Judged none = judged(with("/metrics/after/intersecting_pairs", nullptr), "intersecting_pairs");
  EXPECT_EQ(none.verdict, Verdict::missed);
  EXPECT_EQ(none.text, "—");
  EXPECT_THAT(none.detail, HasSubstr("no such number"));
}

TEST(RemeshGoals, AMissTellsThePlace) {
  Json record = with("/metrics/after/angle_deg/min", 3.0);
  record["worst"] = {{"smallest_angle", {{"triangle", 12}, {"point", {1.0, 2.0, -3.5}}}}};
  EXPECT_EQ(judged(record, "min_angle_deg").detail, "triangle 12 at (1.00, 2.00, -3.50)");
}

TEST(RemeshGoals, TetgenMustSucceedAndGoodTetrahedraOnlyUpToAMonomersSize) {
  for (const char* switches : {"p", "pY", "pq1.4"}) {
    const std::string pointer = std::string("/tetgen/") + switches, id = std::string("tetgen_") + switches;
    Json record = with(pointer, {{"status", "failed"}, {"reason", "too sharp"}});
    EXPECT_EQ(judged(record, id).verdict, Verdict::missed) << switches;
    EXPECT_EQ(judged(record, id).detail, "too sharp");
    record["metrics"]["before"]["vertices"] = 200000;
    EXPECT_EQ(judged(record, id).verdict, id == "tetgen_pq1.4" ? Verdict::not_judged : Verdict::missed) << switches;
  }
}

TEST(RemeshGoals, SolvationMustConvergeInNoMoreIterations) {
  EXPECT_EQ(judged(ideal_record(), "solvation_iterations").text, "15 (15)");
  EXPECT_EQ(judged(with("/solvation/iterations", 16), "solvation_iterations").verdict, Verdict::missed);
  const Judged failed = judged(with("/solvation", {{"status", "not_converged"}, {"reason", "residual 0.1"}}), "solvation_iterations");
  EXPECT_EQ(failed.verdict, Verdict::missed);
  EXPECT_EQ(failed.detail, "residual 0.1");
  EXPECT_EQ(judged(with("/solvation", {{"status", "not computed"}}), "solvation_iterations").verdict, Verdict::not_judged);
}

TEST(RemeshGoals, SolvationIsNotJudgedWhereTheReferenceHasNoIterations) {
  for (const Json& reference : {Json(), Json({{"status", "failed"}}), Json({{"status", "not_converged"}, {"iterations", 500}})}) {
    const Judged judgement = judged(with("/reference/solvation", reference), "solvation_iterations");
    EXPECT_EQ(judgement.verdict, Verdict::not_judged) << reference;
    EXPECT_EQ(judgement.text, "15 (—)") << reference;
  }
}

TEST(RemeshGoals, SecondsAreJudgedOnMeshesOfTheSizeOfTheGoalAlone) {
  const auto is_judged = [](int vertices, const char* id) { return judged(of_size(vertices), id).verdict != Verdict::not_judged; };
  for (const int vertices : {60'000, 65'000, 75'000}) EXPECT_TRUE(is_judged(vertices, "seconds_1_thread")) << vertices;
  for (const int vertices : {500, 59'999, 75'001, kMillion}) EXPECT_FALSE(is_judged(vertices, "seconds_1_thread")) << vertices;
  for (const int vertices : {900'000, kMillion, 1'100'000}) EXPECT_TRUE(is_judged(vertices, "seconds_2_threads")) << vertices;
  for (const int vertices : {500, 65'000, 899'999, 1'100'001}) EXPECT_FALSE(is_judged(vertices, "seconds_2_threads")) << vertices;
  EXPECT_EQ(judged(of_size(500), "seconds_1_thread").text, "0.50") << "shown, without a mark";
}

TEST(RemeshGoals, AGoalIsNotMeasuredWhereNoMeshHasItsSize) {
  const auto ids = [](const std::vector<Json>& records, StudiedMeshes meshes = StudiedMeshes::molecules) {
    const std::vector<Quantity> quantities = all_quantities(meshes);
    std::vector<std::string> names;
    for (const Quantity& quantity : unmeasured(quantities, records)) names.push_back(quantity.head.id);
    return names;
  };
  EXPECT_THAT(ids({of_size(500)}), ElementsAre("seconds_1_thread", "seconds_2_threads"));
  EXPECT_THAT(ids({of_size(500), of_size(65'000)}), ElementsAre("seconds_2_threads"));
  EXPECT_THAT(ids({of_size(65'000), of_size(kMillion)}), ElementsAre());
  Json failed = of_size(kMillion);
  failed["status"] = "failed";
  EXPECT_THAT(ids({of_size(65'000), failed}), ElementsAre("seconds_2_threads"));
  EXPECT_THAT(ids({of_size(500)}, StudiedMeshes::ready), ElementsAre()) << "ready meshes have no such goal";
}

TEST(RemeshGoals, SamplesWithoutAFootAreShownAndTooManyAreAMiss) {
  const auto with_unresolved = [](int samples) {
    return judged(with("/level_set_distance/after/unresolved", samples), "level_set_distance_ratio");
  };
  EXPECT_EQ(with_unresolved(0).text, "1.000");
  EXPECT_EQ(with_unresolved(1).text, "1.000 (1 sample without a foot)");
  EXPECT_EQ(with_unresolved(200).text, "1.000 (200 samples without a foot)");
  EXPECT_EQ(with_unresolved(200).verdict, Verdict::aim) << "0.1 % of the samples";
  EXPECT_EQ(with_unresolved(201).verdict, Verdict::missed);
  EXPECT_THAT(with_unresolved(201).detail, HasSubstr("0.1 %"));
}

TEST(RemeshGoals, AMeshThatStandsForNoLevelSetIsNotHeldAgainstOne) {
  Json record = ideal_record();
  record.erase("level_set_distance");
  EXPECT_EQ(judged(record, "level_set_distance_ratio").verdict, Verdict::not_judged);
  record["level_set_distance"] = {{"before", {{"mean", 0.02}}}, {"after", nullptr}};
  EXPECT_EQ(judged(record, "level_set_distance_ratio").verdict, Verdict::missed) << "it should be, and has none";
}

TEST(RemeshGoals, OtherBytesOnTwoThreadsAreAMiss) {
  EXPECT_EQ(judged(with("/two_threads/same_bytes", false), "same_bytes").verdict, Verdict::missed);
}

TEST(RemeshGoals, OfAReadyMeshArePairsAndTetgen) {
  Json record = with("/metrics/after/angle_deg/min", 1.0);
  record["metrics"]["after"]["area"] = 100;
  record["cpu_seconds"]["total"] = 100;
  record["metrics"]["after"]["intersecting_pairs"] = 3;
  record["tetgen"]["pY"] = {{"status", "failed"}, {"reason", ""}};
  std::vector<std::string> missed;
  for (const Quantity& quantity : all_quantities(StudiedMeshes::ready))
    if (quantity.judge(record).verdict == Verdict::missed) missed.push_back(quantity.head.id);
  EXPECT_THAT(missed, ElementsAre("intersecting_pairs", "tetgen_pY"));
  EXPECT_EQ(judged(record, "deviation_percent", StudiedMeshes::ready).text, "0.200") << "0.1 of 50";
}

TEST(RemeshGoals, MarksAreToldApart) {
  EXPECT_EQ(marked({"1.5", Verdict::missed, ""}), "**1.5 ✗**");
  EXPECT_EQ(marked({"1.5", Verdict::must, ""}), "1.5");
  EXPECT_EQ(marked({"1.5", Verdict::aim, ""}), "1.5 ✓");
  EXPECT_EQ(marked({"1.5", Verdict::not_judged, ""}), "1.5");
}

TEST(WorstPlaces, AreTheTrianglesWithTheSmallestAndTheLargestAngle) {
  // A right triangle with 5°, far away a cap with 150° and 15°, and an equilateral one.
  const double t5 = std::tan(5 * std::numbers::pi / 180), t15 = std::tan(15 * std::numbers::pi / 180);
  const TriangleMesh mesh = {
      {{0, 0, 0}, {1, 0, 0}, {0.5, 0.8660254037844386, 0}, {10, 0, 0}, {12, 0, 0}, {11, t15, 0}, {20, 0, 0}, {21, 0, 0}, {21, t5, 0}},
      {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}};
  const WorstPlaces places = find_worst_places(mesh);
  EXPECT_EQ(places.smallest_angle.value().triangle, 2U);
  EXPECT_NEAR(places.smallest_angle->value, 5, 1e-9);
  EXPECT_EQ(places.largest_angle.value().triangle, 1U);
  EXPECT_NEAR(places.largest_angle->value, 150, 1e-9);
  EXPECT_NEAR((places.largest_angle->point - Vec3(11, t15 / 3, 0)).norm(), 0, 1e-12);
  EXPECT_FALSE(places.intersection);
}

TEST(WorstPlaces, NameATriangleThatMeetsAnother) {
  const TriangleMesh crossing = {
      {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}, {0, 0, -1}, {0.2, 0, 1}, {0, 0.2, 1}},
      {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}};
  const WorstPlaces places = find_worst_places(crossing);
  ASSERT_TRUE(places.intersection);
  EXPECT_EQ(places.intersection->triangle, 1U);
  EXPECT_TRUE(find_worst_places({}).smallest_angle == std::nullopt);
}

TEST(MeshChoice, CountsTheEdgesThatTurnByMore) {
  // A cube of 12 triangles: 12 of its 18 edges turn by 90°, six diagonals by nothing.
  EXPECT_NEAR(share_of_sharp_edges(testing::cube(), 89.9), 12.0 / 18, 1e-12);
  EXPECT_EQ(share_of_sharp_edges(testing::cube(), 90.1), 0);
  EXPECT_EQ(share_of_sharp_edges({}, 60), 0);
}

TEST(MeshChoice, DoesNotJudgeAnEdgeOfATriangleWithoutANormal) {
  // Two triangles in a plane, and one without an area along an edge of each.
  const TriangleMesh flat = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0, 0}}, {{0, 1, 2}, {0, 2, 3}, {1, 0, 4}}};
  EXPECT_EQ(share_of_sharp_edges(flat, 60), 0);
}

/// A cube's faces, finely divided: closed, clean, and sharp along its edges.
TriangleMesh fine_cube() {
  TriangleMesh mesh = testing::icosphere(4);
  for (Vec3& p : mesh.points) p /= p.cwiseAbs().maxCoeff();
  return mesh;
}

TEST(MeshChoice, TakesWhatIsCleanSmoothAndClosed) {
  EXPECT_EQ(fault_of(testing::icosphere(4), {}).reason, "");
  EXPECT_EQ(fault_of(testing::torus(3, 1, 80, 40), {}).reason, "");
}

TEST(MeshChoice, SaysWhatTheOthersAreNot) {
  const auto reason = [](const TriangleMesh& mesh) { return fault_of(mesh, {}).reason; };
  const TriangleMesh sphere = testing::icosphere(4);
  EXPECT_EQ(reason(testing::icosphere(3)), "fewer than 2000 vertices");
  TriangleMesh open = sphere;
  open.triangles.pop_back();
  EXPECT_EQ(reason(open), "not closed");
  TriangleMesh turned = sphere;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_EQ(reason(turned), "not consistently oriented");
  EXPECT_EQ(reason(testing::joined(sphere, testing::translated(sphere, {0.5, 0, 0}))), "intersecting pairs");
  EXPECT_EQ(reason(testing::joined(sphere, sphere)), "several vertices at one place");
  EXPECT_EQ(fault_of(fine_cube(), {}).reason, "not smooth");
  EXPECT_THAT(fault_of(fine_cube(), {}).detail, HasSubstr("% of the edges are sharp"));
}

TEST(MeshChoice, UnpacksAnArchiveAndListsWhatItTookAndWhatItLeft) {
  const TemporaryFolder folder;
  const auto in = folder.path() / "in" / "meshes", out = folder.path() / "out";
  std::filesystem::create_directories(in);
  std::filesystem::create_directories(out);
  write_mesh(in / "sphere.off", testing::icosphere(4));
  write_mesh(in / "block.off", fine_cube());
  std::ofstream(in / "quad.off") << "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
  std::ofstream(in / "readme.txt") << "no mesh";
  const auto archive = folder.path() / "meshes.tar.gz";
  ASSERT_EQ(run_process({"/usr/bin/env", "tar", "-czf", archive.string(), "-C", (folder.path() / "in").string(), "meshes"}, {60, 0}, "", {})
                .exit_status,
            0);
  unpack_meshes(archive, out);
  const auto candidates = choose_meshes(out, {});
  ASSERT_EQ(candidates.size(), 3U);
  EXPECT_EQ(candidates[0].name, "block");
  EXPECT_EQ(candidates[0].fault.reason, "not smooth");
  EXPECT_EQ(candidates[1].name, "quad");
  EXPECT_EQ(candidates[1].fault.reason, "not read");
  EXPECT_THAT(candidates[1].fault.detail, AllOf(HasSubstr("4 vertices"), Not(HasSubstr(out.string()))));
  EXPECT_EQ(candidates[2].name, "sphere");
  EXPECT_EQ(candidates[2].fault.reason, "");
  EXPECT_TRUE(candidates[2].mesh && !candidates[0].mesh);
  EXPECT_EQ(all_meshes(out)[0].fault.reason, "") << "a folder of the user's own is taken as it is";
}

TEST(MeshChoice, AnArchiveThatIsNoneIsAnError) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { unpack_meshes(folder.file("no.tar.gz", "no archive"), folder.path()); },
              ThrowsMessage<InvalidInput>(HasSubstr("no.tar.gz")));
  EXPECT_THAT([&] { choose_meshes(folder.path() / "absent", {}); }, ThrowsMessage<InvalidInput>(HasSubstr("absent")));
}

/// Four atoms of a protein's backbone, close enough for one component.
constexpr const char* kPqr =
    "ATOM 1 N  ALA 1 0.0 0.0 0.0 -0.3 1.8\n"
    "ATOM 2 CA ALA 1 1.4 0.2 0.1  0.1 1.9\n"
    "ATOM 3 C  ALA 1 2.1 1.5 0.3  0.5 1.9\n"
    "ATOM 4 O  ALA 1 1.6 2.6 0.7 -0.5 1.6\n";

Dataset tiny(const TemporaryFolder& folder, const std::string& name) {
  Dataset dataset = testing::made_dataset(name);
  dataset.path = folder.file(name + ".pqr", kPqr);
  return dataset;
}

/// A method that leaves the mesh as it is, and tells which options it was given.
Method idle(const std::string& name) {
  Method method;
  method.name = name;
  method.options = {{"vertices", MethodOption::Kind::integer, "0", "", "", {}}};
  method.run = [](TriangleMesh&, const OptionValues& options, const ProgressCallback&) {
    MethodReport report;
    report.notes = {"vertices " + options.text("vertices")};
    return report;
  };
  return method;
}

TEST(RemeshStudy, RecordsACaseWithDistancesPlacesAndASecondRun) {
  const TemporaryFolder folder;
  MethodRegistry registry;
  registry.add(idle("smopt2"));
  const StudyMesh mesh = study_mesh_of(tiny(folder, "tiny"));
  StudyPlan plan;
  plan.with_two_threads = plan.with_solvation = plan.with_quality_tetrahedra = true;
  const Json record = run_study_case(mesh, find_method_case("smopt2"), registry, plan);
  ASSERT_TRUE(is_done(&record)) << record.dump();
  EXPECT_EQ(record.at("level_set_distance").at("before"), record.at("level_set_distance").at("after")) << "nothing was moved";
  EXPECT_NEAR(record.at("distance_to_input").at("largest").get<double>(), 0, 1e-7);
  EXPECT_GT(record.at("distance_to_input").at("diagonal").get<double>(), 5);
  EXPECT_NEAR(record.at("worst").at("smallest_angle").at("value").get<double>(),
              record.at("metrics").at("after").at("angle_deg").at("min").get<double>(), 1e-6);
  EXPECT_EQ(record.at("tetgen_ready").at("smallest_dihedral_deg"), metrics::smallest_dihedral_deg(mesh.input.mesh).value());
  EXPECT_EQ(record.at("tetgen_ready").at("vertex_spacing"), metrics::smallest_vertex_spacing(mesh.input.mesh).value());
  EXPECT_EQ(record.at("two_threads").at("same_bytes"), true);
  EXPECT_EQ(record.at("solvation").at("status"), "success");
  EXPECT_TRUE(record.at("tetgen").contains("pq1.4"));
}

TEST(RemeshStudy, NoticesOtherBytesOnTwoThreads) {
  const TemporaryFolder folder;
  MethodRegistry registry;
  Method erratic = idle("smopt2");
  erratic.run = [calls = 0](TriangleMesh& mesh, const OptionValues&, const ProgressCallback&) mutable {
    mesh.points[0] *= 1 + 1e-15 * ++calls;
    return MethodReport{};
  };
  registry.add(erratic);
  StudyPlan plan;
  plan.with_two_threads = true;
  EXPECT_EQ(
      run_study_case(study_mesh_of(tiny(folder, "tiny")), find_method_case("smopt2"), registry, plan).at("two_threads").at("same_bytes"),
      false);
}

TEST(RemeshStudy, ASolveThatIsTooLargeIsNotTried) {
  const TemporaryFolder folder;
  MethodRegistry registry;
  registry.add(idle("smopt2"));
  StudyPlan plan;
  plan.with_solvation = true;
  plan.most_solved_vertices = 100;
  const Json record = run_study_case(study_mesh_of(tiny(folder, "tiny")), find_method_case("smopt2"), registry, plan);
  EXPECT_EQ(record.at("solvation"), Json({{"status", "not computed"}, {"reason", "more than 100 vertices"}}));
}

TEST(RemeshStudy, AMethodThatIsNotThereIsNotInstalled) {
  const TemporaryFolder folder;
  const Json record = run_study_case(study_mesh_of(tiny(folder, "tiny")), find_method_case("smopt2"), MethodRegistry(), {});
  EXPECT_EQ(record.at("status"), "not installed");
}

TEST(RemeshStudy, RunsEveryMethodWithTheStudiedMethodsNumberOfVertices) {
  const TemporaryFolder folder;
  MethodRegistry registry;
  for (const char* name : {"smopt2", "smopt", "cgal_remesh"}) registry.add(idle(name));
  RemeshStudyOptions options;
  options.datasets = {tiny(folder, "one"), tiny(folder, "two")};
  options.compared = {"two"};
  std::vector<std::string> told;
  const RemeshStudy study = run_remesh_study(options, registry, [&](const std::string& line) { told.push_back(line); });
  ASSERT_EQ(study.molecules.size(), 2U);
  EXPECT_TRUE(is_done(&study.molecules[1])) << study.molecules[1].dump();
  EXPECT_EQ(study.molecules[1].at("reference").at("solvation").at("iterations"), study.molecules[1].at("solvation").at("iterations"));
  EXPECT_THAT(told, ::testing::IsSupersetOf({"one: smopt2", "two: smopt2", "two: cgal_remesh"}));
  EXPECT_THAT(told, Not(::testing::Contains("one: cgal_remesh")));
  const auto of_method = [&](const std::string& name) {
    const auto found = std::ranges::find_if(study.compared, [&](const Json& record) { return record.at("method") == name; });
    return found == study.compared.end() ? Json() : *found;
  };
  EXPECT_EQ(of_method("cgal_remesh").at("notes"), Json({"vertices " + std::to_string(vertices_of(study.molecules[1]).value())}));
  EXPECT_EQ(of_method("initial").at("status"), "done");
  EXPECT_EQ(of_method("taubin").at("status"), "not installed");
  EXPECT_EQ(study.ablations.front().at("method"), "smopt2");
}

TEST(RemeshStudy, CopiesLieApartAndHaveAboutAsManyVerticesAsAskedFor) {
  const TemporaryFolder folder;
  const Dataset dataset = tiny(folder, "tiny");
  const StudyMesh one = study_mesh_of(dataset);
  const StudyMesh many = study_copies_of(dataset, 10 * one.input.mesh.vertex_count());
  EXPECT_EQ(many.input.mesh.vertex_count(), 10 * one.input.mesh.vertex_count());
  EXPECT_EQ(many.input.metrics.at("components"), 10);
  EXPECT_EQ(many.input.metrics.at("intersecting_pairs"), 0);
  EXPECT_NEAR(many.input.metrics.at("volume").get<double>(), 10 * one.input.metrics.at("volume").get<double>(), 1e-6);
  EXPECT_EQ(many.dataset.title, "10 × The tiny");
  EXPECT_EQ(study_copies_of(dataset, 1).input.mesh.vertex_count(), one.input.mesh.vertex_count()) << "one at least";
}

TEST(RemeshStudy, TimesCopiesOfTheMonomerWithoutWhatIsAskedOfOne) {
  const TemporaryFolder folder;
  MethodRegistry registry;
  registry.add(idle("smopt2"));
  RemeshStudyOptions options;
  options.datasets = {tiny(folder, kCopied), tiny(folder, "other")};
  options.with_solvation = false;
  options.copied_vertices = 3000;
  const RemeshStudy study = run_remesh_study(options, registry, [](const std::string&) {});
  ASSERT_EQ(study.molecules.size(), 3U) << "the copies of one of them";
  const Json& record = study.molecules[2];
  ASSERT_TRUE(is_done(&record)) << record.dump();
  EXPECT_EQ(record.at("molecule").at("name"), std::string(kCopied) + "-copies");
  EXPECT_NEAR(record.at("metrics").at("before").at("vertices").get<double>(), 3000, 300);
  EXPECT_TRUE(record.contains("two_threads") && record.contains("peak_memory_mb"));
  for (const char* absent : {"tetgen", "level_set_distance", "distance_to_input"}) EXPECT_FALSE(record.contains(absent)) << absent;
  for (const Quantity& quantity : all_quantities(StudiedMeshes::molecules))
    EXPECT_NE(quantity.judge(record).detail, "there is no such number") << quantity.head.id;
}

TEST(RemeshStudy, CopiesCanBeLeftOut) {
  const TemporaryFolder folder;
  RemeshStudyOptions options;
  options.datasets = {tiny(folder, kCopied)};
  options.copied_vertices = 0;
  EXPECT_EQ(run_remesh_study(options, MethodRegistry(), [](const std::string&) {}).molecules.size(), 1U);
}

TEST(RemeshStudy, AMoleculeThatCannotBeReadIsARowWithItsReason) {
  const TemporaryFolder folder;
  RemeshStudyOptions options;
  options.datasets = {tiny(folder, "broken")};
  options.datasets[0].path = folder.path() / "absent.pqr";
  const RemeshStudy study = run_remesh_study(options, MethodRegistry(), [](const std::string&) {});
  EXPECT_THAT(study_page(study, "c"), HasSubstr("absent.pqr: no such file"));
}

TEST(RemeshStudy, AComparedMoleculeMustBeAmongTheMolecules) {
  RemeshStudyOptions options;
  options.compared = {"fas2"};
  EXPECT_THROW(run_remesh_study(options, MethodRegistry(), [](const std::string&) {}), InvalidOption);
}

TEST(RemeshStudy, TakesReadyMeshesFromAFolder) {
  const TemporaryFolder folder;
  write_mesh(folder.path() / "ball.off", testing::icosphere(2));
  TriangleMesh open = testing::icosphere(2);
  open.triangles.pop_back();
  write_mesh(folder.path() / "bowl.off", open);
  MethodRegistry registry;
  registry.add(idle("smopt2"));
  RemeshStudyOptions options;
  options.meshes = folder.path();
  const RemeshStudy study = run_remesh_study(options, registry, [](const std::string&) {});
  ASSERT_EQ(study.ready.size(), 2U);
  EXPECT_EQ(study.folder, folder.path().filename().string());
  EXPECT_EQ(study.archive, "");
  EXPECT_TRUE(is_done(&study.ready[0]));
  EXPECT_FALSE(study.ready[0].contains("level_set_distance"));
  EXPECT_EQ(study.ready[1].at("status"), "failed") << "not closed";
}

TEST(RemeshStudy, FindsTheMoleculesOfAFolder) {
  const TemporaryFolder folder;
  for (const char* name : {"b.pqr", "a.pqr.gz", "readme.md", "c.pdb"}) static_cast<void>(folder.file(name, ""));
  const auto datasets = datasets_in(folder.path());
  ASSERT_EQ(datasets.size(), 2U);
  EXPECT_EQ(datasets[0].name, "a");
  EXPECT_EQ(datasets[1].path, folder.path() / "b.pqr");
}

RemeshStudy made_study() {
  RemeshStudy study;
  study.molecules = {ideal_record("fas2"), ideal_record("achbp")};
  study.molecules[1]["metrics"]["after"]["angle_deg"]["min"] = 12.3456;
  study.molecules[1]["notes"] = {"smallest angle: 12.3° at vertex 7, 40 flips refused there"};
  study.ready = {testing::failed_record(testing::made_dataset("pot"), "smopt2", "the lid is missing")};
  study.candidates = {{"pot", "pot.off", 3000, {}, {}}, {"block", "block.off", 4000, {"not smooth", "3.0 % of the edges are sharp"}, {}}};
  study.compared = {testing::made_record(testing::made_dataset("fas2"), "initial"), ideal_record("fas2")};
  study.ablations = {ideal_record("fas2")};
  study.figure = "figure.svg";
  return study;
}

TEST(RemeshStudyPage, MarksWhereAMustIsMissedAndSaysWhy) {
  const std::string page = study_page(made_study(), "the command");
  EXPECT_THAT(page, HasSubstr("Smallest angle (°): ≥ 15, aim ≥ 30"));
  EXPECT_THAT(page, HasSubstr("31.000 ✓"));
  EXPECT_THAT(page, HasSubstr("**12.346 ✗**"));
  EXPECT_THAT(page, HasSubstr("- The achbp\n  - Smallest angle (°): **12.346** for ≥ 15, aim ≥ 30\n"));
  EXPECT_THAT(page, HasSubstr("the method says: smallest angle: 12.3° at vertex 7, 40 flips refused there"));
  EXPECT_THAT(page, Not(HasSubstr("- The fas2\n"))) << "it misses nothing";
  EXPECT_THAT(page, HasSubstr("Made by `the command`."));
}

TEST(RemeshStudyPage, ShowsAFailureAndTheMeshesThatWereLeft) {
  const std::string page = study_page(made_study(), "");
  EXPECT_THAT(page, HasSubstr("**failed: the lid is missing ✗**"));
  EXPECT_THAT(page, HasSubstr("- not smooth: block (3.0 % of the edges are sharp)"));
  EXPECT_THAT(page, HasSubstr("](figure.svg)"));
}

TEST(RemeshStudyPage, SaysWhenNothingIsMissed) {
  RemeshStudy study;
  study.molecules = {ideal_record()};
  const std::string page = study_page(study, "");
  EXPECT_THAT(page, HasSubstr("No must is missed."));
  EXPECT_THAT(page, HasSubstr("- Seconds, two threads: ≤ 30, aim ≤ 8 (0.9 to 1.1 million vertices): **not measured**"));
  EXPECT_THAT(page, Not(HasSubstr("- Seconds, one thread"))) << "it has 65 000 vertices";
  EXPECT_THAT(page, Not(HasSubstr("## Ready meshes")));
  EXPECT_THAT(page, Not(HasSubstr("## Beside")));
}

TEST(RemeshStudyPage, ClaimsAChoiceOfReadyMeshesForAnArchiveAlone) {
  RemeshStudy study = made_study();
  study.folder = "my-meshes";
  const std::string of_folder = study_page(study, "");
  EXPECT_THAT(of_folder, HasSubstr("From the folder `my-meshes` every OFF file"));
  EXPECT_THAT(of_folder, Not(HasSubstr("are smooth")));
  study.folder = "";
  study.archive = "data.tar.gz";
  const std::string of_archive = study_page(study, "");
  EXPECT_THAT(of_archive, HasSubstr("From the archive `data.tar.gz` are taken"));
  EXPECT_THAT(of_archive, Not(HasSubstr("every OFF file")));
}

TEST(RemeshStudyPage, TheJsonHasTheRecordsWithoutWhatIsLong) {
  RemeshStudy study = made_study();
  study.molecules[0]["each_round"] = Json::array({1, 2, 3});
  const Json json = study_json(study);
  EXPECT_EQ(json.at("molecules").size(), 2U);
  EXPECT_FALSE(json.at("molecules")[0].contains("each_round"));
  EXPECT_FALSE(json.at("compared")[0].at("metrics").at("after").at("edge_ratio").contains("histogram"));
  EXPECT_EQ(json.at("compared")[0].at("metrics").at("after").at("vertices"), 400);
  EXPECT_EQ(json.at("candidates")[1].at("left_because"), "not smooth");
  EXPECT_TRUE(json.at("candidates")[0].at("left_because").is_null());
}

TEST(RemeshStudySimulations, TellEveryOutcomeOfTetgenBySwitches) {
  const auto outcomes = tetgen_of(testing::icosphere(1), tetgen_trials("smopt2"));
  for (const char* switches : {"p", "pY", "pq1.4"}) {
    EXPECT_EQ(outcomes.at(switches).at("status"), "success") << switches;
    EXPECT_EQ(outcomes.at(switches).at("switches"), switches);
  }
}

TEST(RemeshStudySimulations, DoNotRefineWhatCannotBeFilled) {
  // Two tetrahedra through each other.
  const auto crossing = testing::joined(testing::tetrahedron(), testing::translated(testing::tetrahedron(), {0.3, 0.2, 0.1}));
  const auto outcomes = tetgen_of(crossing, tetgen_trials("smopt2"));
  EXPECT_EQ(outcomes.at("p").at("status"), "failed");
  EXPECT_EQ(outcomes.at("pq1.4").at("status"), "failed");
  EXPECT_THAT(outcomes.at("pq1.4").at("reason").get<std::string>(), HasSubstr("not tried"));
}

}  // namespace
}  // namespace smopt::experiments
