#include "metrics/solvation/memory_prediction.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "metrics/solvation/boundary_operator.h"
#include "metrics/solvation/gmres.h"

namespace smopt::metrics {
namespace {

/// Vertices at which close pairs are counted: their mean is known to a few per cent.
constexpr std::size_t kSamples = 512;

/// Close pairs of all targets, from some of them.
double estimated_close_pairs(const DiscreteSurface& surface, const std::vector<double>& reaches) {
  const std::size_t samples = std::min(kSamples, surface.size());
  std::vector<std::size_t> counts(samples, 0);
  const std::vector<Vec3>& points = surface.mesh.points;
  tbb::parallel_for(std::size_t{0}, samples, [&](std::size_t sample) {
    const Vec3& target = points[sample * surface.size() / samples];
    for (std::size_t v = 0; v < points.size(); ++v)
      if ((points[v] - target).squaredNorm() <= reaches[v] * reaches[v]) ++counts[sample];
  });
  const auto sum = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
  return sum * static_cast<double>(surface.size()) / static_cast<double>(samples);
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
  const double close = estimated_close_pairs(surface, reaches_of(surface, sums.reach)) * (sizeof(VertexId) + sizeof(KernelValues));
  // A block of m vertices has (2m)² single-precision numbers; clusters are some three quarters as large as they may be.
  constexpr double kBlockFilling = 0.75;
  const auto vertices = static_cast<double>(surface.size());
  const double blocks = 4 * kBlockFilling * options.block * vertices * sizeof(float);
  const double solving = sums_bytes(surface.size(), sums.far) + close + blocks +
                         gmres_bytes(2 * surface.size(), {options.residual, options.max_iterations, options.restart});
  const double charging = sums_bytes(surface.size() + molecule.atom_count(), sums.far);
  return surface_bytes(surface) + std::max(solving, charging);
}

}  // namespace smopt::metrics
