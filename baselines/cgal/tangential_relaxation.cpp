#include "baselines/cgal/tangential_relaxation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/tangential_relaxation.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include "baselines/cgal/cgal_call.h"
#include "baselines/cgal/cgal_report.h"
#include "baselines/cgal/surface_conversion.h"
#include "smopt/mesh/compact.h"

namespace smopt::baselines {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

MethodReport run_tangential(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const TangentialOptions options{values.integer("rounds", 0)};
  MethodReport report;
  timed(report.seconds, "smoothing", [&] { relax_tangentially(mesh, options, progress); });
  report_cgal_rounds(report, options.rounds);
  return report;
}

}  // namespace

void relax_tangentially(TriangleMesh& mesh, const TangentialOptions& options, const ProgressCallback& progress) {
  require_surface(mesh, Borders::rejected);
  remove_isolated_vertices(mesh);
  auto surface = to_surface<Surface>(mesh);
  for (int round = 0; round < options.rounds; ++round) {
    report_progress(progress, "smoothing", static_cast<double>(round) / options.rounds);
    call_cgal([&] {
      pmp::tangential_relaxation(
          surface.vertices(), surface,
          CGAL::parameters::number_of_iterations(1U).relax_constraints(false).geom_traits(Kernel()).vertex_point_map(surface.points()));
    });
  }
  copy_points(surface, mesh.points);
  require_finite_result(mesh);
}

Method tangential_method() {
  using Kind = MethodOption::Kind;
  const TangentialOptions defaults;
  return {
      "cgal_tangential",
      "CGAL's tangential relaxation: towards the mean of the neighbours within the tangent plane",
      "CGAL 5.5, Polygon_mesh_processing::tangential_relaxation, 2022; Botsch & Kobbelt, Symp. Geometry Processing, 2004",
      CavityPolicy::keep,
      {{"rounds",
        Kind::integer,
        fmt::format("{}", defaults.rounds),
        "",
        "number_of_iterations; CGAL's default is 1, its example's 10",
        {}}},
      run_tangential,
      "nothing projects back onto the surface; no vertex or edge is constrained, so relax_constraints is off, and every move is allowed "
      "(allow_move_functor)"};
}

}  // namespace smopt::baselines
