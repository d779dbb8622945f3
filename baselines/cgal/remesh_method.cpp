#include "baselines/cgal/remesh_method.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "baselines/cgal/cgal_report.h"
#include "baselines/cgal/isotropic_remeshing.h"
#include "baselines/cgal/vertex_search.h"
#include "baselines/vertex_target.h"
#include "smopt/error.h"

namespace smopt::baselines {
namespace {

RemeshingOptions read_options(const OptionValues& values) {
  RemeshingOptions options;
  options.edge_length = values.number("edge-length", 0);
  options.rounds = values.integer("rounds", 0);
  options.relax_rounds = values.integer("relax-rounds", 0);
  options.splits = is_on(values, "split");
  options.collapses = is_on(values, "collapse");
  options.flips = is_on(values, "flip");
  options.projects = is_on(values, "project");
  return options;
}

void remesh_to_length(TriangleMesh& mesh, RemeshingOptions options, MethodReport& report, const ProgressCallback& progress) {
  if (options.edge_length == 0) options.edge_length = mean_edge_length(mesh);
  timed(report.seconds, "smoothing", [&] { remesh_isotropically(mesh, options, progress); });
  report.notes.push_back(fmt::format("Remeshed with the edge length {:.6g} Å.", options.edge_length));
}

/// The edge length of equilateral triangles in whose place the surface would have this many vertices: each vertex has the area of two.
double equilateral_length(const TriangleMesh& mesh, std::size_t vertices) {
  double doubled_area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    doubled_area += (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm();
  return std::sqrt(doubled_area / (std::numbers::sqrt3 * static_cast<double>(vertices)));
}

/// The time of the run that gave the result is "smoothing"; that of the others, which whoever knew the edge length would not need, is
/// "edge length".
void remesh_to_vertices(TriangleMesh& mesh, std::size_t target, RemeshingOptions options, MethodReport& report,
                        const ProgressCallback& progress) {
  const Stopwatch stopwatch;
  std::vector<std::pair<double, Seconds>> runs;
  VertexSearchResult found = search_vertex_count(target, equilateral_length(mesh, target), [&](double edge_length) {
    const Stopwatch run;
    TriangleMesh copy = mesh;
    options.edge_length = edge_length;
    remesh_isotropically(copy, options, progress);
    runs.emplace_back(edge_length, run.elapsed());
    return copy;
  });
  mesh = std::move(found.mesh);
  const Seconds all = stopwatch.elapsed();
  for (const auto& [length, time] : runs) {
    if (length != found.edge_length) continue;
    report.seconds = {{"smoothing", time}, {"edge length", {all.wall - time.wall, all.cpu - time.cpu}}};
    break;
  }
  report.notes.push_back(fmt::format("Remeshed with the edge length {:.6g} Å: {} vertices of {} asked for, after {} runs{}.",
                                     found.edge_length, mesh.vertex_count(), target, found.runs,
                                     found.is_near ? "" : "; missed by more than 1 %"));
}

MethodReport run_remesh(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const RemeshingOptions options = read_options(values);
  const std::optional<std::size_t> target = vertex_target(values);
  if (target && options.edge_length > 0) throw InvalidOption("--edge-length cannot be given with --vertices or --match");
  MethodReport report;
  if (target)
    remesh_to_vertices(mesh, *target, options, report, progress);
  else
    remesh_to_length(mesh, options, report, progress);
  report_cgal_rounds(report, mesh.vertex_count(), options.rounds);
  return report;
}

std::vector<MethodOption> remesh_options() {
  using Kind = MethodOption::Kind;
  const RemeshingOptions defaults;
  std::vector<MethodOption> options = {
      {"edge-length", Kind::number, fmt::format("{}", defaults.edge_length), "Å", "length of the edges; 0: the mean of the mesh's", {}},
      {"rounds", Kind::integer, fmt::format("{}", defaults.rounds), "", "number_of_iterations; CGAL's default is 1, its example's 3", {}},
      {"relax-rounds", Kind::integer, fmt::format("{}", defaults.relax_rounds), "", "number_of_relaxation_steps in each round", {}},
      switch_option("split", defaults.splits, "do_split: split edges longer than 4/3 of the length"),
      switch_option("collapse", defaults.collapses, "do_collapse: collapse edges shorter than 4/5 of the length"),
      switch_option("flip", defaults.flips, "do_flip: flip edges towards valence 6"),
      switch_option("project", defaults.projects, "do_project: put every vertex back onto the initial surface")};
  for (MethodOption& option : vertex_target_options()) options.push_back(std::move(option));
  return options;
}

}  // namespace

Method remesh_method() {
  return {"cgal_remesh",
          "CGAL's isotropic remeshing: splits, collapses, flips, and relaxes towards one edge length, and back onto the surface",
          "CGAL 5.5, Polygon_mesh_processing::isotropic_remeshing, 2022; Botsch & Kobbelt, Symp. Geometry Processing, 2004",
          CavityPolicy::keep,
          remesh_options(),
          run_remesh,
          "no vertex or edge is constrained; a number of vertices is met by running it up to six times with other edge lengths"};
}

}  // namespace smopt::baselines
