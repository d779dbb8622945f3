#include "metrics/solvation/boundary_operator.h"

#include <algorithm>

#include "smopt/parallel.h"

namespace smopt::metrics {

std::vector<double> reaches_of(const DiscreteSurface& surface, double reach) {
  std::vector<double> reaches;
  reaches.reserve(surface.size());
  for (const NodePatch& patch : surface.patches) reaches.push_back(reach * patch.longest_edge);
  return reaches;
}

void set_sources(const DiscreteSurface& surface, double ratio, const Eigen::VectorXd& unknowns, std::vector<PointSources>& sources) {
  const auto n = static_cast<Eigen::Index>(surface.size());
  for (std::size_t v = 0; v < surface.size(); ++v) {
    const NodePatch& patch = surface.patches[v];
    const auto i = static_cast<Eigen::Index>(v);
    const double charge = unknowns[n + i] * patch.area;
    const Vec3 dipole = unknowns[i] * patch.area_vector;
    sources[v][kPlain] = {charge, -dipole};
    sources[v][kScreened] = {-charge, ratio * dipole};
  }
}

BoundaryOperator::BoundaryOperator(const DiscreteSurface& surface, const KernelParameters& parameters, const SurfaceSums& sums,
                                   std::size_t block, const ProgressCallback& progress)
    : surface_(surface),
      parameters_(parameters),
      reaches_(reaches_of(surface, sums.reach)),
      far_(surface.mesh.points, sums.far, reaches_),
      near_(far_, parameters.kappa, reaches_),
      close_(
          near_, surface, 0, surface.size(),
          [&](std::size_t v) {
            return TargetPoint{surface.mesh.points[v], surface.patches[v].normal};
          },
          parameters, sums.quadrature, progress),
      jumps_(jumps()),
      preconditioner_(far_.tree(), block, [&](std::span<const VertexId> vertices) { return block_of(vertices); }) {}

std::vector<double> BoundaryOperator::jumps() const {
  std::vector<PointSources> sources(surface_.size());
  std::vector<PointFields> fields(surface_.size());
  for (std::size_t v = 0; v < sources.size(); ++v) sources[v][kPlain].dipole = surface_.patches[v].area_vector;
  far_.apply(sources, fields);
  near_.apply(sources, fields);
  std::vector<double> jumps;
  jumps.reserve(surface_.size());
  for (std::size_t v = 0; v < surface_.size(); ++v) {
    double inside = -fields[v][kPlain].potential;
    for (const KernelValues& values : close_[v].values) inside -= values.double_layer;
    jumps.push_back(inside + parameters_.ratio * (1 - inside));
  }
  return jumps;
}

Eigen::MatrixXd BoundaryOperator::block_of(std::span<const VertexId> vertices) const {
  const auto size = static_cast<Eigen::Index>(vertices.size());
  const double epsilon = parameters_.ratio;
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(2 * size, 2 * size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const VertexId target = vertices[static_cast<std::size_t>(i)];
    const CloseMatrix::Row row = close_[target];
    const NodePatch& patch = surface_.patches[target];
    for (Eigen::Index j = 0; j < size; ++j) {
      const VertexId source = vertices[static_cast<std::size_t>(j)];
      KernelValues k;
      const auto at = std::ranges::lower_bound(row.sources, source);
      if (at != row.sources.end() && *at == source) {
        k = row.values[static_cast<std::size_t>(at - row.sources.begin())];
      } else {
        k = kernel_values(surface_.mesh.points[target] - surface_.mesh.points[source], patch.normal, surface_.patches[source].area_vector,
                          parameters_);
        k.k1 *= surface_.patches[source].area;
        k.k3 *= surface_.patches[source].area;
      }
      block.block<2, 2>(2 * i, 2 * j) << -k.k2, -k.k1, -k.k4, -k.k3;
    }
    block(2 * i, 2 * i) += jumps_[target];
    block(2 * i + 1, 2 * i + 1) += 0.5 * (1 + 1 / epsilon);
    if (!patch.has_normal()) {
      block.row(2 * i + 1).setZero();
      block(2 * i + 1, 2 * i + 1) = 1;
    }
  }
  return block;
}

Eigen::VectorXd BoundaryOperator::product(const Eigen::VectorXd& unknowns, const ProgressCallback& progress) const {
  const std::size_t count = surface_.size();
  const auto n = static_cast<Eigen::Index>(count);
  const double epsilon = parameters_.ratio;
  std::vector<PointSources> sources(count);
  std::vector<PointFields> fields(count);
  set_sources(surface_, epsilon, unknowns, sources);
  far_.apply(sources, fields, progress);
  near_.apply(sources, fields, progress);
  Eigen::VectorXd result(2 * n);
  for_ranges_in_parallel(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const NodePatch& patch = surface_.patches[v];
      const auto i = static_cast<Eigen::Index>(v);
      double first = fields[v][kPlain].potential + fields[v][kScreened].potential;
      double second = patch.normal.dot(fields[v][kPlain].gradient + fields[v][kScreened].gradient / epsilon);
      const CloseMatrix::Row row = close_[v];
      for (std::size_t k = 0; k < row.sources.size(); ++k) {
        const auto j = static_cast<Eigen::Index>(row.sources[k]);
        const KernelValues& values = row.values[k];
        first += values.k1 * unknowns[n + j] + values.k2 * unknowns[j];
        second += values.k3 * unknowns[n + j] + values.k4 * unknowns[j];
      }
      result[i] = jumps_[v] * unknowns[i] - first;
      result[n + i] = patch.has_normal() ? 0.5 * (1 + 1 / epsilon) * unknowns[n + i] - second : unknowns[n + i];
    }
  });
  return result;
}

}  // namespace smopt::metrics
