#include "experiments/convergence/surface_summary.h"

#include <algorithm>
#include <string>
#include <vector>

#include "experiments/convergence/change_explanation.h"
#include "metrics/extent.h"
#include "metrics/shape.h"
#include "metrics/topology.h"
#include "smopt/improve/cavities.h"
#include "smopt/mesh/components.h"

namespace smopt::experiments {
namespace {

/// The bend of the level set is looked at under every so many vertices: some thousand of them tell a share to a per cent.
constexpr std::size_t kBendStride = 25;

Size size_of(const TriangleMesh& mesh) {
  std::vector<std::string> notes;
  const metrics::Topology topology = metrics::measure_topology(mesh, notes);
  const metrics::Extent extent = metrics::measure_extent(mesh, topology, notes);
  return {mesh.vertex_count(), topology.euler_characteristic, extent.area.value(), extent.volume.value()};
}

std::size_t count_specks(const Components& components) {
  const std::vector<std::size_t> vertices = vertices_of(components);
  return static_cast<std::size_t>(std::count_if(vertices.begin(), vertices.end(), [](std::size_t n) { return n <= kSpeckVertices; }));
}

double sharp_share(const TriangleMesh& mesh, const GaussianField& field, double isovalue, double sharp_below) {
  std::size_t looked_at = 0;
  std::size_t sharp = 0;
  for (std::size_t i = 0; i < mesh.vertex_count(); i += kBendStride) {
    const auto foot = foot_on_level_set(field, isovalue, mesh.points[i]);
    if (!foot) continue;
    ++looked_at;
    sharp += bend_radius(field, *foot) <= sharp_below ? 1 : 0;
  }
  return looked_at > 0 ? static_cast<double>(sharp) / static_cast<double>(looked_at) : 0;
}

}  // namespace

SurfaceSummary summarise(const TriangleMesh& mesh) {
  SurfaceSummary summary;
  summary.all = size_of(mesh);
  const Components components = connected_components(mesh);
  summary.components = components.count;
  summary.specks = count_specks(components);
  TriangleMesh main = mesh;
  summary.cavities = remove_cavities(main, components, CavityPolicy::main).cavities;
  summary.main = size_of(main);
  std::vector<std::string> notes;
  summary.edge_ratio = metrics::measure_shape(mesh, notes).edge_ratio.histogram;
  return summary;
}

Nearness nearness_of(const TriangleMesh& mesh, const GaussianField& field, double isovalue, double sharp_below) {
  return {distance_to_level_set(field, isovalue, mesh.points), sharp_share(mesh, field, isovalue, sharp_below)};
}

}  // namespace smopt::experiments
