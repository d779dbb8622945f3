#include "experiments/record.h"

#include <algorithm>

#include "experiments/machine.h"
#include "experiments/method_cases.h"
#include "experiments/run_report.h"
#include "smopt/version.h"

namespace smopt::experiments {
namespace {

Json molecule_json(const Dataset& dataset) {
  return {{"name", dataset.name},
          {"title", dataset.title},
          {"role", to_string(dataset.role)},
          {"paper_row", dataset.paper_row ? Json(*dataset.paper_row) : Json()},
          {"about", dataset.about},
          {"source", {{"package", dataset.package}, {"path", dataset.path.string()}}}};
}

Json surface_json(const GaussianSurfaceOptions& options) {
  return {{"decay_per_A2", options.decay}, {"isovalue", options.isovalue}, {"spacing_A", options.spacing}};
}

Json medians(const Json& repeats, const char* key) {
  Json result = Json::object();
  for (const auto& [stage, first] : repeats.front().at(key).items()) {
    std::vector<double> values;
    for (const Json& repeat : repeats) values.push_back(repeat.at(key).at(stage).get<double>());
    result[stage] = median(std::move(values));
  }
  return result;
}

}  // namespace

std::string method_title(std::string_view method) {
  return find_method_case(method).title;
}

Json record_header(const Dataset& dataset, std::string_view method) {
  Json record;
  record["schema_version"] = kRecordSchema;
  record["status"] = "failed";
  record["reason"] = "did not end";
  record["molecule"] = molecule_json(dataset);
  record["surface"] = surface_json(dataset.surface);
  record["method"] = method;
  record["registered_method"] = find_method_case(method).method;
  record["method_title"] = method_title(method);
  record["version"] = version();
  record["compiler"] = compiler();
  record["machine"] = machine_json();
  return record;
}

void add_surface(Json& record, const GeneratedSurface& surface) {
  record["molecule"]["atoms"] = surface.molecule.atom_count();
  record["molecule"]["sha256"] = surface.molecule_sha256;
  record["surface"]["report"] = {{"grid_nodes", surface.report.grid_nodes},
                                 {"surface_cells", surface.report.surface_cells},
                                 {"ambiguous_cells", surface.report.ambiguous_cells},
                                 {"tunnel_cells", surface.report.tunnel_cells},
                                 {"interior_vertices", surface.report.interior_vertices}};
}

void add_repeats(Json& record, std::span<const StageTimes> repeats) {
  Json all = Json::array();
  for (const StageTimes& times : repeats) {
    Json repeat;
    add_seconds(repeat, times);
    all.push_back(std::move(repeat));
  }
  record["repeats"] = all;
  record["seconds"] = medians(all, "seconds");
  record["cpu_seconds"] = medians(all, "cpu_seconds");
}

void mark_done(Json& record) {
  record["status"] = "done";
  record["reason"] = nullptr;
}

void mark_failed(Json& record, std::string_view reason) {
  record["status"] = "failed";
  record["reason"] = reason;
}

void mark_not_installed(Json& record, std::string_view reason) {
  record["status"] = "not installed";
  record["reason"] = reason;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace smopt::experiments
