#include "experiments/record.h"

#include <algorithm>

#include "experiments/machine.h"
#include "experiments/method_cases.h"
#include "experiments/run_report.h"
#include "smopt/version.h"

namespace smopt::experiments {
namespace {

/// Without the folder of a user's files, which means nothing elsewhere.
Json source_json(const Dataset& dataset) {
  if (!dataset.package.empty()) return {{"package", dataset.package}, {"path", dataset.path.string()}};
  const std::filesystem::path& used = dataset.mesh.empty() ? dataset.path : dataset.mesh;
  Json source = {{"file", used.filename().string()}};
  if (!dataset.pdb.empty()) source["pdb"] = dataset.pdb;
  return source;
}

Json molecule_json(const Dataset& dataset) {
  return {{"name", dataset.name},
          {"title", dataset.title},
          {"role", to_string(dataset.role)},
          {"paper_row", dataset.paper_row ? Json(*dataset.paper_row) : Json()},
          {"about", dataset.about},
          {"source", source_json(dataset)}};
}

Json surface_json(const GaussianSurfaceOptions& options) {
  return {{"decay_per_A2", options.decay}, {"isovalue", options.isovalue}, {"spacing_A", options.spacing}};
}

}  // namespace

Json record_header(const Dataset& dataset, std::string_view method) {
  return record_header(dataset, find_method_case(method));
}

Json record_header(const Dataset& dataset, const MethodCase& method_case) {
  Json record;
  record["schema_version"] = kRecordSchema;
  record["status"] = "failed";
  record["reason"] = "did not end";
  record["molecule"] = molecule_json(dataset);
  record["surface"] = surface_json(dataset.surface);
  record["method"] = method_case.name;
  record["registered_method"] = method_case.method;
  record["method_title"] = method_case.title;
  record["version"] = version();
  record["compiler"] = compiler();
  record["machine"] = machine_json();
  return record;
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

}  // namespace smopt::experiments
