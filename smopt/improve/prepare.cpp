#include "smopt/improve/prepare.h"

#include <algorithm>
#include <cmath>

#include "smopt/mesh/compact.h"
#include "smopt/mesh/components.h"
#include "smopt/mesh/orientation.h"

namespace smopt {
namespace {

bool points_inwards(const TriangleMesh& mesh, const Components& components) {
  const std::vector<double> volumes = component_volumes(mesh, components);
  const auto largest = std::max_element(volumes.begin(), volumes.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  return largest != volumes.end() && *largest < 0;
}

/// Returns the components of the mesh as it is then.
Components check_and_orient(TriangleMesh& mesh, PreparationReport& report) {
  report.validity = check_validity(mesh);
  require_closed_manifold(report.validity);
  if (report.validity.isolated_vertices > 0) report.isolated_vertices = remove_isolated_vertices(mesh);
  if (!report.validity.is_oriented()) report.turned_triangles = orient_consistently(mesh);
  Components components = connected_components(mesh);
  report.was_inward = points_inwards(mesh, components);
  if (report.was_inward) reverse_orientation(mesh);
  return components;
}

}  // namespace

PreparationReport prepare(TriangleMesh& mesh, CavityPolicy cavities) {
  PreparationReport report;
  const Components components = timed(report.seconds, "validity", [&] { return check_and_orient(mesh, report); });
  report.cavities = timed(report.seconds, "cavities", [&] { return remove_cavities(mesh, components, cavities); });
  return report;
}

}  // namespace smopt
