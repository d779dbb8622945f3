#include "metrics/solvation/chebyshev_grid.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace smopt::metrics {
namespace {

/// Least extent of a grid relative to its largest. Thinner grids would gain nothing, and the derivative across them would amplify rounding.
constexpr double kLeastExtentRel = 1.0 / 16;

/// out[b][c][a'] = Σ_a matrix(a', a)·in[a][b][c]: done for all three axes, the order of the axes is as before.
Eigen::VectorXd multiplied_and_rotated(const Eigen::MatrixXd& matrix, const ConstGridValues& in) {
  const Eigen::Index n = matrix.cols();
  const Eigen::Map<const Eigen::MatrixXd> by_first(in.data(), in.size() / n, n);  // column a holds in[a][·][·]
  Eigen::VectorXd out(in.size());
  Eigen::Map<Eigen::MatrixXd>(out.data(), n, in.size() / n).noalias() = matrix * by_first.transpose();
  return out;
}

Eigen::VectorXd multiplied(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, const Eigen::MatrixXd& z, const ConstGridValues& in) {
  return multiplied_and_rotated(z, multiplied_and_rotated(y, multiplied_and_rotated(x, in)));
}

/// Column i: the products of all pairs of numbers of column i of a (slow) and b (fast).
Eigen::MatrixXd column_products(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd products(a.rows() * b.rows(), a.cols());
  for (Eigen::Index i = 0; i < a.cols(); ++i)
    for (Eigen::Index k = 0; k < a.rows(); ++k) products.col(i).segment(k * b.rows(), b.rows()) = a(k, i) * b.col(i);
  return products;
}

Eigen::VectorXd column_dots(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.cwiseProduct(b).colwise().sum().transpose();
}

/// Coefficients as a matrix: row c for z, column (a, b) for x and y.
Eigen::Map<const Eigen::MatrixXd> by_plane(const ConstGridValues& coefficients, Eigen::Index size) {
  return {coefficients.data(), size, size * size};
}

}  // namespace

ChebyshevBasis::ChebyshevBasis(int degree) : nodes_(degree + 1), coefficients_(degree + 1, degree + 1) {
  const auto half_at_ends = [&](int k) { return k == 0 || k == degree ? 0.5 : 1.0; };
  for (int k = 0; k <= degree; ++k) {
    nodes_[k] = std::cos(k * std::numbers::pi / degree);
    for (int m = 0; m <= degree; ++m)
      coefficients_(k, m) = 2.0 / degree * half_at_ends(k) * half_at_ends(m) * std::cos(m * k * std::numbers::pi / degree);
  }
}

Eigen::MatrixXd ChebyshevBasis::lagrange_at(const Eigen::VectorXd& t) const {
  return coefficients_ * chebyshev_values(t, size()).value;
}

ChebyshevValues chebyshev_values(const Eigen::VectorXd& t, Eigen::Index size) {
  ChebyshevValues v{Eigen::MatrixXd::Ones(size, t.size()), Eigen::MatrixXd::Zero(size, t.size())};
  v.value.row(1) = t.transpose();
  v.derivative.row(1).setOnes();
  for (Eigen::Index m = 2; m < size; ++m) {  // T_m = 2t·T_{m-1} - T_{m-2}
    v.value.row(m) = 2 * t.transpose().cwiseProduct(v.value.row(m - 1)) - v.value.row(m - 2);
    v.derivative.row(m) = 2 * (v.value.row(m - 1) + t.transpose().cwiseProduct(v.derivative.row(m - 1))) - v.derivative.row(m - 2);
  }
  return v;
}

GridBox grid_box(const Vec3& center, const Vec3& half) {
  return {center, half.cwiseMax(kLeastExtentRel * half.maxCoeff())};
}

std::array<Eigen::VectorXd, 3> grid_points(const ChebyshevBasis& basis, const GridBox& box) {
  const Eigen::Index n = basis.size();
  std::array<Eigen::VectorXd, 3> points;
  for (Eigen::VectorXd& along : points) along.resize(n * n * n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b)
      for (Eigen::Index c = 0; c < n; ++c) {
        const Vec3 t(basis.nodes()[a], basis.nodes()[b], basis.nodes()[c]);
        for (int axis = 0; axis < 3; ++axis) points[axis][(a * n + b) * n + c] = box.center[axis] + box.half[axis] * t[axis];
      }
  return points;
}

PointBasis::PointBasis(const Eigen::Ref<const Eigen::MatrixX3d>& points, const GridBox& box, Eigen::Index size) {
  std::array<ChebyshevValues, 3> along;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd t = (points.col(axis).array() - box.center[axis]) / box.half[axis];
    along[axis] = chebyshev_values(t, size);
    along[axis].derivative /= box.half[axis];
  }
  plane_ = column_products(along[0].value, along[1].value);
  plane_dx_ = column_products(along[0].derivative, along[1].value);
  plane_dy_ = column_products(along[0].value, along[1].derivative);
  line_ = std::move(along[2].value);
  line_dz_ = std::move(along[2].derivative);
}

void PointBasis::add_to_coefficients(const PointMoments& sources, GridValues coefficients) const {
  const auto& q = sources.number;
  const auto& d = sources.vector;
  const Eigen::MatrixXd plane = plane_ * q.asDiagonal() + plane_dx_ * d.col(0).asDiagonal() + plane_dy_ * d.col(1).asDiagonal();
  const Eigen::MatrixXd plane_of_z = plane_ * d.col(2).asDiagonal();
  Eigen::Map<Eigen::MatrixXd> sums(coefficients.data(), line_.rows(), plane_.rows());
  sums.noalias() += line_ * plane.transpose();
  sums.noalias() += line_dz_ * plane_of_z.transpose();
}

PointMoments PointBasis::evaluate(const ConstGridValues& coefficients) const {
  const auto matrix = by_plane(coefficients, line_.rows());
  const Eigen::MatrixXd of_line = matrix.transpose() * line_;
  const Eigen::MatrixXd of_line_dz = matrix.transpose() * line_dz_;
  PointMoments result{column_dots(plane_, of_line), Eigen::MatrixX3d(line_.cols(), 3)};
  result.vector.col(0) = column_dots(plane_dx_, of_line);
  result.vector.col(1) = column_dots(plane_dy_, of_line);
  result.vector.col(2) = column_dots(plane_, of_line_dz);
  return result;
}

void add_charges(const ChebyshevBasis& basis, const ConstGridValues& source_coefficients, GridValues charges) {
  const Eigen::MatrixXd& c = basis.coefficients();
  charges += multiplied(c, c, c, source_coefficients);
}

Eigen::VectorXd coefficients_of(const ChebyshevBasis& basis, const ConstGridValues& values) {
  const Eigen::MatrixXd c = basis.coefficients().transpose();
  return multiplied(c, c, c, values);
}

GridTransfer::GridTransfer(const ChebyshevBasis& basis, const GridBox& child, const GridBox& parent) {
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd nodes = child.center[axis] + child.half[axis] * basis.nodes().array();
    along_[axis] = basis.lagrange_at((nodes.array() - parent.center[axis]) / parent.half[axis]);
  }
}

void GridTransfer::add_charges_to_parent(const ConstGridValues& child, GridValues parent) const {
  parent += multiplied(along_[0], along_[1], along_[2], child);
}

void GridTransfer::add_values_to_child(const ConstGridValues& parent, GridValues child) const {
  child += multiplied(along_[0].transpose(), along_[1].transpose(), along_[2].transpose(), parent);
}

}  // namespace smopt::metrics
