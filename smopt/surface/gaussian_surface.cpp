#include "smopt/surface/gaussian_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "smopt/error.h"
#include "smopt/physical_memory.h"
#include "smopt/surface/adaptive_estimate.h"
#include "smopt/surface/field_blocks.h"
#include "smopt/surface/positive_option.h"
#include "smopt/surface/uniform_surface.h"

namespace smopt {
namespace {

/// A kernel is left out where it is below this part of the isovalue (of 1 for isovalues above 1): where the field falls by 1 in an
/// ångström, as it does around atoms, each moves the surface by less than a millionth of an ångström.
constexpr double kLeastTermRelative = 1e-6;

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
                    "{:.6g} at the nodes): choose a smaller {} than {} Å",
                    options.isovalue, at_centers, at_nodes, options.error > 0 ? "error" : "spacing",
                    options.error > 0 ? options.error : options.spacing));
  throw InvalidInput(
      fmt::format("the field never reaches the isovalue {}: it is between 0 and {:.6g}, its largest value at the atoms' centres "
                  "and the nodes of the grid",
                  options.isovalue, std::max(at_centers, at_nodes)));
}

/// Partitions for larger errors are small beside the memory of machines, and trials would take as long as they do, Å.
constexpr double kErrorWorthATrial = 0.1;

TriangleMesh adaptive(const GaussianField& field, const GaussianSurfaceOptions& options, GaussianSurfaceReport& report,
                      const ProgressCallback& progress) {
  require_positive(options.error, "error");
  if (options.max_memory_bytes > 0 || options.error < kErrorWorthATrial) {
    const std::uint64_t limit = options.max_memory_bytes > 0 ? options.max_memory_bytes : physical_memory_bytes();
    require_memory_for_partition(field, options.isovalue, options.error, limit);
  }
  AdaptiveSurfaceReport& met = report.adaptive;
  AdaptivePartitionReport divided;
  const AdaptivePartition partition = partition_space(field, options.isovalue, options.error, &divided, progress);
  TriangleMesh mesh = adaptive_surface(partition, &met, progress);
  met.divided = divided;
  report.surface_cells = std::accumulate(met.surface_cells.begin(), met.surface_cells.end(), std::size_t{0});
  report.ambiguous_cells = met.ambiguous_cells;
  report.tunnel_cells = met.tunnel_cells;
  report.interior_vertices = met.interior_vertices;
  return mesh;
}

TriangleMesh uniform(const GaussianField& field, const GaussianSurfaceOptions& options, GaussianSurfaceReport& report,
                     const ProgressCallback& progress) {
  UniformSurfaceReport met;
  TriangleMesh mesh = uniform_surface(field, {options.isovalue, options.spacing}, options.max_memory_bytes, &met, progress);
  report.grid_nodes = met.grid_nodes;
  report.surface_cells = met.cells.surface_cells;
  report.ambiguous_cells = met.cells.ambiguous_cells;
  report.tunnel_cells = met.cells.tunnel_cells;
  report.interior_vertices = met.cells.interior_vertices;
  return mesh;
}

}  // namespace

GaussianFieldOptions gaussian_field_options(const GaussianSurfaceOptions& options) {
  return {options.decay, kLeastTermRelative * std::min(1.0, options.isovalue)};
}

TriangleMesh gaussian_surface(const Molecule& molecule, const GaussianSurfaceOptions& options, GaussianSurfaceReport* report,
                              const ProgressCallback& progress) {
  require_positive(options.isovalue, "isovalue");
  const GaussianField field(molecule, gaussian_field_options(options));
  GaussianSurfaceReport met;
  met.atoms = molecule.atom_count();
  TriangleMesh mesh = options.error != 0 ? adaptive(field, options, met, progress) : uniform(field, options, met, progress);
  if (mesh.points.empty()) fail_unreached(field, options);
  if (report) *report = met;
  return mesh;
}

}  // namespace smopt
