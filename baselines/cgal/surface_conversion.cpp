#include "baselines/cgal/surface_conversion.h"

#include <fmt/format.h>

#include "smopt/error.h"
#include "smopt/mesh/validity.h"

namespace smopt::baselines {
namespace {

/// CGAL multiplies up to six coordinates (squared volumes), and ends the process when the product is infinite.
constexpr double kLargestCoordinate = 1e50;

}  // namespace

void require_surface(const TriangleMesh& mesh, Borders borders) {
  ValidityReport report = check_validity(mesh);
  if (borders == Borders::allowed) report.boundary_edges = {};
  if (const std::string faults = report.describe(); !faults.empty()) throw InvalidMesh("not a surface for CGAL: " + faults);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.points[v].cwiseAbs().maxCoeff() > kLargestCoordinate)
      throw InvalidMesh(fmt::format("vertex {} is beyond {:.0e}: its powers overflow in CGAL", v, kLargestCoordinate));
}

}  // namespace smopt::baselines
