#include "metrics/solvation/solvation_json.h"

#include <cmath>

namespace smopt::metrics {
namespace {

using Json = nlohmann::ordered_json;

Json finite_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

}  // namespace

Json to_json(const Solvation& r) {
  return {{"status", to_string(r.status)},
          {"reason", r.reason.empty() ? Json() : Json(r.reason)},
          {"polar_kcal_per_mol", finite_or_null(r.polar)},
          {"nonpolar_kcal_per_mol", finite_or_null(r.nonpolar)},
          {"total_kcal_per_mol", finite_or_null(r.total())},
          {"iterations", r.iterations},
          {"relative_residual", finite_or_null(r.relative_residual)},
          {"degenerate_vertices", r.degenerate_vertices.size()},
          {"degenerate_vertex_ids", r.degenerate_vertices},
          {"charges_outside", r.charges_outside},
          {"area", finite_or_null(r.area)},
          {"volume", finite_or_null(r.volume)},
          {"seconds", finite_or_null(r.seconds)},
          {"predicted_memory_mb", finite_or_null(r.predicted_memory_mb)}};
}

Json to_json(const SolvationOptions& options) {
  return {{"inner_permittivity", options.medium.inner},
          {"outer_permittivity", options.medium.outer},
          {"ionic_strength_mM", options.medium.ionic_strength},
          {"temperature_K", options.medium.temperature},
          {"surface_tension_kcal_per_mol_A2", options.surface_tension},
          {"pressure_kcal_per_mol_A3", options.pressure},
          {"accuracy", options.accuracy},
          {"residual", options.residual},
          {"restart", options.restart},
          {"block", options.block},
          {"max_iterations", options.max_iterations}};
}

}  // namespace smopt::metrics
