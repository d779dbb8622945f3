#pragma once

#include <vector>

#include <Eigen/Core>

#include "metrics/solvation/block_preconditioner.h"
#include "metrics/solvation/close_matrix.h"
#include "metrics/solvation/discrete_surface.h"
#include "metrics/solvation/far_field.h"
#include "metrics/solvation/near_field.h"
#include "metrics/solvation/surface_sums.h"

namespace smopt::metrics {

/// How far each vertex reaches, Å: see SurfaceSums.
std::vector<double> reaches_of(const DiscreteSurface& surface, double reach);

/// Sources at the vertices whose fields are the two equations' integrals of the unknowns (potentials first, then normal derivatives):
/// Σ [K1 ψ + K2 φ] w = potential(plain) + potential(screened);  Σ [K3 ψ + K4 φ] w = n·(gradient(plain) + gradient(screened)/ε).
void set_sources(const DiscreteSurface& surface, double ratio, const Eigen::VectorXd& unknowns, std::vector<PointSources>& sources);

/// The derivative boundary integral equations of the linearised Poisson–Boltzmann equation (Juffer et al. 1991), collocated at the vertices, with
/// unknowns that are linear on each triangle: the matrix A of A·(φ, ψ) = (S1, S2), which is never stored as a whole.
///
///   (c + ε(1 - c)) φ(x) - ∫ [K1 ψ + K2 φ] = S1(x),   ½(1 + 1/ε) ψ(x) - ∫ [K3 ψ + K4 φ] = S2(x)
///
/// with c the interior solid angle at x as a part of 4π: ½ where the surface is smooth, but x is a corner of a polyhedron. c is minus the sum that stands
/// for ∫ ∂G0/∂ν, so that a constant φ meets no error of quadrature, which ε would multiply.
/// A vertex without a normal has no second equation; its ψ is set to 0.
class BoundaryOperator {
 public:
  /// \param block  vertices in a block of the preconditioner.
  BoundaryOperator(const DiscreteSurface& surface, const KernelParameters& parameters, const SurfaceSums& sums, std::size_t block,
                   const ProgressCallback& progress);

  /// 2·vertices.
  [[nodiscard]] Eigen::Index size() const { return 2 * static_cast<Eigen::Index>(surface_.size()); }
  [[nodiscard]] Eigen::VectorXd product(const Eigen::VectorXd& unknowns, const ProgressCallback& progress) const;
  [[nodiscard]] Eigen::VectorXd preconditioned(const Eigen::VectorXd& residual) const { return preconditioner_.solve(residual); }

 private:
  [[nodiscard]] std::vector<double> jumps() const;
  [[nodiscard]] Eigen::MatrixXd block_of(std::span<const VertexId> vertices) const;

  const DiscreteSurface& surface_;
  KernelParameters parameters_;
  std::vector<double> reaches_;
  FarField far_;
  NearField near_;
  CloseMatrix close_;
  std::vector<double> jumps_;  // c + ε(1 - c)
  BlockPreconditioner preconditioner_;
};

}  // namespace smopt::metrics
