#include "metrics/solvation/charge_sums.h"

#include <cmath>
#include <limits>

namespace smopt::metrics {
namespace {

std::vector<double> without_zeros(const std::vector<double>& charges) {
  std::vector<double> kept;
  for (const double q : charges)
    if (q != 0) kept.push_back(q);
  return kept;
}

std::vector<Vec3> vertices_and_charges(const DiscreteSurface& surface, const Molecule& molecule) {
  std::vector<Vec3> points = surface.mesh.points;
  for (std::size_t k = 0; k < molecule.atom_count(); ++k)
    if (molecule.charges[k] != 0) points.push_back(molecule.centers[k]);
  return points;
}

std::vector<double> reaches_for(const DiscreteSurface& surface, double reach, std::size_t points) {
  std::vector<double> reaches = reaches_of(surface, reach);
  reaches.resize(points, 0);
  return reaches;
}

/// ∫ ∂G0/∂ν over a closed surface is -1 for a point inside and 0 for one outside, which sums over points miss by the square of edge length by distance.
/// What they miss, for the mean potential that they see. \param of_one  the sum; \param of_potential  the same with φ.
double missing_double_layer(double of_one, double of_potential) {
  const double exact = std::round(of_one);
  return exact == 0 ? 0 : (exact / of_one - 1) * of_potential;
}

}  // namespace

ChargeSums::ChargeSums(const DiscreteSurface& surface, const Molecule& molecule, const DielectricModel& medium, const SurfaceSums& sums)
    : surface_(surface),
      medium_(medium),
      far_options_(sums.far),
      quadrature_(sums.quadrature),
      charges_(without_zeros(molecule.charges)),
      points_(vertices_and_charges(surface, molecule)),
      reaches_(reaches_for(surface, sums.reach, points_.size())),
      far_(points_, sums.far, reaches_),
      near_(far_, medium.kappa(), reaches_) {}

Eigen::VectorXd ChargeSums::right_side(const ProgressCallback& progress) const {
  const std::size_t vertices = surface_.size();
  std::vector<PointSources> sources(points_.size());
  std::vector<PointFields> fields(points_.size());
  for (std::size_t k = 0; k < charges_.size(); ++k) sources[vertices + k][kPlain].charge = charges_[k] / medium_.inner;
  far_.apply(sources, fields, progress);
  near_.apply(sources, fields, progress);
  for (const ClusterId leaf : near_.leaves())
    near_.visit_close_pairs(leaf, [&](std::uint32_t target, std::uint32_t source) {
      if (target < vertices && source >= vertices) fields[target][kPlain].potential = std::numeric_limits<double>::infinity();
    });
  const auto n = static_cast<Eigen::Index>(vertices);
  Eigen::VectorXd right_side(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const PotentialAndGradient& field = fields[static_cast<std::size_t>(i)][kPlain];
    right_side[i] = field.potential;
    right_side[n + i] = surface_.patches[static_cast<std::size_t>(i)].normal.dot(field.gradient);
  }
  return right_side;
}

ChargeSums::DoubleLayers ChargeSums::point_double_layers(const Eigen::VectorXd& unknowns, const ProgressCallback& progress) const {
  // Without screening both kernels are the plain one, and one sum serves for both.
  FarFieldOptions unscreened = far_options_;
  unscreened.kappa = 0;
  const FarField far(points_, unscreened, reaches_);
  const NearField near(far, 0, reaches_);
  std::vector<PointSources> sources(points_.size());
  std::vector<PointFields> fields(points_.size());
  for (std::size_t v = 0; v < surface_.size(); ++v) {
    sources[v][kPlain].dipole = surface_.patches[v].area_vector;
    sources[v][kScreened].dipole = unknowns[static_cast<Eigen::Index>(v)] * surface_.patches[v].area_vector;
  }
  far.apply(sources, fields, progress);
  near.apply(sources, fields, progress);
  DoubleLayers layers;
  for (std::size_t k = 0; k < charges_.size(); ++k) {
    layers.of_one.push_back(fields[surface_.size() + k][kPlain].potential);
    layers.of_potential.push_back(fields[surface_.size() + k][kScreened].potential);
  }
  return layers;
}

double ChargeSums::energy(const Eigen::VectorXd& unknowns, const ProgressCallback& progress) const {
  const std::size_t vertices = surface_.size();
  const auto n = static_cast<Eigen::Index>(vertices);
  const KernelParameters parameters = {medium_.kappa(), medium_.ratio()};
  std::vector<PointSources> sources(points_.size());
  std::vector<PointFields> fields(points_.size());
  set_sources(surface_, medium_.ratio(), unknowns, sources);
  far_.apply(sources, fields, progress);
  near_.apply(sources, fields, progress);
  DoubleLayers layers = point_double_layers(unknowns, progress);
  const CloseMatrix close(
      near_, surface_, vertices, charges_.size(),
      [&](std::size_t k) {
        return TargetPoint{points_[vertices + k], Vec3::Zero()};
      },
      parameters, quadrature_, progress);
  double energy = 0;
  for (std::size_t k = 0; k < charges_.size(); ++k) {
    const PointFields& field = fields[vertices + k];
    double potential = field[kPlain].potential + field[kScreened].potential;
    const CloseMatrix::Row row = close[k];
    for (std::size_t entry = 0; entry < row.sources.size(); ++entry) {
      const auto j = static_cast<Eigen::Index>(row.sources[entry]);
      const KernelValues& values = row.values[entry];
      potential += values.k1 * unknowns[n + j] + values.k2 * unknowns[j];
      layers.of_one[k] += values.double_layer;
      layers.of_potential[k] += values.double_layer * unknowns[j];
    }
    energy += charges_[k] * (potential + (medium_.ratio() - 1) * missing_double_layer(layers.of_one[k], layers.of_potential[k]));
  }
  return 0.5 * kPotentialUnit * energy;
}

}  // namespace smopt::metrics
