#include "experiments/remesh_study/study_mesh.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/surface_stage.h"
#include "smopt/error.h"

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

}  // namespace

StudyMesh study_mesh_of(const Dataset& dataset) {
  GeneratedSurface surface = generate_surface(dataset, 1, {});
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

std::vector<Dataset> datasets_in(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InvalidInput(fmt::format("{}: no such folder", folder.string()));
  std::vector<Dataset> datasets;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (const std::string name = molecule_name(entry.path()); !name.empty()) datasets.push_back(dataset_of(name, entry.path()));
  std::ranges::sort(datasets, {}, &Dataset::name);
  return datasets;
}

}  // namespace smopt::experiments
