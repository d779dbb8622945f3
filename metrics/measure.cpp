#include "metrics/measure.h"

#include "metrics/intersections.h"

namespace smopt::metrics {
namespace {

std::optional<std::size_t> count_intersections(const TriangleMesh& mesh, std::vector<std::string>& notes) {
  const Intersections found = find_intersections(mesh, {.list_limit = 0});
  if (!found.count) notes.push_back("intersecting_pairs: " + found.why_not_counted);
  return found.count;
}

}  // namespace

Measurement measure(const TriangleMesh& mesh, const MeasureOptions& options) {
  Measurement m;
  m.topology = measure_topology(mesh, m.notes);
  m.extent = measure_extent(mesh, m.topology, m.notes);
  m.intersecting_pairs = count_intersections(mesh, m.notes);
  m.shape = measure_shape(mesh, m.notes);
  m.valence = measure_valence(mesh, m.notes);
  if (options.reference != nullptr) m.distance = surface_distance(mesh, *options.reference, m.notes, options.distance);
  return m;
}

}  // namespace smopt::metrics
