#pragma once

#include <functional>

#include <Eigen/Core>

namespace smopt::metrics {

struct GmresOptions {
  double residual;     ///< relative, of the preconditioned system, at which it ends; (0, 1)
  int max_iterations;  ///< at least 1
  int restart;         ///< directions that are kept before it starts anew from where it is; at least 1
};

struct GmresResult {
  Eigen::VectorXd solution;
  int iterations = 0;            ///< each one product with the matrix, and a restart is one more; 0 where one was not finite
  double relative_residual = 0;  ///< |M⁻¹(b - Ax)|/|M⁻¹b|, computed from the solution itself; NaN if a product was not finite
};

/// A linear system that is known by what it does to vectors of one size.
struct LinearSystem {
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> product;         ///< A·x
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> preconditioned;  ///< M⁻¹·r
  Eigen::VectorXd right_side;                                             ///< b, finite and not 0
};

/// Generalised minimal residuals with restarts (Saad & Schultz 1986), by Eigen: Walker's variant with Householder reflections. Starts from 0. Ends at once
/// where a product is not finite.
/// Cost: a product an iteration and one more; restart + 6 vectors.
GmresResult solve_by_gmres(const LinearSystem& system, const GmresOptions& options);

/// Bytes that it takes for a system of so many unknowns, without the product's.
double gmres_bytes(std::size_t unknowns, const GmresOptions& options);

}  // namespace smopt::metrics
