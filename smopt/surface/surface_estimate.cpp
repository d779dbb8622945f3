#include "smopt/surface/surface_estimate.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "smopt/surface/field_blocks.h"

namespace smopt {
namespace {

/// Å; the spacing on which vertices are counted. With 1, 1.5 and 2 Å, 2, 5 and 8 % too few are expected of proteins and ribosomes at the default
/// spacing, and 2, 7 and 9 % at 0.3 Å; that takes 24, 12 and 8 % of the time of making the mesh (the 70S ribosome).
constexpr double kCoarseSpacing = 1.5;

/// Edges of a grid of unit spacing that a unit of area crosses: the mean of |n_x| + |n_y| + |n_z| over all normals.
constexpr double kEdgesCrossed = 1.5;

/// What is added to the area that the atoms can have, for grids that happen to lie badly.
constexpr double kMargin = 1.1;

/// A surface smaller than the spacing crosses six edges when there is a node inside.
constexpr double kFewestVertices = 6;

/// A point takes 24 bytes and the two triangles a vertex has 24, in the blocks and in the mesh that is made of them; one vertex in eight is
/// shared by blocks, and takes 24 bytes to be sorted, 20 in the block, and as much again as a repeated point.
constexpr double kBytesPerVertex = 105;
/// Kernels of the field, in their rows.
constexpr double kBytesPerAtom = 50;
/// The threads and their blocks, some hundred kilobytes each.
constexpr double kFixedBytes = 2 << 20;

double squared(double x) {
  return x * x;
}

std::size_t crossed_edges(const ScalarGrid& block, double isovalue) {
  const auto [nx, ny, nz] = block.size;
  const auto is_inside = [&](std::size_t node) { return block.values[node] >= isovalue; };
  std::size_t crossed = 0;
  for (std::size_t k = 0; k + 1 < nz; ++k) {
    for (std::size_t j = 0; j + 1 < ny; ++j) {
      for (std::size_t i = 0; i + 1 < nx; ++i) {
        const std::size_t node = block.index(i, j, k);
        for (const std::size_t next : {node + 1, node + nx, node + std::size_t{nx} * ny})
          if (is_inside(node) != is_inside(next)) ++crossed;
      }
    }
  }
  return crossed;
}

}  // namespace

double most_vertices(const GaussianField& field, const UniformSurface& surface) {
  const double widening = std::max(0.0, std::log(static_cast<double>(field.atom_count()) / surface.isovalue)) / field.decay();
  double vertices = 0;
  for (const Kernel& kernel : field.kernels()) {
    const double squared_radius = std::log(kernel.amplitude) / field.decay() + widening;
    vertices += kFewestVertices + kMargin * kEdgesCrossed * 4 * std::numbers::pi * squared_radius / squared(surface.spacing);
  }
  return vertices;
}

double estimated_vertices(const GaussianField& field, const UniformSurface& surface, const ProgressCallback& progress) {
  const double coarse = std::max(kCoarseSpacing, surface.spacing);
  std::atomic<std::size_t> crossed = 0;
  const auto count = [&](std::size_t, const ScalarGrid& block) { crossed += crossed_edges(block, surface.isovalue); };
  FieldBlocks(field, coarse, surface.isovalue).visit_all(count, "estimate", progress);
  return static_cast<double>(crossed) * squared(coarse / surface.spacing);
}

double bytes_to_mesh(const GaussianField& field, double vertices) {
  return kFixedBytes + kBytesPerAtom * static_cast<double>(field.atom_count()) + kBytesPerVertex * vertices;
}

}  // namespace smopt
