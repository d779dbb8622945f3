#include "baselines/cgal/isotropic_remeshing.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include "baselines/cgal/call_watch.h"
#include "baselines/cgal/cgal_call.h"
#include "baselines/cgal/surface_conversion.h"
#include "smopt/error.h"
#include "smopt/mesh/compact.h"

namespace smopt::baselines {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

}  // namespace

double mean_edge_length(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
    sum += (q - p).norm() + (r - q).norm() + (p - r).norm();
  }
  return sum / (3 * static_cast<double>(mesh.triangle_count()));
}

void remesh_isotropically(TriangleMesh& mesh, const RemeshingOptions& options, const ProgressCallback& progress) {
  require_surface(mesh, Borders::rejected);
  remove_isolated_vertices(mesh);
  auto surface = to_surface<Surface>(mesh);
  CallWatch watch(progress, "remeshing", 0);
  call_cgal([&] {
    pmp::isotropic_remeshing(surface.faces(), options.edge_length, surface,
                             CGAL::parameters::number_of_iterations(static_cast<unsigned>(options.rounds))
                                 .number_of_relaxation_steps(static_cast<unsigned>(options.relax_rounds))
                                 .do_split(options.splits)
                                 .do_collapse(options.collapses)
                                 .do_flip(options.flips)
                                 .do_project(options.projects)
                                 .protect_constraints(false)
                                 .collapse_constraints(true)
                                 .relax_constraints(false)
                                 .vertex_point_map(WatchedPoints<Surface>{&surface, &watch})
                                 .geom_traits(Kernel()));
  });
  surface.collect_garbage();
  if (surface.number_of_faces() == 0) throw MethodFailed("CGAL: nothing is left of the surface");
  mesh = from_surface(surface);
  require_finite_result(mesh);
}

}  // namespace smopt::baselines
