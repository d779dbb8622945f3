#include "baselines/laplacian_step.h"

#include "smopt/parallel.h"

namespace smopt::baselines {

void laplacian_step(const VertexNeighbours& neighbours, double weight, const std::vector<Vec3>& from, std::vector<Vec3>& to) {
  for_ranges_in_parallel(from.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto ring = neighbours[v];
      to[v] = ring.empty() ? from[v] : Vec3(from[v] + weight * (neighbour_mean(ring, from) - from[v]));
    }
  });
}

}  // namespace smopt::baselines
