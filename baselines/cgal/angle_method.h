#pragma once

#include "baselines/cgal/angle_area_smoothing.h"
#include "smopt/improve/method.h"

namespace smopt::baselines {

/// The options that CGAL's smoothing of angles and that of areas have in common, with the defaults of `AngleAreaOptions`.
std::vector<MethodOption> angle_area_options();
AngleAreaOptions read_angle_area_options(const OptionValues& values);

/// Runs CGAL and reports, with a note where it stopped before the last round.
MethodReport run_angle_area(TriangleMesh& mesh, const AngleAreaOptions& options, const ProgressCallback& progress);

/// `cgal_angle` of the registry: CGAL's smoothing of angles alone.
Method angle_method();

}  // namespace smopt::baselines
