#include "metrics/solvation/gmres.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>

#include "metrics/solvation/block_preconditioner.h"

namespace smopt::metrics {
namespace {

struct DenseSystem {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd solution;
};

/// A dominant diagonal, and everything else random; not symmetric.
DenseSystem random_system(Eigen::Index size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto any = [&] { return number(random); };
  DenseSystem system{Eigen::MatrixXd::NullaryExpr(size, size, any), Eigen::VectorXd::NullaryExpr(size, any)};
  for (Eigen::Index i = 0; i < size; ++i) system.matrix(i, i) += static_cast<double>(i + 3);
  return system;
}

LinearSystem as_products(const DenseSystem& system) {
  LinearSystem products;
  products.product = [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(system.matrix * x); };
  products.preconditioned = [](const Eigen::VectorXd& r) { return r; };
  products.right_side = system.matrix * system.solution;
  return products;
}

TEST(Gmres, SolvesASystemToItsTolerance) {
  const DenseSystem system = random_system(60, 1);
  for (const double residual : {1e-3, 1e-6, 1e-10}) {
    const GmresResult result = solve_by_gmres(as_products(system), {residual, 100, 100});
    EXPECT_LE(result.relative_residual, 1.01 * residual);
    EXPECT_LT((result.solution - system.solution).norm(), 100 * residual * system.solution.norm());
  }
}

TEST(Gmres, NeedsAsManyProductsAsItSays) {
  const DenseSystem system = random_system(60, 2);
  LinearSystem products = as_products(system);
  int count = 0;
  products.product = [&](const Eigen::VectorXd& x) {
    ++count;
    return Eigen::VectorXd(system.matrix * x);
  };
  const GmresResult result = solve_by_gmres(products, {1e-8, 100, 100});
  EXPECT_EQ(count, result.iterations + 1);
}

TEST(Gmres, AGoodPreconditionerSavesIterations) {
  const DenseSystem system = random_system(60, 3);
  LinearSystem products = as_products(system);
  const int plain = solve_by_gmres(products, {1e-8, 100, 100}).iterations;
  products.preconditioned = [&](const Eigen::VectorXd& r) { return Eigen::VectorXd(r.cwiseQuotient(system.matrix.diagonal())); };
  const GmresResult result = solve_by_gmres(products, {1e-8, 100, 100});
  EXPECT_LT(result.iterations, plain);
  EXPECT_LT((result.solution - system.solution).norm(), 1e-6);
}

TEST(Gmres, RestartsGoOnFromWhereItIs) {
  const DenseSystem system = random_system(60, 4);
  const GmresResult result = solve_by_gmres(as_products(system), {1e-8, 1000, 5});
  EXPECT_LE(result.relative_residual, 1.01e-8);
  EXPECT_GT(result.iterations, 5);
}

TEST(Gmres, EndsAtTheMostIterationsWithTheTrueResidual) {
  const DenseSystem system = random_system(60, 5);
  const LinearSystem products = as_products(system);
  const GmresResult result = solve_by_gmres(products, {1e-12, 3, 100});
  EXPECT_EQ(result.iterations, 3);
  const double residual = (products.right_side - system.matrix * result.solution).norm() / products.right_side.norm();
  EXPECT_NEAR(result.relative_residual, residual, 1e-12);
  EXPECT_GT(residual, 1e-6);
}

TEST(Gmres, EndsAtOnceWhereAProductIsNotFinite) {
  const DenseSystem system = random_system(10, 6);
  LinearSystem products = as_products(system);
  int count = 0;
  products.product = [&](const Eigen::VectorXd& x) {
    ++count;
    return Eigen::VectorXd(x * std::numeric_limits<double>::quiet_NaN());
  };
  EXPECT_TRUE(std::isnan(solve_by_gmres(products, {1e-6, 100, 100}).relative_residual));
  EXPECT_EQ(count, 1);
}

TEST(Gmres, SolvesSystemsSmallerThanItsRestart) {
  const DenseSystem system = random_system(2, 7);
  EXPECT_LT((solve_by_gmres(as_products(system), {1e-12, 100, 100}).solution - system.solution).norm(), 1e-10);
}

/// Points on a line, with a matrix that couples neighbours: the blocks are cut out of it.
class Blocks : public ::testing::TestWithParam<std::size_t> {};

TEST_P(Blocks, AreSolvedExactly) {
  constexpr std::uint32_t kPoints = 100;
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < kPoints; ++i) points.emplace_back((i * 37) % kPoints, 0, 0);
  const ClusterTree tree(points, 16);
  const DenseSystem system = random_system(2 * kPoints, 8);
  // What the preconditioner leaves of the matrix.
  Eigen::MatrixXd kept = Eigen::MatrixXd::Zero(2 * kPoints, 2 * kPoints);
  const auto block_of = [&](std::span<const std::uint32_t> block) {
    EXPECT_LE(block.size(), GetParam());
    Eigen::MatrixXd values(2 * block.size(), 2 * block.size());
    const auto place = [&](std::size_t k) { return block[k / 2] + (k % 2) * kPoints; };
    for (std::size_t row = 0; row < 2 * block.size(); ++row)
      for (std::size_t column = 0; column < 2 * block.size(); ++column)
        values(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = kept(place(row), place(column)) =
            system.matrix(place(row), place(column));
    return values;
  };
  const BlockPreconditioner preconditioner(tree, GetParam(), block_of);
  const Eigen::VectorXd solved = preconditioner.solve(kept * system.solution);
  EXPECT_LT((solved - system.solution).norm(), 1e-5 * system.solution.norm());
}

INSTANTIATE_TEST_SUITE_P(Sizes, Blocks, ::testing::Values(1, 5, 16, 40, 1000));

}  // namespace
}  // namespace smopt::metrics
