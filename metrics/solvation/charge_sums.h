#pragma once

#include <Eigen/Core>

#include "metrics/solvation/boundary_operator.h"
#include "metrics/solvation/dielectric_model.h"
#include "smopt/io/molecule.h"

namespace smopt::metrics {

/// What acts between a molecule's charges and the unknowns on a surface around them.
class ChargeSums {
 public:
  /// Charges of 0 are left out. The references must outlive this.
  ChargeSums(const DiscreteSurface& surface, const Molecule& molecule, const DielectricModel& medium, const SurfaceSums& sums);

  /// S1 and S2 at the vertices: Σ q_k G0/ε_in and its normal derivative. Not finite where a charge is at a vertex.
  [[nodiscard]] Eigen::VectorXd right_side(const ProgressCallback& progress) const;
  /// ½ Σ q_k ∫ [K1 ψ + K2 φ], times 4π·332.06: kcal/mol. A charge inside meets no error of quadrature from a constant φ: see the jumps of
  /// BoundaryOperator.
  [[nodiscard]] double energy(const Eigen::VectorXd& unknowns, const ProgressCallback& progress) const;

 private:
  /// ∫ ∂G0/∂ν and ∫ φ ∂G0/∂ν at each charge, over the patches that are not close.
  struct DoubleLayers {
    std::vector<double> of_one;
    std::vector<double> of_potential;
  };
  [[nodiscard]] DoubleLayers point_double_layers(const Eigen::VectorXd& unknowns, const ProgressCallback& progress) const;

  const DiscreteSurface& surface_;
  DielectricModel medium_;
  FarFieldOptions far_options_;
  TriangleQuadrature quadrature_;
  std::vector<double> charges_;
  std::vector<Vec3> points_;  // the vertices, then the charges
  std::vector<double> reaches_;
  FarField far_;
  NearField near_;
};

}  // namespace smopt::metrics
