#include "tests/cli/smopt_program.h"

#include <fmt/format.h>

#include <algorithm>

#include "smopt/io/mesh_io.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using Json = nlohmann::json;

bool is_same_type(const Json& contract, const Json& actual) {
  if (contract.is_null()) return actual.is_null() || actual.is_string();
  if (contract.is_number()) return actual.is_number();
  return contract.type() == actual.type();
}

}  // namespace

std::filesystem::path smopt_program() {
  return SMOPT_PROGRAM;
}

ProgramResult run_smopt(const std::vector<std::string>& arguments, const std::string& input) {
  return run_program(smopt_program(), arguments, input);
}

std::string put_mesh(const TemporaryFolder& folder, std::string_view name, const TriangleMesh& mesh) {
  const std::string path = path_in(folder, name);
  write_mesh(path, mesh);
  return path;
}

std::string path_in(const TemporaryFolder& folder, std::string_view name) {
  return (folder.path() / name).string();
}

std::vector<std::string> files_in(const TemporaryFolder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

std::string why_not_shaped_like(const Json& contract, const Json& actual, const std::string& at) {
  if (!is_same_type(contract, actual)) return fmt::format("{} is {}, expected {}; ", at, actual.dump(), contract.type_name());
  std::string why;
  if (!contract.is_object()) return why;
  for (const auto& [key, value] : contract.items())
    why += actual.contains(key) ? why_not_shaped_like(value, actual[key], at + "/" + key) : fmt::format("{}/{} is missing; ", at, key);
  return why;
}

TriangleMesh crossing_spheres() {
  return joined(icosphere(2), translated(icosphere(2, 0.8), {1, 0.1, 0.2}));
}

TriangleMesh rough_sphere(int subdivisions) {
  // An edge of the icosahedron on the unit sphere is 1.05 long; each subdivision halves it.
  constexpr double kEdge = 1.05;
  constexpr double kShare = 0.3;
  return noisy(icosphere(subdivisions), kShare * kEdge / (1 << subdivisions), 7);
}

}  // namespace smopt::testing
