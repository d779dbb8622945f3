#include "experiments/datasets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "experiments/embedded.h"
#include "smopt/error.h"

namespace smopt::experiments {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::array<std::pair<std::string_view, Role>, 4> kRoles = {
    {{"real", Role::real}, {"near-copy", Role::near_copy}, {"stand-in", Role::stand_in}, {"extra", Role::extra}}};

constexpr std::array<std::string_view, 4> kSuites = {kDefaultSuite, kQuickSuite, kPaperSuite, kExtendedSuite};

constexpr const char* kPdb2pqr = "pdb2pqr";

Role parse_role(const std::string& text) {
  const auto* const found = std::find_if(kRoles.begin(), kRoles.end(), [&](const auto& entry) { return entry.first == text; });
  if (found == kRoles.end()) throw InvalidInput(fmt::format("role '{}' is none of real, near-copy, stand-in, extra", text));
  return found->second;
}

GaussianSurfaceOptions parse_surface(const Json& json) {
  GaussianSurfaceOptions options;
  options.decay = json.at("decay_per_A2").get<double>();
  options.isovalue = json.at("isovalue").get<double>();
  options.spacing = json.at("spacing_A").get<double>();
  return options;
}

bool parse_preparation(const std::string& text) {
  if (!text.empty() && text != kPdb2pqr) throw InvalidInput(fmt::format("prepare '{}' is not {}", text, kPdb2pqr));
  return !text.empty();
}

std::vector<std::string> parse_suites(const Json& json) {
  auto suites = json.get<std::vector<std::string>>();
  for (const std::string& suite : suites)
    if (std::ranges::find(kSuites, suite) == kSuites.end())
      throw InvalidInput(fmt::format("suite '{}' is none of {}", suite, fmt::join(kSuites, ", ")));
  return suites;
}

Dataset parse_dataset(const Json& json) {
  Dataset dataset;
  dataset.name = json.at("name").get<std::string>();
  dataset.title = json.at("title").get<std::string>();
  if (!json.at("paper_row").is_null()) dataset.paper_row = json.at("paper_row").get<std::string>();
  dataset.role = parse_role(json.at("role").get<std::string>());
  dataset.about = json.at("about").get<std::string>();
  const Json& source = json.at("source");
  dataset.package = source.value("package", "");
  dataset.file = source.value("file", "");
  dataset.pdb = source.value("pdb", "");
  dataset.mesh = source.value("mesh", "");
  if (dataset.file.empty() && dataset.mesh.empty())
    dataset.path = source.at("path").get<std::string>();
  else
    dataset.path = source.value("path", "");
  dataset.is_prepared_by_pdb2pqr = parse_preparation(source.value("prepare", ""));
  dataset.surface = parse_surface(json.at("surface"));
  dataset.suites = parse_suites(json.at("suites"));
  dataset.has_solvation = json.at("solvation").get<bool>();
  return dataset;
}

/// With a way to get it.
std::string what_is_missing(const Dataset& dataset) {
  const std::string entry =
      dataset.pdb.empty() ? "" : fmt::format(", made of the PDB entry {} (experiments/fetch_molecules gets it)", dataset.pdb);
  return fmt::format("{}: needs the file {} in the folder that --data names{}", dataset.name, dataset.file, entry);
}

}  // namespace

std::string_view to_string(Role role) {
  return std::find_if(kRoles.begin(), kRoles.end(), [role](const auto& entry) { return entry.second == role; })->first;
}

std::vector<Dataset> parse_datasets(std::string_view text) {
  std::vector<Dataset> datasets;
  try {
    const Json json = Json::parse(text);
    for (const Json& entry : json.at("molecules")) datasets.push_back(parse_dataset(entry));
  } catch (const Json::exception& error) {
    throw InvalidInput(fmt::format("datasets: molecule {}: {}", datasets.size(), error.what()));
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("datasets: molecule {}: {}", datasets.size(), error.what()));
  }
  return datasets;
}

const std::vector<Dataset>& all_datasets() {
  static const std::vector<Dataset> datasets = parse_datasets(embedded::datasets_json());
  return datasets;
}

nlohmann::ordered_json to_json(const Dataset& dataset) {
  nlohmann::ordered_json source = {
      {"package", dataset.package},    {"file", dataset.file},          {"pdb", dataset.pdb},
      {"path", dataset.path.string()}, {"mesh", dataset.mesh.string()}, {"prepare", dataset.is_prepared_by_pdb2pqr ? kPdb2pqr : ""}};
  return {{"name", dataset.name},
          {"title", dataset.title},
          {"paper_row", dataset.paper_row ? Json(*dataset.paper_row) : Json()},
          {"role", to_string(dataset.role)},
          {"about", dataset.about},
          {"source", source},
          {"surface",
           {{"decay_per_A2", dataset.surface.decay}, {"isovalue", dataset.surface.isovalue}, {"spacing_A", dataset.surface.spacing}}},
          {"suites", dataset.suites},
          {"solvation", dataset.has_solvation}};
}

std::vector<Dataset> find_datasets(std::span<const Dataset> datasets, std::span<const std::string> names) {
  std::vector<Dataset> found;
  for (const std::string& name : names) {
    const auto it = std::find_if(datasets.begin(), datasets.end(), [&](const Dataset& d) { return d.name == name; });
    if (it == datasets.end()) {
      std::vector<std::string> known;
      for (const Dataset& dataset : datasets) known.push_back(dataset.name);
      throw InvalidOption(fmt::format("no molecule '{}'; there are {}", name, fmt::join(known, ", ")));
    }
    if (std::ranges::find(found, name, &Dataset::name) == found.end()) found.push_back(*it);
  }
  return found;
}

bool Dataset::is_in(std::string_view suite) const {
  return std::ranges::find(suites, suite) != suites.end();
}

std::vector<Dataset> datasets_of(std::span<const Dataset> datasets, std::string_view suite) {
  std::vector<Dataset> found;
  for (const Dataset& dataset : datasets)
    if (dataset.is_in(suite)) found.push_back(dataset);
  return found;
}

void require_files(std::span<const Dataset> datasets) {
  std::vector<std::string> missing;
  for (const Dataset& dataset : datasets)
    if (dataset.path.empty() && dataset.mesh.empty()) missing.push_back(what_is_missing(dataset));
  if (!missing.empty()) throw InvalidInput(fmt::format("{}", fmt::join(missing, "\n")));
}

std::string labelled_title(std::string_view title, std::string_view role) {
  if (role == to_string(Role::stand_in)) return fmt::format("{} (stand-in)", title);
  if (role == to_string(Role::near_copy)) return fmt::format("{} (near copy)", title);
  return std::string(title);
}

}  // namespace smopt::experiments
