#include "metrics/solvation/solvation_json.h"

#include <gmock/gmock.h>

#include <limits>

namespace smopt::testing {
namespace {

using metrics::Solvation;
using metrics::SolvationStatus;
using ::testing::UnorderedElementsAre;

nlohmann::json json_of(const Solvation& result) {
  return nlohmann::json::parse(to_json(result).dump());
}

Solvation example() {
  Solvation r;
  r.polar = -80.5;
  r.nonpolar = 12.25;
  r.area = 100;
  r.volume = 50;
  r.iterations = 7;
  r.relative_residual = 1e-7;
  r.degenerate_vertices = {3, 8};
  r.charges_outside = 4;
  r.potential = {1, 2, 3};
  r.normal_derivative = {1, 2, 3};
  r.seconds = 0.5;
  r.predicted_memory_mb = 20;
  return r;
}

TEST(SolvationJson, HasTheKeysOfTheContractAndNoArraysOfTheVertices) {
  std::vector<std::string> keys;
  const nlohmann::json json = json_of(example());
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_THAT(keys, UnorderedElementsAre("status", "reason", "polar_kcal_per_mol", "nonpolar_kcal_per_mol", "total_kcal_per_mol",
                                         "iterations", "relative_residual", "degenerate_vertices", "degenerate_vertex_ids",
                                         "charges_outside", "area", "volume", "seconds", "predicted_memory_mb"));
}

TEST(SolvationJson, SaysWhatTheResultSays) {
  const nlohmann::json json = json_of(example());
  EXPECT_EQ(json["status"], "success");
  EXPECT_TRUE(json["reason"].is_null());
  EXPECT_EQ(json["polar_kcal_per_mol"], -80.5);
  EXPECT_EQ(json["nonpolar_kcal_per_mol"], 12.25);
  EXPECT_EQ(json["total_kcal_per_mol"], -68.25);
  EXPECT_EQ(json["iterations"], 7);
  EXPECT_EQ(json["relative_residual"], 1e-7);
  EXPECT_EQ(json["degenerate_vertices"], 2);
  EXPECT_EQ(json["degenerate_vertex_ids"], nlohmann::json::array({3, 8}));
  EXPECT_EQ(json["charges_outside"], 4);
  EXPECT_EQ(json["area"], 100.0);
  EXPECT_EQ(json["volume"], 50.0);
  EXPECT_EQ(json["seconds"], 0.5);
  EXPECT_EQ(json["predicted_memory_mb"], 20.0);
}

TEST(SolvationJson, NumbersThatAreNotFiniteAreNull) {
  Solvation r = example();
  r.status = SolvationStatus::nonfinite;
  r.reason = "why";
  r.polar = std::numeric_limits<double>::quiet_NaN();
  r.relative_residual = std::numeric_limits<double>::infinity();
  const nlohmann::json json = json_of(r);
  EXPECT_EQ(json["status"], "nonfinite");
  EXPECT_EQ(json["reason"], "why");
  EXPECT_TRUE(json["polar_kcal_per_mol"].is_null());
  EXPECT_TRUE(json["total_kcal_per_mol"].is_null());
  EXPECT_TRUE(json["relative_residual"].is_null());
  EXPECT_EQ(json["nonpolar_kcal_per_mol"], 12.25);
  EXPECT_EQ(json["degenerate_vertex_ids"].size(), 2U);
}

}  // namespace
}  // namespace smopt::testing
