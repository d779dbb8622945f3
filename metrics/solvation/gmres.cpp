#include "metrics/solvation/gmres.h"

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <limits>
#include <unsupported/Eigen/IterativeSolvers>

namespace smopt::metrics {
namespace {

class Matrix;

/// A product gave something that is not a number: nothing that follows can be one.
struct NonfiniteProduct {};

}  // namespace
}  // namespace smopt::metrics

namespace Eigen::internal {
template <>
struct traits<smopt::metrics::Matrix> : traits<SparseMatrix<double>> {};
}  // namespace Eigen::internal

namespace smopt::metrics {
namespace {

/// Eigen's idea of a matrix that is not stored.
class Matrix : public Eigen::EigenBase<Matrix> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = false };

  explicit Matrix(const LinearSystem& system) : system_(&system) {}

  [[nodiscard]] Eigen::Index rows() const { return system_->right_side.size(); }
  [[nodiscard]] Eigen::Index cols() const { return rows(); }
  template <class Right>
  Eigen::Product<Matrix, Right, Eigen::AliasFreeProduct> operator*(const Eigen::MatrixBase<Right>& right) const {
    return {*this, right.derived()};
  }
  /// Eigen multiplies the starting point too, which is 0.
  [[nodiscard]] Eigen::VectorXd times(const Eigen::VectorXd& x) const {
    if ((x.array() == 0).all()) return Eigen::VectorXd::Zero(x.size());
    Eigen::VectorXd product = system_->product(x);
    if (!product.allFinite()) throw NonfiniteProduct();
    return product;
  }
  [[nodiscard]] const LinearSystem& system() const { return *system_; }

 private:
  const LinearSystem* system_;
};

class Preconditioner {
 public:
  Preconditioner() = default;
  explicit Preconditioner(const Matrix&) {}
  Preconditioner& analyzePattern(const Matrix&) { return *this; }
  Preconditioner& factorize(const Matrix& matrix) { return compute(matrix); }
  Preconditioner& compute(const Matrix& matrix) {
    system_ = &matrix.system();
    return *this;
  }
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& residual) const { return system_->preconditioned(residual); }
  [[nodiscard]] static Eigen::ComputationInfo info() { return Eigen::Success; }

 private:
  const LinearSystem* system_ = nullptr;
};

}  // namespace
}  // namespace smopt::metrics

namespace Eigen::internal {
template <class Right>
struct generic_product_impl<smopt::metrics::Matrix, Right, SparseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<smopt::metrics::Matrix, Right, generic_product_impl<smopt::metrics::Matrix, Right>> {
  template <class Result>
  static void scaleAndAddTo(Result& result, const smopt::metrics::Matrix& matrix, const Right& right, double factor) {
    result.noalias() += factor * matrix.times(right);
  }
};
}  // namespace Eigen::internal

namespace smopt::metrics {

GmresResult solve_by_gmres(const LinearSystem& system, const GmresOptions& options) {
  const Matrix matrix(system);
  Eigen::GMRES<Matrix, Preconditioner> gmres;
  gmres.setTolerance(options.residual);
  gmres.setMaxIterations(options.max_iterations);
  gmres.set_restart(std::min<Eigen::Index>({options.restart, options.max_iterations, matrix.rows()}));
  GmresResult result;
  try {
    gmres.compute(matrix);
    result.solution = gmres.solve(system.right_side);
    result.iterations = static_cast<int>(gmres.iterations());
    result.relative_residual =
        system.preconditioned(system.right_side - matrix.times(result.solution)).norm() / system.preconditioned(system.right_side).norm();
  } catch (const NonfiniteProduct&) {
    result.relative_residual = std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

double gmres_bytes(std::size_t unknowns, const GmresOptions& options) {
  constexpr double kOtherVectors = 8;  // b, x, residuals and what Eigen works with
  const double kept =
      std::min<double>({static_cast<double>(options.restart), static_cast<double>(options.max_iterations), static_cast<double>(unknowns)}) +
      1;
  return (kept + kOtherVectors) * static_cast<double>(unknowns) * sizeof(double);
}

}  // namespace smopt::metrics
