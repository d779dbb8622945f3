#include "metrics/solvation/memory_prediction.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <numeric>

#include "metrics/solvation/boundary_operator.h"
#include "metrics/solvation/gmres.h"

namespace smopt::metrics {
namespace {

/// Vertices at which close pairs are counted: their mean is known to a few per cent.
constexpr std::size_t kSamples = 512;

/// Close pairs of all targets with the vertices, from some of them.
double estimated_close_pairs(const std::vector<Vec3>& targets, const DiscreteSurface& surface, const std::vector<double>& reaches) {
  const std::size_t samples = std::min(kSamples, targets.size());
  if (samples == 0) return 0;
  std::vector<std::size_t> counts(samples, 0);
  const std::vector<Vec3>& points = surface.mesh.points;
  tbb::parallel_for(std::size_t{0}, samples, [&](std::size_t sample) {
    const Vec3& target = targets[sample * targets.size() / samples];
    for (std::size_t v = 0; v < points.size(); ++v)
      if ((points[v] - target).squaredNorm() <= reaches[v] * reaches[v]) ++counts[sample];
  });
  const auto sum = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
  return sum * static_cast<double>(targets.size()) / static_cast<double>(samples);
}

/// Of the blocks, and of one for each thread that is being inverted: the block, its factors and its inverse in double precision.
double block_bytes(std::size_t vertices, int largest) {
  // Clusters are some three quarters as large as they may be.
  constexpr double kFilling = 0.75;
  const double size = std::min(static_cast<double>(largest), static_cast<double>(vertices));
  const double numbers = 4 * size * size;
  return kFilling * numbers / size * static_cast<double>(vertices) * sizeof(float) +
         3.0 * tbb::this_task_arena::max_concurrency() * numbers * sizeof(double);
}

/// Of the surface itself, with the mesh that it was made from.
double surface_bytes(const DiscreteSurface& surface) {
  const auto vertices = static_cast<double>(surface.size());
  const auto triangles = static_cast<double>(surface.mesh.triangle_count());
  return vertices * (2 * sizeof(Vec3) + sizeof(NodePatch) + sizeof(std::uint32_t) + sizeof(VertexId)) +
         triangles * (2 * sizeof(Triangle) + 3 * sizeof(FaceId));
}

/// Of a product with the matrix: strengths and fields of the points, and strengths in the tree's order.
double sums_bytes(std::size_t points, const FarFieldOptions& far) {
  constexpr double kPointBytes = sizeof(PointSources) * 2 + sizeof(PointFields) + 2 * sizeof(double) + sizeof(Vec3);
  return far_field_bytes(points, far) + static_cast<double>(points) * kPointBytes;
}

}  // namespace

double predicted_solvation_bytes(const DiscreteSurface& surface, const Molecule& molecule, const SolvationOptions& options) {
  const SurfaceSums sums = surface_sums_for(options.accuracy, options.medium.kappa(), options.is_direct);
  const std::vector<double> reaches = reaches_of(surface, sums.reach);
  constexpr double kPairBytes = sizeof(VertexId) + sizeof(KernelValues);
  const auto close_bytes = [&](const std::vector<Vec3>& targets) { return kPairBytes * estimated_close_pairs(targets, surface, reaches); };
  const double solving = sums_bytes(surface.size(), sums.far) + close_bytes(surface.mesh.points) +
                         block_bytes(surface.size(), options.block) +
                         gmres_bytes(2 * surface.size(), {options.residual, options.max_iterations, options.restart});
  const std::size_t points = surface.size() + molecule.atom_count();
  const double charging = sums_bytes(points, sums.far) + far_field_bytes(points, sums.far) + close_bytes(molecule.centers);
  return surface_bytes(surface) + std::max(solving, charging);
}

}  // namespace smopt::metrics
