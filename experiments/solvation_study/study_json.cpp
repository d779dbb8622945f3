#include "experiments/solvation_study/study_json.h"

#include "experiments/machine.h"
#include "experiments/solvation_study/findings.h"
#include "metrics/solvation/solvation_json.h"
#include "smopt/version.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const std::optional<double>& number) {
  return number ? Json(*number) : Json();
}

Json json_of(const Solve& solve);
Json json_of(const BornRow& row);
Json json_of(const BornSeries& series);
Json json_of(const RefinementSeries& series);
Json json_of(const Refinement& refinement);
Json json_of(const MeshSolve& mesh);
Json json_of(const ApbsRow& row);
Json json_of(const MoleculeComparison& comparison);

template <class Rows>
Json array_of(const Rows& rows) {
  Json array = Json::array();
  for (const auto& row : rows) array.push_back(json_of(row));
  return array;
}

Json json_of(const Solve& solve) {
  Json json = solve.result ? metrics::to_json(*solve.result) : Json{{"status", "failed"}, {"reason", solve.failure}};
  json["vertices"] = solve.vertices;
  return json;
}

Json json_of(const BornRow& row) {
  return {{"mean_edge", row.edge}, {"relative_error", json_of(row.error)}, {"order", json_of(row.order)}, {"solve", json_of(row.solve)}};
}

Json json_of(const BornSeries& series) {
  return {{"charge", series.ion.charge},
          {"radius", series.ion.radius},
          {"kappa", series.ion.medium.kappa()},
          {"energy", series.ion.energy()},
          {"meshes", array_of(series.rows)}};
}

Json json_of(const ObservedLimit& limit) {
  return {{"polar", limit.value}, {"order", limit.order}, {"relative_distance_of_finest", limit.distance}};
}

Json json_of(const RefinementSeries& series) {
  return {
      {"mesh", to_string(series.variant)}, {"solves", array_of(series.solves)}, {"limit", series.limit ? json_of(*series.limit) : Json()}};
}

Json json_of(const Refinement& refinement) {
  return {{"molecule", refinement.dataset.name}, {"spacings", refinement.spacings}, {"meshes", array_of(refinement.series)}};
}

Json json_of(const MeshSolve& mesh) {
  return {{"mesh", to_string(mesh.variant)}, {"solve", json_of(mesh.solve)}};
}

Json json_of(const ApbsRow& row) {
  Json json = {{"surface", to_string(row.surface)}, {"spacing", row.spacing}, {"polar", nullptr}, {"reason", nullptr}};
  if (!row.result) {
    json["reason"] = row.failure;
    return json;
  }
  json["polar"] = row.result->polar;
  json["nodes"] = row.result->grid.nodes;
  json["seconds"] = row.result->seconds;
  json["peak_memory_mb"] = row.result->peak_memory_mb;
  return json;
}

Json json_of(const MoleculeComparison& comparison) {
  return {{"molecule", comparison.dataset.name},
          {"atoms", comparison.atoms},
          {"spacing", comparison.dataset.surface.spacing},
          {"meshes", array_of(comparison.meshes)},
          {"apbs", array_of(comparison.apbs)}};
}

}  // namespace

Json study_json(const SolvationStudy& study) {
  return {{"version", version()},
          {"machine", machine_json()},
          {"born", array_of(study.born)},
          {"refinement", array_of(study.refinements)},
          {"initial_and_improved", array_of(study.comparisons)},
          {"findings", findings(study)}};
}

}  // namespace smopt::experiments
