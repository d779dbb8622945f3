#include "experiments/convergence/published.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "experiments/convergence/embedded.h"
#include "smopt/error.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::json;

std::optional<double> optional_number(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<double>());
}

PublishedMesh parse_mesh(const Json& json) {
  PublishedMesh mesh;
  json.at("molecule").get_to(mesh.molecule);
  json.at("title").get_to(mesh.title);
  json.at("decay_per_A2").get_to(mesh.decay);
  json.at("option_e").get_to(mesh.option_e);
  json.at("vertices").get_to(mesh.vertices);
  json.at("components").get_to(mesh.components);
  json.at("euler_characteristic").get_to(mesh.euler_characteristic);
  json.at("euler_characteristic_main").get_to(mesh.euler_characteristic_main);
  mesh.area = optional_number(json.at("area_A2"));
  mesh.volume = optional_number(json.at("volume_A3"));
  json.at("our_error_A").get_to(mesh.our_error);
  return mesh;
}

}  // namespace

const PublishedFigures& published_figures() {
  static const PublishedFigures figures = parse_published(embedded::published_json());
  return figures;
}

PublishedFigures parse_published(std::string_view text) {
  PublishedFigures figures;
  try {
    const Json json = Json::parse(text);
    json.at("program").get_to(figures.program);
    json.at("source").get_to(figures.source);
    for (const Json& mesh : json.at("meshes")) figures.meshes.push_back(parse_mesh(mesh));
  } catch (const Json::exception& error) {
    throw InvalidInput(fmt::format("published figures: mesh {}: {}", figures.meshes.size(), error.what()));
  }
  return figures;
}

}  // namespace smopt::experiments
