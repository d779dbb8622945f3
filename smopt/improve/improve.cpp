#include "smopt/improve/improve.h"

#include "smopt/mesh/orientation.h"

namespace smopt {

ImproveReport improve(TriangleMesh& mesh, const ImproveOptions& options, const ProgressCallback& progress) {
  ImproveReport report;
  report.preparation = prepare(mesh, options.cavities);
  report.seconds = report.preparation.seconds;
  improve_prepared(mesh, options, report, progress);
  return report;
}

void improve_prepared(TriangleMesh& mesh, const ImproveOptions& options, ImproveReport& report, const ProgressCallback& progress) {
  report.redundant = timed(report.seconds, "redundant", [&] {
    return options.deletes_redundant_points ? remove_redundant_points(mesh, options.redundant, progress) : RedundantPointReport{};
  });
  report.volume_before_smoothing = signed_volume(mesh);
  report.smoothing = timed(report.seconds, "smoothing", [&] { return smooth(mesh, options.smoothing, progress); });
  report.volume_after_smoothing = signed_volume(mesh);
}

}  // namespace smopt
