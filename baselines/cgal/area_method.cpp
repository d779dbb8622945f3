#include "baselines/cgal/area_method.h"

#include "baselines/cgal/angle_method.h"
#include "baselines/cgal/cgal_report.h"
#include "smopt/error.h"

namespace smopt::baselines {
namespace {

constexpr const char* kNotBuilt = "not built: Ceres was not found (libceres-dev)";

MethodReport run_area(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  AngleAreaOptions options = read_angle_area_options(values);
  options.smooths_areas = true;
  options.flips_edges = is_on(values, "flips");
  return run_angle_area(mesh, options, progress);
}

std::vector<MethodOption> area_options() {
  std::vector<MethodOption> options = angle_area_options();
  options.push_back(switch_option("flips", AngleAreaOptions().flips_edges, "use_Delaunay_flips: flip edges after each smoothing of areas"));
  return options;
}

MethodReport run_nothing(TriangleMesh& /*mesh*/, const OptionValues& /*values*/, const ProgressCallback& /*progress*/) {
  throw NotInstalled(std::string("cgal_area: ") + kNotBuilt);
}

}  // namespace

Method area_method(bool is_built) {
  return {
      "cgal_area",
      "CGAL's area and angle smoothing: areas alike around each vertex, Delaunay flips, then angles, and back onto the surface",
      "CGAL 5.5, Polygon_mesh_processing::angle_and_area_smoothing, 2022; Surazhsky & Gotsman, Eng. Comput. 20:147, 2004",
      CavityPolicy::keep,
      area_options(),
      is_built ? run_area : run_nothing,
      is_built
          ? "no vertex or edge is constrained; a non-linear solver (Ceres) runs at each vertex, which takes about 50 µs a vertex and round"
          : kNotBuilt};
}

}  // namespace smopt::baselines
