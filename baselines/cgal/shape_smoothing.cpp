#include "baselines/cgal/shape_smoothing.h"

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/smooth_shape.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include "baselines/cgal/call_watch.h"
#include "baselines/cgal/cgal_call.h"
#include "baselines/cgal/cgal_report.h"
#include "baselines/cgal/surface_conversion.h"
#include "smopt/error.h"
#include "smopt/mesh/compact.h"

namespace smopt::baselines {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Solver = CGAL::Eigen_solver_traits<Eigen::BiCGSTAB<CGAL::Eigen_sparse_matrix<double>::EigenType, Eigen::IncompleteLUT<double>>>;
namespace pmp = CGAL::Polygon_mesh_processing;

/// In each round CGAL writes every vertex twice: the solution, and scaled.
constexpr std::size_t kWritesARound = 2;

MethodReport run_shape(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const ShapeOptions options{values.integer("rounds", 0), values.number("time", 0)};
  if (options.time == 0) throw InvalidOption("--time: expected a number above 0, got '0'");
  MethodReport report;
  const int rounds = timed(report.seconds, "smoothing", [&] { return smooth_shape(mesh, options, progress); });
  report_cgal_rounds(report, rounds);
  if (rounds < options.rounds) report.stopped_because = fmt::format("CGAL's solver failed in round {}", rounds + 1);
  return report;
}

}  // namespace

int smooth_shape(TriangleMesh& mesh, const ShapeOptions& options, const ProgressCallback& progress) {
  require_surface(mesh, Borders::rejected);
  remove_isolated_vertices(mesh);
  auto surface = to_surface<Surface>(mesh);
  const std::size_t writes = kWritesARound * mesh.vertex_count();
  CallWatch watch(progress, "smoothing", writes * static_cast<std::size_t>(options.rounds));
  call_cgal([&] {
    pmp::smooth_shape(surface.faces(), surface, options.time,
                      CGAL::parameters::number_of_iterations(static_cast<unsigned>(options.rounds))
                          .sparse_linear_solver(Solver())
                          .vertex_point_map(WatchedPoints<Surface>{&surface, &watch})
                          .geom_traits(Kernel()));
  });
  const auto rounds = static_cast<int>(watch.counted() / writes);
  if (rounds == 0 && options.rounds > 0) throw MethodFailed("CGAL: the linear solver failed in the first round");
  copy_points(surface, mesh.points);
  require_finite_result(mesh);
  return rounds;
}

Method shape_method() {
  using Kind = MethodOption::Kind;
  const ShapeOptions defaults;
  return {
      "cgal_shape",
      "CGAL's shape smoothing: implicit mean curvature flow, which smooths the surface rather than its triangles",
      "CGAL 5.5, Polygon_mesh_processing::smooth_shape, 2022; Kazhdan, Solomon & Ben-Chen, Comput. Graph. Forum 31:1745, 2012",
      CavityPolicy::keep,
      {{"rounds", Kind::integer, fmt::format("{}", defaults.rounds), "", "number_of_iterations; CGAL's default is 1, its example's 10", {}},
       {"time", Kind::number, fmt::format("{}", defaults.time), "Å²", "time step of a round; CGAL's example's by default", {}}},
      run_shape,
      "the flow shrinks every surface; CGAL 5.5 scales the whole mesh back to its volume after each round (do_scale came later), so thin "
      "parts shrink and thick ones grow; no vertex is constrained"};
}

}  // namespace smopt::baselines
