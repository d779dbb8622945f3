#include "baselines/cgal/surface_conversion.h"

#include "smopt/error.h"
#include "smopt/mesh/validity.h"

namespace smopt::baselines {

void require_surface(const TriangleMesh& mesh, Borders borders) {
  ValidityReport report = check_validity(mesh);
  if (borders == Borders::allowed) report.boundary_edges = {};
  if (const std::string faults = report.describe(); !faults.empty()) throw InvalidMesh("not a surface for CGAL: " + faults);
}

}  // namespace smopt::baselines
