#include "experiments/remesh_study/study_case.h"

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <limits>

#include "experiments/record_set.h"
#include "experiments/remesh_study/simulations.h"
#include "experiments/remesh_study/worst_places.h"
#include "experiments/solvation_plan.h"
#include "metrics/dihedral.h"
#include "metrics/distance.h"
#include "metrics/vertex_spacing.h"
#include "smopt/error.h"
#include "smopt/improve/prepare.h"
#include "smopt/io/off.h"
#include "smopt/io/sha256.h"

namespace smopt::experiments {
namespace {

constexpr int kTwoThreads = 2;

/// \throws NotInstalled when there is no such method.
const Method& find_method(const MethodRegistry& registry, const std::string& name) {
  const auto found = std::ranges::find(registry.all(), name, &Method::name);
  if (found == registry.all().end()) throw NotInstalled(fmt::format("no method {} in this program", name));
  return *found;
}

OptionValues options_of(const MethodCase& method_case, const Method& method, const StudyPlan& plan) {
  std::map<std::string, std::string> given = method_case.options;
  if (!method_case.vertices_of.empty()) {
    if (!plan.vertices) throw MethodFailed("the number of vertices to ask for is not known");
    given["vertices"] = fmt::format("{}", *plan.vertices);
  }
  return {method.options, given};
}

double diagonal_of(const TriangleMesh& mesh) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& p : mesh.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return mesh.points.empty() ? 0 : (high - low).norm();
}

Json distance_to_input(const TriangleMesh& mesh, const TriangleMesh& input) {
  std::vector<std::string> ignored;
  const auto distance = metrics::surface_distance(mesh, input, ignored);
  if (!distance) return nullptr;
  return {{"mean", std::max(distance->to_reference.mean, distance->from_reference.mean)},
          {"largest", distance->hausdorff},
          {"diagonal", diagonal_of(input)}};
}

Json json_of(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

Json tetgen_ready(const TriangleMesh& mesh) {
  return {{"smallest_dihedral_deg", json_of(metrics::smallest_dihedral_deg(mesh))},
          {"vertex_spacing", json_of(metrics::smallest_vertex_spacing(mesh))}};
}

void add_geometry(Json& record, const StudyMesh& study, const TriangleMesh& mesh, const StudyPlan& plan) {
  record["worst"] = to_json(find_worst_places(mesh));
  record["tetgen_ready"] = tetgen_ready(mesh);
  if (!plan.with_distances) return;
  record["distance_to_input"] = distance_to_input(mesh, study.input.mesh);
  if (study.level_set)
    record["level_set_distance"] = {{"before", to_json(study.input_distance)}, {"after", to_json(study.level_set->distance(mesh))}};
}

std::vector<TetgenTrial> trials_of(const StudyPlan& plan) {
  return tetgen_trials(plan.with_quality_tetrahedra ? kSmopt2 : "");
}

Json solvation_in(const StudyMesh& study, const TriangleMesh& mesh, const StudyPlan& plan) {
  if (!plan.with_solvation) return no_solvation("not asked for");
  if (!study.molecule) return no_solvation("no molecule");
  if (std::max(mesh.vertex_count(), study.input.mesh.vertex_count()) > plan.most_solved_vertices)
    return no_solvation(fmt::format("more than {} vertices", plan.most_solved_vertices));
  return solvation_of(mesh, *study.molecule, SolvationSettings().max_memory_bytes);
}

void add_uses(Json& record, const StudyMesh& study, const TriangleMesh& mesh, const StudyPlan& plan) {
  if (plan.with_tetrahedra) record["tetgen"] = tetgen_of(mesh, trials_of(plan));
  record["solvation"] = solvation_in(study, mesh, plan);
}

/// As `run_method_case` times it: from the initial mesh on.
void add_two_threads(Json& record, const StudyMesh& study, const Method& method, const OptionValues& options) {
  TriangleMesh mesh = study.initial;
  tbb::task_arena two_threads(kTwoThreads);
  const Stopwatch watch;
  two_threads.execute([&] {
    prepare(mesh, CavityPolicy::delete_cavities);
    method.run(mesh, options, {});
  });
  const double seconds = watch.elapsed().wall;
  record["two_threads"] = {{"seconds", seconds}, {"same_bytes", sha256_hex(format_off(mesh, {})) == record.at("output").at("sha256")}};
}

/// The mesh without its cavities: before and after are the same.
void record_input(Json& record, const StudyMesh& study, const StudyPlan& plan) {
  record["metrics"] = {{"before", study.input.metrics}, {"after", study.input.metrics}};
  record["output"] = {{"vertices", study.input.mesh.vertex_count()}, {"sha256", study.input.sha256}};
  add_geometry(record, study, study.input.mesh, plan);
  add_uses(record, study, study.input.mesh, plan);
}

void record_method(Json& record, const StudyMesh& study, const MethodCase& method_case, const MethodRegistry& registry,
                   const StudyPlan& plan) {
  const Method& method = find_method(registry, method_case.method);
  const OptionValues options = options_of(method_case, method, plan);
  const TriangleMesh mesh = run_method_case(record, method, options, study.initial, study.input, 1, {});
  add_geometry(record, study, mesh, plan);
  add_uses(record, study, mesh, plan);
  if (plan.with_two_threads) add_two_threads(record, study, method, options);
}

}  // namespace

Json run_study_case(const StudyMesh& mesh, const MethodCase& method_case, const MethodRegistry& registry, const StudyPlan& plan) {
  Json record = record_header(mesh.dataset, method_case.name);
  record_outcome(record, [&] {
    if (method_case.name == kInitial)
      record_input(record, mesh, plan);
    else
      record_method(record, mesh, method_case, registry, plan);
  });
  return record;
}

std::optional<std::size_t> vertices_of(const Json& record) {
  const auto vertices = number_at(&record, "/output/vertices");
  return vertices ? std::optional(static_cast<std::size_t>(*vertices)) : std::nullopt;
}

}  // namespace smopt::experiments
