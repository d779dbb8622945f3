#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "experiments/datasets.h"
#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/mesh_io.h"
#include "smopt/io/molecule.h"

namespace smopt::experiments {
namespace {

namespace fs = std::filesystem;

/// What a folder has of one name.
struct Found {
  fs::path molecule, mesh;
};

/// "connexin_2zw3" of "connexin_2zw3.pqr.gz".
std::string name_of(const fs::path& file) {
  fs::path name = file.filename();
  if (is_gzip_name(name)) name = name.stem();
  return name.stem().string();
}

/// PQR has the charges and radii that were chosen for the molecule.
bool is_pqr(const fs::path& file) {
  return format_ending(file) == "pqr";
}

/// Absolute, as steps run elsewhere. Of several files for one thing PQR comes first, then the order of their names.
std::map<std::string, Found> files_by_name(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(fs::absolute(folder), error), end; !error && entry != end; entry.increment(error))
    files.push_back(entry->path());
  if (error) throw InvalidInput(fmt::format("{}: {}", folder.string(), error.message()));
  std::ranges::sort(files, {}, [](const fs::path& file) { return std::pair(!is_pqr(file), file); });
  std::map<std::string, Found> found;
  for (const fs::path& file : files) {
    if (is_readable_molecule_format(file) && found[name_of(file)].molecule.empty()) found[name_of(file)].molecule = file;
    if (is_readable_mesh_format(file) && found[name_of(file)].mesh.empty()) found[name_of(file)].mesh = file;
  }
  return found;
}

Dataset new_dataset(const std::string& name, const Found& found) {
  Dataset dataset;
  dataset.name = dataset.title = name;
  dataset.about = found.mesh.empty() ? "a molecule of the user's" : "a mesh of the user's";
  dataset.path = found.molecule;
  dataset.mesh = found.mesh;
  dataset.is_of_folder = true;
  dataset.has_solvation = !found.molecule.empty();
  return dataset;
}

/// The user's file is read as it is, whatever would be done to the one that it takes the place of.
void replace_molecule(Dataset& dataset, const fs::path& file) {
  dataset.path = file;
  dataset.package.clear();
  dataset.is_prepared_by_pdb2pqr = false;
}

}  // namespace

std::vector<Dataset> with_data_folder(std::span<const Dataset> datasets, const fs::path& folder) {
  std::map<std::string, Found> found = files_by_name(folder);
  std::vector<Dataset> all(datasets.begin(), datasets.end());
  for (Dataset& dataset : all) {
    for (const std::string& name : {name_of(dataset.file), dataset.name}) {
      const auto it = found.find(name);
      if (it == found.end()) continue;
      if (!it->second.molecule.empty()) replace_molecule(dataset, it->second.molecule);
      if (!it->second.mesh.empty()) dataset.mesh = it->second.mesh;
      dataset.is_of_folder = true;
      found.erase(it);
    }
  }
  for (const auto& [name, files] : found) all.push_back(new_dataset(name, files));
  return all;
}

std::vector<Dataset> known_datasets(const fs::path& folder) {
  return folder.empty() ? all_datasets() : with_data_folder(all_datasets(), folder);
}

}  // namespace smopt::experiments
