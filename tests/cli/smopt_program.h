#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace smopt::testing {

/// The built program.
std::filesystem::path smopt_program();

/// Runs `smopt` with these arguments, `input` on its standard input.
ProgramResult run_smopt(const std::vector<std::string>& arguments, const std::string& input = {});

/// Writes a mesh into the folder; returns its path.
std::string put_mesh(const TemporaryFolder& folder, std::string_view name, const TriangleMesh& mesh);

/// A path in the folder, for a file that need not exist.
std::string path_in(const TemporaryFolder& folder, std::string_view name);

/// The names of the files in the folder, sorted.
std::vector<std::string> files_in(const TemporaryFolder& folder);

/// What keeps `actual` from having every key of `contract` with a value of the same type, in words; empty when nothing does. Any number
/// stands for a number, null in `contract` for a string or null. More keys are allowed.
std::string why_not_shaped_like(const nlohmann::json& contract, const nlohmann::json& actual, const std::string& at = {});

/// Two spheres of different radii that cross.
TriangleMesh crossing_spheres();

/// A sphere whose vertices are moved at random by about a third of an edge: triangles of every shape, and few or no intersections.
TriangleMesh rough_sphere(int subdivisions);

}  // namespace smopt::testing
