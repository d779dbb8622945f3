#include "baselines/cgal/remesh_method.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

#include "baselines/cgal/cgal_report.h"
#include "baselines/cgal/isotropic_remeshing.h"
#include "baselines/cgal/surface_conversion.h"
#include "baselines/cgal/vertex_search.h"
#include "baselines/vertex_target.h"
#include "smopt/error.h"
#include "smopt/geometry/triangle_shape.h"

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

/// Edge length² × vertices of equilateral triangles in whose place the surface would be, Å²: each vertex has the area of two.
double length_squared_times_vertices(const TriangleMesh& mesh) {
  double doubled_area = 0;
  for (const auto& [a, b, c] : mesh.triangles) doubled_area += doubled_area_vector(mesh.points[a], mesh.points[b], mesh.points[c]).norm();
  if (!(doubled_area > 0)) throw MethodFailed("CGAL cannot remesh a surface without area");
  return doubled_area / std::numbers::sqrt3;
}

/// More vertices than this are a slip rather than a wish: they take about 50 GB.
constexpr double kMostVertices = 1e8;

void require_feasible(const TriangleMesh& mesh, double edge_length) {
  const double vertices = length_squared_times_vertices(mesh) / (edge_length * edge_length);
  if (vertices > kMostVertices)
    throw InvalidOption(
        fmt::format("--edge-length: {} Å would take about {:.1e} vertices, more than {:.0e}", edge_length, vertices, kMostVertices));
}

void remesh_to_length(TriangleMesh& mesh, RemeshingOptions options, MethodReport& report, const ProgressCallback& progress) {
  if (options.edge_length == 0) options.edge_length = mean_edge_length(mesh);
  require_feasible(mesh, options.edge_length);
  timed(report.seconds, "smoothing", [&] { remesh_isotropically(mesh, options, progress); });
  report.notes.push_back(fmt::format("Remeshed with the edge length {:.6g} Å.", options.edge_length));
}

/// The time of the run that gave the result is "smoothing"; that of the others, which whoever knew the edge length would not need, is
/// "search".
void remesh_to_vertices(TriangleMesh& mesh, std::size_t target, RemeshingOptions options, MethodReport& report,
                        const ProgressCallback& progress) {
  if (static_cast<double>(target) > kMostVertices)
    throw InvalidOption(fmt::format("{} vertices were asked for, more than {:.0e}", target, kMostVertices));
  const Stopwatch stopwatch;
  std::map<double, Seconds> runs;  // by edge length
  const double first_length = std::sqrt(length_squared_times_vertices(mesh) / static_cast<double>(target));
  VertexSearchResult found = search_vertex_count(target, first_length, [&](double edge_length) {
    const Stopwatch run;
    TriangleMesh copy = mesh;
    options.edge_length = edge_length;
    remesh_isotropically(copy, options, progress);
    runs[edge_length] = run.elapsed();
    return copy;
  });
  mesh = std::move(found.mesh);
  const Seconds all = stopwatch.elapsed(), last = runs.at(found.edge_length);
  report.seconds = {{"smoothing", last}, {"search", {all.wall - last.wall, all.cpu - last.cpu}}};
  report.notes.push_back(fmt::format("Remeshed with the edge length {:.6g} Å: {} vertices of {} asked for, after {} runs{}.",
                                     found.edge_length, mesh.vertex_count(), target, found.runs,
                                     found.is_near ? "" : "; missed by more than 1 %"));
}

MethodReport run_remesh(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const RemeshingOptions options = read_options(values);
  require_surface(mesh, Borders::rejected);
  const std::optional<std::size_t> target = vertex_target(values);
  if (target && options.edge_length > 0) throw InvalidOption("--edge-length cannot be given with --vertices or --match");
  MethodReport report;
  if (target)
    remesh_to_vertices(mesh, *target, options, report, progress);
  else
    remesh_to_length(mesh, options, report, progress);
  report_cgal_rounds(report, options.rounds);
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
