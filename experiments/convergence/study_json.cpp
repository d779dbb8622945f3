#include "experiments/convergence/study_json.h"

#include <string>

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const std::optional<double>& number) {
  return number ? Json(*number) : Json();
}

Json json_of(const Size& size) {
  return {{"vertices", size.vertices}, {"euler_characteristic", size.euler_characteristic}, {"area", size.area}, {"volume", size.volume}};
}

Json json_of(const SurfaceSummary& surface) {
  return {{"all", json_of(surface.all)},      {"main", json_of(surface.main)},
          {"components", surface.components}, {"cavities", surface.cavities},
          {"specks", surface.specks},         {"edge_ratio", {{"edges", surface.edge_ratio.edges}, {"counts", surface.edge_ratio.counts}}}};
}

Json json_of(const Nearness& nearness) {
  return {{"largest", nearness.distance.largest},
          {"mean", nearness.distance.mean},
          {"unresolved", nearness.distance.unresolved},
          {"bent_sharper_share", nearness.sharp_share}};
}

Json json_of(const AdaptiveRow& row) {
  return {{"error", row.error}, {"smallest_cell", row.finest_edge}, {"surface", json_of(row.surface)}, {"distance", json_of(row.nearness)}};
}

Json json_of(const UniformRow& row) {
  return {{"spacing", row.spacing}, {"surface", json_of(row.surface)}, {"distance", row.nearness ? json_of(*row.nearness) : Json()}};
}

Json json_of(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Json json_of(const ExplainingPoint& point, double isovalue) {
  return {{"position", json_of(point.point.position)},
          {"index", point.point.index()},
          {"value_minus_isovalue", point.point.value - isovalue},
          {"curvatures", json_of(point.point.curvatures)},
          {"ratio", point.ratio},
          {"interpolant_coarser", json_of(point.coarser)},
          {"interpolant_finer", json_of(point.finer)}};
}

Json json_of(const ExplainedChange& change, double isovalue) {
  Json points = Json::array();
  for (const ExplainingPoint& point : change.points) points.push_back(json_of(point, isovalue));
  return {{"euler_change", change.place.change},          {"cells", change.place.cells},
          {"specks_before", change.specks_before},        {"specks_after", change.specks_after},
          {"explanation", to_string(change.explanation)}, {"critical_points", std::move(points)},
          {"largest_distance", change.largest_distance},  {"least_bend_radius", json_of(change.least_bend_radius)}};
}

Json json_of(const ChangeStep& step, double isovalue) {
  Json changes = Json::array();
  for (const ExplainedChange& change : step.changes) changes.push_back(json_of(change, isovalue));
  return {{"coarser_error", step.coarser_error}, {"finer_error", step.finer_error}, {"changes", std::move(changes)}};
}

Json json_of(const Limit& limit) {
  return {{"value", limit.value}, {"residual", limit.residual}, {"order", limit.order}};
}

Json json_of(const PublishedComparison& comparison) {
  const PublishedMesh& mesh = comparison.published;
  return {{"published",
           {{"option_e", mesh.option_e},
            {"vertices", mesh.vertices},
            {"components", mesh.components},
            {"euler_characteristic", mesh.euler_characteristic},
            {"euler_characteristic_main", mesh.euler_characteristic_main},
            {"area", json_of(mesh.area)},
            {"volume", json_of(mesh.volume)}}},
          {"ours", json_of(comparison.ours)}};
}

Json json_of(const MoleculeStudy& study);

template <class Rows>
Json array_of(const Rows& rows) {
  Json array = Json::array();
  for (const auto& row : rows) array.push_back(json_of(row));
  return array;
}

Json json_of(const MoleculeStudy& study) {
  Json steps = Json::array();
  for (const ChangeStep& step : study.steps) steps.push_back(json_of(step, study.dataset.surface.isovalue));
  return {{"molecule", study.dataset.name},
          {"atoms", study.atoms},
          {"decay", study.dataset.surface.decay},
          {"isovalue", study.dataset.surface.isovalue},
          {"raised_radii", study.raised_radii},
          {"adaptive", array_of(study.adaptive)},
          {"uniform", array_of(study.uniform)},
          {"limits",
           {{"area", json_of(study.area)},
            {"volume", json_of(study.volume)},
            {"main_area", json_of(study.main_area)},
            {"main_volume", json_of(study.main_volume)}}},
          {"published", array_of(study.published)},
          {"changes", std::move(steps)}};
}

}  // namespace

Json study_json(std::span<const MoleculeStudy> studies) {
  return {{"published_program", {{"name", published_figures().program}, {"source", published_figures().source}}},
          {"molecules", array_of(studies)}};
}

}  // namespace smopt::experiments
