#include "smopt/surface/gaussian_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "smopt/surface/gaussian_grid.h"
#include "smopt/surface/trilinear_surface.h"

namespace smopt {
namespace {

/// A kernel is left out where it is below this part of the isovalue (of 1 for isovalues above 1): where the field falls by 1 in an
/// ångström, as it does around atoms, each moves the surface by less than a millionth of an ångström.
constexpr double kLeastTermRelative = 1e-6;

GaussianGridOptions field_options(const GaussianSurfaceOptions& options) {
  return {options.decay, options.spacing, kLeastTermRelative * std::min(1.0, options.isovalue)};
}

void require_reached(const ScalarGrid& field, double isovalue) {
  const double maximum = *std::max_element(field.values.begin(), field.values.end());
  if (maximum < isovalue)
    throw InvalidInput(
        fmt::format("the field never reaches the isovalue {}: its maximum at the grid's nodes is {:.6g}", isovalue, maximum));
}

}  // namespace

TriangleMesh gaussian_surface(const Molecule& molecule, const GaussianSurfaceOptions& options, GaussianSurfaceReport* report,
                              const ProgressCallback& progress) {
  if (!(std::isfinite(options.isovalue) && options.isovalue > 0))
    throw InvalidOption(fmt::format("isovalue must be positive and finite, not {}", options.isovalue));
  const ScalarGrid field = gaussian_grid(molecule, field_options(options), progress);
  require_reached(field, options.isovalue);
  TrilinearSurfaceReport met;
  TriangleMesh mesh = trilinear_surface(field, options.isovalue, &met, progress);
  if (report) {
    *report = {molecule.atom_count(), field.node_count(), met.surface_cells, met.ambiguous_cells, met.tunnel_cells, met.interior_vertices};
  }
  return mesh;
}

}  // namespace smopt
