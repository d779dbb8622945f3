#include "smopt/surface/gaussian_surface.h"

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "smopt/surface/block_mesh.h"
#include "smopt/surface/field_blocks.h"
#include "smopt/surface/gaussian_field.h"
#include "smopt/surface/surface_estimate.h"
#include "smopt/surface/trilinear_block.h"

namespace smopt {
namespace {

/// A kernel is left out where it is below this part of the isovalue (of 1 for isovalues above 1): where the field falls by 1 in an
/// ångström, as it does around atoms, each moves the surface by less than a millionth of an ångström.
constexpr double kLeastTermRelative = 1e-6;

/// Vertex numbers are 32-bit.
constexpr double kMostVertices = std::numeric_limits<VertexId>::max();

constexpr double kBytesPerMb = 1 << 20;

void require_positive(double value, const char* name) {
  if (!(std::isfinite(value) && value > 0)) throw InvalidOption(fmt::format("{} must be positive and finite, not {}", name, value));
}

double memory_of_machine() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

GaussianField field_of(const Molecule& molecule, const GaussianSurfaceOptions& options) {
  return {molecule, {options.decay, kLeastTermRelative * std::min(1.0, options.isovalue)}};
}

/// The bound from the atoms alone is enough for most; else vertices are counted on a coarse grid.
void require_feasible(const GaussianField& field, const GaussianSurfaceOptions& options, const ProgressCallback& progress) {
  const UniformSurface surface{options.isovalue, options.spacing};
  const double most_bytes = options.max_memory_bytes == 0 ? memory_of_machine() : static_cast<double>(options.max_memory_bytes);
  const auto is_feasible = [&](double vertices) { return vertices <= kMostVertices && bytes_to_mesh(field, vertices) <= most_bytes; };
  if (is_feasible(most_vertices(field, surface))) return;

  const double vertices = estimated_vertices(field, surface, progress);
  if (is_feasible(vertices)) return;
  if (vertices > kMostVertices)
    throw InvalidInput(fmt::format("at a spacing of {} Å the surface would have some {:.2g} vertices, more than 32-bit indices can number",
                                   options.spacing, vertices));
  throw InvalidInput(
      fmt::format("at a spacing of {} Å the surface would have some {:.2g} vertices and need some {:.0f} MB of memory, more than "
                  "the limit of {:.0f} MB",
                  options.spacing, vertices, bytes_to_mesh(field, vertices) / kBytesPerMb, most_bytes / kBytesPerMb));
}

/// The largest value at the nodes of the grid.
double maximum_at_nodes(const GaussianField& field, double spacing) {
  double maximum = 0;
  std::mutex comparing;
  const auto compare = [&](std::size_t, const ScalarGrid& block) {
    const double highest = *std::max_element(block.values.begin(), block.values.end());
    const std::lock_guard lock(comparing);
    maximum = std::max(maximum, highest);
  };
  FieldBlocks(field, spacing, 0).visit_all(compare, "field", {});
  return maximum;
}

[[noreturn]] void fail_unreached(const GaussianField& field, const GaussianSurfaceOptions& options) {
  const double at_nodes = maximum_at_nodes(field, options.spacing);
  double at_centers = 0;
  for (const Kernel& kernel : field.kernels()) at_centers = std::max(at_centers, field.value(kernel.center));
  if (at_centers >= options.isovalue)
    throw InvalidInput(
        fmt::format("the field reaches the isovalue {} only between the nodes of the grid ({:.6g} at an atom's centre, at most "
                    "{:.6g} at the nodes): choose a spacing smaller than {} Å",
                    options.isovalue, at_centers, at_nodes, options.spacing));
  throw InvalidInput(
      fmt::format("the field never reaches the isovalue {}: it is between 0 and {:.6g}, its largest value at the atoms' centres "
                  "and the nodes of the grid",
                  options.isovalue, std::max(at_centers, at_nodes)));
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

TriangleMesh gaussian_surface(const Molecule& molecule, const GaussianSurfaceOptions& options, GaussianSurfaceReport* report,
                              const ProgressCallback& progress) {
  require_positive(options.isovalue, "isovalue");
  require_positive(options.spacing, "spacing");
  const GaussianField field = field_of(molecule, options);
  require_feasible(field, options, progress);
  const FieldBlocks blocks(field, options.spacing, options.isovalue);
  TrilinearSurfaceReport met;
  TriangleMesh mesh = joined(mesh_blocks(blocks, options.isovalue, met, progress));
  if (mesh.points.empty()) fail_unreached(field, options);
  if (report) {
    *report = {molecule.atom_count(), blocks.node_count(), met.surface_cells, met.ambiguous_cells, met.tunnel_cells, met.interior_vertices};
  }
  return mesh;
}

}  // namespace smopt
