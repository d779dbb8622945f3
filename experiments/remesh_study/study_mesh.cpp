#include "experiments/remesh_study/study_mesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "experiments/surface_stage.h"
#include "smopt/error.h"
#include "smopt/improve/prepare.h"

namespace smopt::experiments {
namespace {

namespace fs = std::filesystem;

/// "70S" of "70S.pqr.gz"; empty for a file that is none of a molecule.
std::string molecule_name(const fs::path& file) {
  const std::string name = file.filename().string();
  for (const std::string_view ending : {".pqr", ".pqr.gz"})
    if (name.ends_with(ending)) return name.substr(0, name.size() - ending.size());
  return "";
}

Dataset dataset_of(const std::string& name, const fs::path& file) {
  Dataset dataset;
  dataset.name = dataset.title = name;
  dataset.path = file;
  return dataset;
}

/// From one copy to the next, times the molecule's extent.
constexpr double kCopyDistance = 1.2;

/// The smallest cube of places that so many copies fit into.
int side_of_lattice(int copies) {
  int side = 1;
  while (side * side * side < copies) ++side;
  return side;
}

void append(TriangleMesh& all, const TriangleMesh& mesh, const Vec3& offset) {
  const auto first = static_cast<VertexId>(all.vertex_count());
  for (const Vec3& p : mesh.points) all.points.push_back(p + offset);
  for (const auto& [a, b, c] : mesh.triangles) all.triangles.push_back({a + first, b + first, c + first});
}

/// On a cubic lattice, filled row by row.
TriangleMesh copies_of(const TriangleMesh& mesh, int copies) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.points) box.extend(p);
  const Vec3 distance = kCopyDistance * box.sizes();
  const int side = side_of_lattice(copies);
  TriangleMesh all;
  for (int i = 0; i < copies; ++i) append(all, mesh, distance.cwiseProduct(Vec3(i % side, i / side % side, i / (side * side))));
  return all;
}

}  // namespace

StudyMesh study_mesh_of(const Dataset& dataset) {
  GeneratedSurface surface = generate_surface(dataset, {});
  StudyMesh result;
  result.dataset = dataset;
  result.input = prepare_input(surface.mesh);
  result.initial = std::move(surface.mesh);
  result.level_set.emplace(surface.molecule, dataset.surface);
  result.input_distance = result.level_set->distance(result.input.mesh);
  result.molecule = std::move(surface.molecule);
  return result;
}

StudyMesh study_mesh_of(const std::string& name, const fs::path& file, TriangleMesh mesh) {
  StudyMesh result;
  result.dataset = dataset_of(name, file);
  result.input = prepare_input(mesh);
  result.initial = std::move(mesh);
  return result;
}

StudyMesh study_copies_of(const Dataset& dataset, std::size_t vertices) {
  const TriangleMesh one = generate_surface(dataset, {}).mesh;
  TriangleMesh prepared = one;
  prepare(prepared, CavityPolicy::delete_cavities);
  const double ratio = static_cast<double>(vertices) / static_cast<double>(prepared.vertex_count());
  const int copies = std::max(1, static_cast<int>(std::lround(ratio)));
  StudyMesh result;
  result.dataset = dataset;
  result.dataset.name += "-copies";
  result.dataset.title = fmt::format("{} × {}", copies, dataset.title);
  result.initial = copies_of(one, copies);
  result.input = prepare_input(result.initial);
  return result;
}

std::vector<Dataset> datasets_in(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InvalidInput(fmt::format("{}: no such folder", folder.string()));
  std::vector<Dataset> datasets;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (const std::string name = molecule_name(entry.path()); !name.empty()) datasets.push_back(dataset_of(name, entry.path()));
  std::ranges::sort(datasets, {}, &Dataset::name);
  return datasets;
}

}  // namespace smopt::experiments
