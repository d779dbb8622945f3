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

using Json = nlohmann::json;

constexpr std::array<std::pair<std::string_view, Role>, 4> kRoles = {
    {{"real", Role::real}, {"near-copy", Role::near_copy}, {"stand-in", Role::stand_in}, {"extra", Role::extra}}};

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

Dataset parse_dataset(const Json& json) {
  Dataset dataset;
  dataset.name = json.at("name").get<std::string>();
  dataset.title = json.at("title").get<std::string>();
  if (!json.at("paper_row").is_null()) dataset.paper_row = json.at("paper_row").get<std::string>();
  dataset.role = parse_role(json.at("role").get<std::string>());
  dataset.about = json.at("about").get<std::string>();
  dataset.package = json.at("source").at("package").get<std::string>();
  dataset.path = json.at("source").at("path").get<std::string>();
  dataset.surface = parse_surface(json.at("surface"));
  dataset.is_quick = json.at("is_quick").get<bool>();
  dataset.has_solvation = json.at("solvation").get<bool>();
  return dataset;
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

std::vector<Dataset> find_datasets(std::span<const Dataset> datasets, std::span<const std::string> names) {
  std::vector<Dataset> found;
  for (const std::string& name : names) {
    const auto it = std::find_if(datasets.begin(), datasets.end(), [&](const Dataset& d) { return d.name == name; });
    if (it == datasets.end()) {
      std::vector<std::string> known;
      for (const Dataset& dataset : datasets) known.push_back(dataset.name);
      throw InvalidOption(fmt::format("no molecule '{}'; there are {}", name, fmt::join(known, ", ")));
    }
    found.push_back(*it);
  }
  return found;
}

std::string labelled_title(std::string_view title, std::string_view role) {
  if (role == to_string(Role::stand_in)) return fmt::format("{} (stand-in)", title);
  if (role == to_string(Role::near_copy)) return fmt::format("{} (near copy)", title);
  return std::string(title);
}

}  // namespace smopt::experiments
