#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "metrics/solvation/point_sources.h"
#include "smopt/geometry/vec3.h"

namespace smopt::metrics {

/// Polynomials of one degree on [-1, 1], given by their values at the Chebyshev points of the second kind, cos(kπ/degree).
class ChebyshevBasis {
 public:
  /// \param degree  at least 1.
  explicit ChebyshevBasis(int degree);

  [[nodiscard]] Eigen::Index size() const { return nodes_.size(); }
  [[nodiscard]] const Eigen::VectorXd& nodes() const { return nodes_; }
  /// Entry (k, m): the coefficient of the Chebyshev polynomial T_m in the Lagrange polynomial of node k.
  [[nodiscard]] const Eigen::MatrixXd& coefficients() const { return coefficients_; }
  /// Entry (k, i): the Lagrange polynomial of node k at t[i].
  [[nodiscard]] Eigen::MatrixXd lagrange_at(const Eigen::VectorXd& t) const;

 private:
  Eigen::VectorXd nodes_;
  Eigen::MatrixXd coefficients_;
};

/// Row m, column i: T_m(t[i]) and its derivative there, for m < `size`.
struct ChebyshevValues {
  Eigen::MatrixXd value;
  Eigen::MatrixXd derivative;
};
ChebyshevValues chebyshev_values(const Eigen::VectorXd& t, Eigen::Index size);

/// Where a tensor grid of Chebyshev points lies.
struct GridBox {
  Vec3 center;  ///< ångström
  Vec3 half;    ///< half extents, ångström; positive
};

/// Contains the tight box (whose half extents are not all 0) and is nowhere flat, so that polynomials on it have derivatives.
GridBox grid_box(const Vec3& center, const Vec3& half);

/// One number per grid point (x slowest, z fastest).
using GridValues = Eigen::Ref<Eigen::VectorXd>;
using ConstGridValues = Eigen::Ref<const Eigen::VectorXd>;

/// Coordinates of the grid's points along each axis, one per grid point.
std::array<Eigen::VectorXd, 3> grid_points(const ChebyshevBasis& basis, const GridBox& box);

/// The Chebyshev polynomials of a box at some points in it, and their derivatives: what takes moments of points to coefficients and back.
class PointBasis {
 public:
  /// \param points  one a row, inside the box.
  PointBasis(const Eigen::Ref<const Eigen::MatrixX3d>& points, const GridBox& box, Eigen::Index size);

  /// Adds Σ_j (q_j + d_j·∇) T_a(x_j) T_b(y_j) T_c(z_j).
  void add_to_coefficients(const PointMoments& sources, GridValues coefficients) const;
  /// The polynomial with these coefficients and its gradient at the points.
  [[nodiscard]] PointMoments evaluate(const ConstGridValues& coefficients) const;

 private:
  // With a column a point: products of polynomials in x and y, and polynomials in z.
  Eigen::MatrixXd plane_, plane_dx_, plane_dy_, line_, line_dz_;
};

/// Proxy charges that act on every polynomial of the basis as the sources with these coefficients do.
void add_charges(const ChebyshevBasis& basis, const ConstGridValues& source_coefficients, GridValues charges);
/// Coefficients of the polynomial with these values at the grid's points.
Eigen::VectorXd coefficients_of(const ChebyshevBasis& basis, const ConstGridValues& values);

/// Takes charges of a child's grid to its parent's, and values of the parent's to the child's.
class GridTransfer {
 public:
  GridTransfer(const ChebyshevBasis& basis, const GridBox& child, const GridBox& parent);
  void add_charges_to_parent(const ConstGridValues& child, GridValues parent) const;
  void add_values_to_child(const ConstGridValues& parent, GridValues child) const;

 private:
  std::array<Eigen::MatrixXd, 3> along_;  // per axis: the parent's Lagrange polynomials (rows) at the child's nodes (columns)
};

}  // namespace smopt::metrics
