#include "smopt/surface/uniform_surface.h"

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "smopt/error.h"
#include "smopt/physical_memory.h"
#include "smopt/surface/block_mesh.h"
#include "smopt/surface/field_blocks.h"
#include "smopt/surface/gaussian_field.h"
#include "smopt/surface/positive_option.h"
#include "smopt/surface/surface_estimate.h"
#include "smopt/surface/trilinear_block.h"

namespace smopt {
namespace {

/// Vertex numbers are 32-bit.
constexpr double kMostVertices = std::numeric_limits<VertexId>::max();

constexpr double kBytesPerMb = 1 << 20;

/// The bound from the atoms alone is enough for most; else vertices are counted on a coarse grid.
void require_feasible(const GaussianField& field, const UniformSurface& surface, std::uint64_t max_memory_bytes,
                      const ProgressCallback& progress) {
  const double most_bytes = static_cast<double>(max_memory_bytes == 0 ? physical_memory_bytes() : max_memory_bytes);
  const auto is_feasible = [&](double vertices) { return vertices <= kMostVertices && bytes_to_mesh(field, vertices) <= most_bytes; };
  if (is_feasible(most_vertices(field, surface))) return;

  const double vertices = estimated_vertices(field, surface, progress);
  if (is_feasible(vertices)) return;
  if (vertices > kMostVertices)
    throw InvalidInput(fmt::format("at a spacing of {} Å the surface would have some {:.2g} vertices, more than 32-bit indices can number",
                                   surface.spacing, vertices));
  throw InvalidInput(
      fmt::format("at a spacing of {} Å the surface would have some {:.2g} vertices and need some {:.0f} MB of memory, more than "
                  "the limit of {:.0f} MB",
                  surface.spacing, vertices, bytes_to_mesh(field, vertices) / kBytesPerMb, most_bytes / kBytesPerMb));
}

/// Each thread meshes blocks in memory of its own; what is kept has just the size it needs.
std::vector<BlockMesh> mesh_blocks(const FieldBlocks& blocks, double isovalue, TrilinearSurfaceReport& report,
                                   const ProgressCallback& progress) {
  struct Workplace {
    BlockMesh mesh;
    TrilinearSurfaceReport report;
  };
  tbb::enumerable_thread_specific<Workplace> workplaces;
  std::vector<BlockMesh> meshes(blocks.count());
  const auto mesh_block = [&](std::size_t i, const ScalarGrid& block) {
    Workplace& workplace = workplaces.local();
    workplace.report += mesh_trilinear_block(block, isovalue, workplace.mesh);
    meshes[i] = BlockMesh(workplace.mesh);
  };
  blocks.visit_all(mesh_block, "surface", progress);
  for (const Workplace& workplace : workplaces) report += workplace.report;
  return meshes;
}

}  // namespace

TriangleMesh uniform_surface(const GaussianField& field, const UniformSurface& surface, std::uint64_t max_memory_bytes,
                             UniformSurfaceReport* report, const ProgressCallback& progress) {
  require_positive(surface.spacing, "spacing");
  require_feasible(field, surface, max_memory_bytes, progress);
  const FieldBlocks blocks(field, surface.spacing, surface.isovalue);
  TrilinearSurfaceReport met;
  TriangleMesh mesh = joined(mesh_blocks(blocks, surface.isovalue, met, progress));
  if (report) *report = {blocks.node_count(), met};
  return mesh;
}

}  // namespace smopt
