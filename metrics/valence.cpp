#include "metrics/valence.h"

#include <algorithm>
#include <span>

#include "metrics/edges.h"

namespace smopt::metrics {
namespace {

std::vector<std::size_t> valences_in_use(const TriangleMesh& mesh) {
  std::vector<std::size_t> valence(mesh.vertex_count(), 0);
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    ++valence[edge.front().low];
    ++valence[edge.front().high];
  });
  std::erase(valence, std::size_t{0});
  return valence;
}

double share_between(const std::vector<std::size_t>& valences, std::size_t low, std::size_t high) {
  const auto inside = std::count_if(valences.begin(), valences.end(), [=](std::size_t n) { return low <= n && n <= high; });
  return static_cast<double>(inside) / static_cast<double>(valences.size());
}

}  // namespace

Valence measure_valence(const TriangleMesh& mesh, std::vector<std::string>& notes) {
  const std::vector<std::size_t> valences = valences_in_use(mesh);
  if (valences.empty()) {
    notes.push_back("valence: the mesh has no edge");
    return {};
  }
  const auto [min, max] = std::minmax_element(valences.begin(), valences.end());
  return {*min, *max, share_between(valences, 6, 6), share_between(valences, 5, 7)};
}

}  // namespace smopt::metrics
