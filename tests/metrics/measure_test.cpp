#include "metrics/measure.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "metrics/measurement_json.h"
#include "metrics/registry.h"
#include "metrics/table.h"
#include "tests/support/shapes.h"

namespace smopt::metrics {
namespace {

using namespace smopt::testing;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Json = nlohmann::ordered_json;

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& item : object.items()) names.push_back(item.key());
  return names;
}

/// The paths of all numbers and booleans (and nulls) that are not in arrays.
void collect_leaves(const Json& object, const std::string& prefix, std::map<std::string, Json>& leaves) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_object())
      collect_leaves(value, prefix + key + ".", leaves);
    else if (!value.is_array())
      leaves[prefix + key] = value;
  }
}

Measurement measured_with_distance(const TriangleMesh& mesh) {
  const TriangleMesh reference = icosphere(2, 1.1);
  return measure(mesh, {.reference = &reference, .distance = {.samples = 100}});
}

TEST(Measure, JsonHasTheKeysOfTheContract) {
  const Json json = to_json(measure(cube()));
  EXPECT_THAT(keys(json), ElementsAre("vertices", "triangles", "edges", "components", "euler_characteristic", "genus", "closed",
                                      "edge_manifold", "vertex_manifold", "oriented", "isolated_vertices", "duplicate_vertices",
                                      "degenerate_triangles", "nonfinite_vertices", "intersecting_pairs", "area", "volume", "edge_ratio",
                                      "angle_deg", "min_angle_share", "max_angle_share", "valence", "notes"));
  EXPECT_THAT(keys(json["edge_ratio"]), ElementsAre("min", "mean", "median", "below_0.1", "histogram"));
  EXPECT_THAT(keys(json["angle_deg"]), ElementsAre("min", "max", "mean_min", "histogram"));
  EXPECT_THAT(keys(json["min_angle_share"]), ElementsAre("below_5", "below_10", "below_20", "below_30"));
  EXPECT_THAT(keys(json["max_angle_share"]), ElementsAre("above_120", "above_150"));
  EXPECT_THAT(keys(json["valence"]), ElementsAre("min", "max", "share_6", "share_5_6_7"));
  EXPECT_THAT(keys(json["edge_ratio"]["histogram"]), ElementsAre("edges", "counts"));
}

TEST(Measure, OfACubeIsAllRightAndHasNoNotes) {
  const Json json = to_json(measure(cube()));
  EXPECT_EQ(json["vertices"], 8);
  EXPECT_EQ(json["edges"], 18);
  EXPECT_EQ(json["genus"], 0);
  EXPECT_EQ(json["closed"], true);
  EXPECT_EQ(json["intersecting_pairs"], 0);
  EXPECT_DOUBLE_EQ(json["volume"], 1);
  EXPECT_TRUE(json["notes"].empty());
}

TEST(Measure, EveryNullHasANote) {
  TriangleMesh broken = cube();
  broken.points[3].y() = std::numeric_limits<double>::infinity();
  for (const TriangleMesh& mesh : {broken, TriangleMesh{}, TriangleMesh{{{0, 0, 0}}, {}}}) {
    const Json json = to_json(measure(mesh));
    const std::string notes = json["notes"].dump();
    std::map<std::string, Json> leaves;
    collect_leaves(json, "", leaves);
    for (const auto& [path, value] : leaves) {
      if (!value.is_null() || path.starts_with("min_angle_share") || path.starts_with("max_angle_share")) continue;
      EXPECT_THAT(notes, HasSubstr(path.substr(0, path.find('.')))) << path;
    }
    EXPECT_NO_THROW((void)json.dump());
  }
  EXPECT_TRUE(to_json(measure(broken))["intersecting_pairs"].is_null());
  EXPECT_EQ(to_json(measure(broken))["nonfinite_vertices"], 1);
}

TEST(Measure, CountsPairsOfANonManifoldSoupToo) {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back(mesh.triangles[0]);
  const Measurement m = measure(mesh);
  EXPECT_FALSE(m.topology.edge_manifold);
  EXPECT_EQ(m.intersecting_pairs, 1U);
}

TEST(Registry, HasEveryNumberOfTheJsonUnderItsPathAndNoOther) {
  for (const TriangleMesh& mesh : {noisy(icosphere(2), 0.1, 2), TriangleMesh{}}) {
    const Measurement m = measured_with_distance(mesh);
    std::map<std::string, Json> leaves;
    collect_leaves(to_json(m), "", leaves);
    leaves.erase("distance.samples");  // a setting, not a result
    for (const Metric& metric : metric_registry()) {
      const auto leaf = leaves.find(std::string(metric.name));
      const std::optional<double> value = metric.value(m);
      if (leaf == leaves.end()) {
        EXPECT_TRUE(metric.name.starts_with("distance.") && !m.distance) << metric.name;
        continue;
      }
      EXPECT_EQ(value.has_value(), !leaf->second.is_null()) << metric.name;
      if (value) {
        EXPECT_EQ(*value, leaf->second.is_boolean() ? static_cast<double>(leaf->second.get<bool>()) : leaf->second.get<double>())
            << metric.name;
      }
      leaves.erase(leaf);
    }
    for (const auto& [path, value] : leaves) ADD_FAILURE() << path << " is in the JSON and not in the registry";
  }
}

TEST(Registry, NamesAreUniqueAndFound) {
  std::set<std::string_view> names;
  for (const Metric& metric : metric_registry()) {
    EXPECT_TRUE(names.insert(metric.name).second) << metric.name;
    EXPECT_EQ(find_metric(metric.name), &metric);
    EXPECT_FALSE(metric.title.empty());
    EXPECT_FALSE(metric.unit.empty());
    EXPECT_TRUE(metric.better == Better::kNeutral || metric.ideal.has_value()) << metric.name;
  }
  EXPECT_EQ(find_metric("no such metric"), nullptr);
}

TEST(Table, ShowsMeshesAsColumnsOfOneWidth) {
  TriangleMesh open = icosphere(2);
  open.triangles.pop_back();
  const std::vector<NamedMeasurement> columns = {{"cube.off", measure(cube())}, {"a rather long name.ply", measure(open)}};
  const std::string table = format_table(columns);
  std::vector<std::string> lines;
  std::istringstream stream(table);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  ASSERT_GT(lines.size(), 30U);
  EXPECT_THAT(lines[0], ::testing::EndsWith("cube.off  a rather long name.ply"));
  const auto row = [&](std::string_view title) {
    return *std::find_if(lines.begin(), lines.end(), [&](const std::string& line) { return line.starts_with(title); });
  };
  EXPECT_THAT(row("vertices "), ::testing::ContainsRegex(" 8 +162$"));
  EXPECT_THAT(row("closed "), ::testing::ContainsRegex(" yes +no$"));
  EXPECT_THAT(row("volume "), ::testing::EndsWith("–"));
  EXPECT_THAT(lines, Contains(HasSubstr("a rather long name.ply: volume: the surface is not closed")));
  EXPECT_THAT(table, Not(HasSubstr("Hausdorff")));
  EXPECT_EQ(row("area ").size(), lines[0].size() + 2) << "Å and ² take two bytes each";
}

TEST(Table, ShowsDistancesWhenThereAreSome) {
  const std::vector<NamedMeasurement> columns = {{"a", measured_with_distance(icosphere(2))}, {"b", measure(cube())}};
  EXPECT_THAT(format_table(columns), HasSubstr("Hausdorff"));
}

}  // namespace
}  // namespace smopt::metrics
