#include "experiments/run_report.h"

#include <oneapi/tbb/global_control.h>

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

void add_program(Json& report) {
  report["peak_memory_mb"] = peak_memory_mb();
  report["threads"] = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  report["version"] = version();
}

}  // namespace smopt::experiments
