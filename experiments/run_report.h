#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "smopt/mesh/triangle_mesh.h"
#include "smopt/timing.h"

/// What the reports of all commands have in common.
namespace smopt::experiments {

/// Whether a name is standard input or output.
bool is_stream(const std::filesystem::path& path);

/// File, vertices, triangles, Euler characteristic and the file's sha256 (null for a stream) of a closed manifold without isolated vertices.
nlohmann::ordered_json mesh_json(const TriangleMesh& mesh, const std::filesystem::path& file);

/// `seconds` (wall) and `cpu_seconds`: one number a stage. Those of `improve` (validity, cavities, redundant, smoothing) are always there, and 0
/// when they did not run.
void add_seconds(nlohmann::ordered_json& report, const StageTimes& times);

/// `peak_memory_mb`, `threads` and `version`.
void add_program(nlohmann::ordered_json& report);

}  // namespace smopt::experiments
