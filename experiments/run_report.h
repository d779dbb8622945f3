#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

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

/// `repeats`: the `seconds` and `cpu_seconds` of each of several runs of the same thing.
void add_repeats(nlohmann::ordered_json& report, std::span<const StageTimes> repeats);

/// Of each stage the median over `repeats`, in place of `seconds` and `cpu_seconds`.
void add_medians(nlohmann::ordered_json& report);

/// The median; of an even number the mean of the middle two. \pre not empty
double median(std::vector<double> values);

/// `peak_memory_mb`, `threads` and `version`.
void add_program(nlohmann::ordered_json& report);

}  // namespace smopt::experiments
