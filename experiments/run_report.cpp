#include "experiments/run_report.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>

#include "smopt/io/sha256.h"
#include "smopt/peak_memory.h"
#include "smopt/version.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 7> kStages = {"read", "validity", "cavities", "redundant", "smoothing", "write", "total"};

/// Of a closed manifold without isolated vertices, where 2 E = 3 F.
long euler_characteristic(const TriangleMesh& mesh) {
  return static_cast<long>(mesh.vertex_count()) - static_cast<long>(mesh.triangle_count() / 2);
}

Json medians(const Json& repeats, const char* key) {
  Json result = Json::object();
  for (const auto& [stage, first] : repeats.front().at(key).items()) {
    std::vector<double> values;
    for (const Json& repeat : repeats) values.push_back(repeat.at(key).at(stage).get<double>());
    result[stage] = median(std::move(values));
  }
  return result;
}

}  // namespace

bool is_stream(const std::filesystem::path& path) {
  return path == "-";
}

Json mesh_json(const TriangleMesh& mesh, const std::filesystem::path& file) {
  return {{"file", file.string()},
          {"vertices", mesh.vertex_count()},
          {"triangles", mesh.triangle_count()},
          {"euler_characteristic", euler_characteristic(mesh)},
          {"sha256", is_stream(file) ? Json(nullptr) : Json(sha256_of_file(file))}};
}

void add_seconds(Json& report, const StageTimes& times) {
  for (const char* key : {"seconds", "cpu_seconds"}) {
    report[key] = Json::object();
    for (const char* stage : kStages) report[key][stage] = 0.0;
  }
  for (const auto& [stage, seconds] : times) {
    report["seconds"][stage] = seconds.wall;
    report["cpu_seconds"][stage] = seconds.cpu;
  }
}

void add_repeats(Json& report, std::span<const StageTimes> repeats) {
  Json all = Json::array();
  for (const StageTimes& times : repeats) {
    Json repeat;
    add_seconds(repeat, times);
    all.push_back(std::move(repeat));
  }
  report["repeats"] = all;
}

void add_medians(Json& report) {
  for (const char* key : {"seconds", "cpu_seconds"}) report[key] = medians(report.at("repeats"), key);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

void add_program(Json& report) {
  report["peak_memory_mb"] = peak_memory_mb();
  report["threads"] = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  report["version"] = version();
}

}  // namespace smopt::experiments
