#include "baselines/cgal/angle_area_smoothing.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/angle_and_area_smoothing.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>
#ifdef CGAL_PMP_USE_CERES_SOLVER
#include <glog/logging.h>
#endif

#include <cassert>
#include <utility>

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

void require_areas(const Surface& surface) {
  for (const auto f : surface.faces())
    if (pmp::is_degenerate_triangle_face(f, surface))
      throw MethodFailed(fmt::format("CGAL smooths no triangle without area: face {}", static_cast<FaceId>(f)));
}

/// As long as it lives, Ceres, which smooths areas, prints nothing about a vertex that it cannot improve.
#ifdef CGAL_PMP_USE_CERES_SOLVER
class QuietCeres {
 public:
  QuietCeres() : level_(std::exchange(FLAGS_minloglevel, google::GLOG_FATAL)) {}
  QuietCeres(const QuietCeres&) = delete;
  QuietCeres& operator=(const QuietCeres&) = delete;
  ~QuietCeres() { FLAGS_minloglevel = level_; }

 private:
  google::int32 level_;
};
#else
struct QuietCeres {};
#endif

/// How often CGAL asks whether a vertex is constrained, in units of the number of vertices: once in a pass that moves each vertex at once
/// (areas) or projects it, twice in one that moves all at its end (angles).
struct Passes {
  explicit Passes(const AngleAreaOptions& options)
      : areas(options.smooths_areas ? 1U : 0U), angles(options.smooths_angles ? 2U : 0U), projection(options.projects ? 1U : 0U) {}

  [[nodiscard]] std::size_t a_round() const { return areas + angles + projection * ((areas > 0 ? 1U : 0U) + (angles > 0 ? 1U : 0U)); }

  std::size_t areas, angles, projection;
};

}  // namespace

bool has_area_smoothing() {
#ifdef CGAL_PMP_USE_CERES_SOLVER
  return true;
#else
  return false;
#endif
}

AngleAreaReport smooth_angles_and_areas(TriangleMesh& mesh, const AngleAreaOptions& options, const ProgressCallback& progress) {
  assert(!options.smooths_areas || has_area_smoothing());
  require_surface(mesh, Borders::rejected);
  remove_isolated_vertices(mesh);
  auto surface = to_surface<Surface>(mesh);
  require_areas(surface);
  const std::size_t visits_a_round = Passes(options).a_round() * mesh.vertex_count();
  if (options.rounds == 0 || visits_a_round == 0) return {};
  CallWatch watch(progress, "smoothing", visits_a_round * static_cast<std::size_t>(options.rounds));
  [[maybe_unused]] const QuietCeres quiet;
  call_cgal([&] {
    pmp::angle_and_area_smoothing(surface, CGAL::parameters::number_of_iterations(static_cast<unsigned>(options.rounds))
                                               .use_angle_smoothing(options.smooths_angles)
                                               .use_area_smoothing(options.smooths_areas)
                                               .use_safety_constraints(options.has_safety_constraints)
                                               .use_Delaunay_flips(options.flips_edges)
                                               .do_project(options.projects)
                                               .vertex_is_constrained_map(WatchedVisits<Surface>{&watch})
                                               .geom_traits(Kernel()));
  });
  mesh = from_surface(surface);
  require_finite_result(mesh);
  const auto complete = static_cast<int>(watch.counted() / visits_a_round);
  return {complete, complete < options.rounds};
}

}  // namespace smopt::baselines
