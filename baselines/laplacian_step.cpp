#include "baselines/laplacian_step.h"

#include "smopt/parallel.h"

namespace smopt::baselines {
namespace {

/// By coordinates: Eigen's expressions of three doubles make two stores of different sizes, which takes half as long again.
void move_range(NeighbourMeans means, double weight, const Vec3* from, Vec3* to, std::size_t begin, std::size_t end) {
  for (std::size_t v = begin; v < end; ++v) {
    const Vec3 mean = means.exists(v) ? means.of(v) : from[v];
    for (int k = 0; k < 3; ++k) to[v][k] = from[v][k] + weight * (mean[k] - from[v][k]);
  }
}

}  // namespace

void laplacian_step(const VertexNeighbours& neighbours, double weight, const std::vector<Vec3>& from, std::vector<Vec3>& to) {
  for_ranges_in_parallel(neighbours.vertex_count(), [&](std::size_t begin, std::size_t end) {
    move_range(NeighbourMeans(neighbours, from), weight, from.data(), to.data(), begin, end);
  });
}

}  // namespace smopt::baselines
