#include "baselines/cgal/angle_method.h"

#include <fmt/format.h>

#include "baselines/cgal/cgal_report.h"

namespace smopt::baselines {

std::vector<MethodOption> angle_area_options() {
  using Kind = MethodOption::Kind;
  const AngleAreaOptions defaults;
  return {
      {"rounds", Kind::integer, fmt::format("{}", defaults.rounds), "", "number_of_iterations; CGAL's default is 1, its example's 10", {}},
      switch_option("safety", defaults.has_safety_constraints,
                    "use_safety_constraints: refuse moves that turn a triangle or lessen the smallest angle; stop where the surface "
                    "intersects itself"),
      switch_option("project", defaults.projects, "do_project: put every vertex back onto the initial surface")};
}

AngleAreaOptions read_angle_area_options(const OptionValues& values) {
  AngleAreaOptions options;
  options.rounds = values.integer("rounds", 0);
  options.has_safety_constraints = is_on(values, "safety");
  options.projects = is_on(values, "project");
  return options;
}

MethodReport run_angle_area(TriangleMesh& mesh, const AngleAreaOptions& options, const ProgressCallback& progress) {
  MethodReport report;
  const AngleAreaReport outcome = timed(report.seconds, "smoothing", [&] { return smooth_angles_and_areas(mesh, options, progress); });
  report_cgal_rounds(report, outcome.complete_rounds);
  if (outcome.met_itself) {
    report.stopped_because = fmt::format("self-intersection in round {}", outcome.complete_rounds + 1);
    report.notes.push_back(
        fmt::format("CGAL stopped in round {} of {} and left the surface as it was then: it intersected itself. --safety off goes on.",
                    outcome.complete_rounds + 1, options.rounds));
  }
  return report;
}

Method angle_method() {
  return {"cgal_angle",
          "CGAL's angle smoothing: vertices move to bisect their neighbours' angles, and back onto the surface",
          "CGAL 5.5, Polygon_mesh_processing::angle_and_area_smoothing, 2022; Surazhsky & Gotsman, Eng. Comput. 20:147, 2004",
          CavityPolicy::keep,
          angle_area_options(),
          [](TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
            return run_angle_area(mesh, read_angle_area_options(values), progress);
          },
          "without the smoothing of areas, which is cgal_area, and so without its Delaunay flips; no vertex or edge is constrained"};
}

}  // namespace smopt::baselines
