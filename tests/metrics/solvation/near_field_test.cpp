#include "metrics/solvation/near_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "tests/support/shapes.h"
#include "tests/support/threads.h"

namespace smopt::metrics {
namespace {

using namespace smopt::testing;

constexpr double kKappa = 0.125714;

struct Points {
  std::vector<Vec3> at;
  std::vector<double> reaches;
  std::vector<PointSources> sources;
};

/// Points on a sphere, each with a reach of its own: a few reach across it.
Points points_with_reaches(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  Points points;
  points.at = icosphere(4, 12).points;
  for (std::size_t i = 0; i < points.at.size(); ++i) {
    points.reaches.push_back(i % 50 == 0 ? 9 : 1 + number(random));
    PointSources& sources = points.sources.emplace_back();
    for (ChargeAndDipole& s : sources) s = {number(random), {number(random), number(random), number(random)}};
  }
  return points;
}

bool is_close(const Points& points, std::size_t target, std::size_t source) {
  return (points.at[target] - points.at[source]).norm() <= points.reaches[source];
}

TEST(NearField, ClosePairsAreThoseWithinTheSourcesReach) {
  const Points points = points_with_reaches(5);
  const FarField far(points.at, options_for(1e-3, kKappa), points.reaches);
  const NearField near(far, kKappa, points.reaches);
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const ClusterId leaf : near.leaves())
    near.visit_close_pairs(leaf, [&](std::uint32_t target, std::uint32_t source) {
      EXPECT_TRUE(pairs.emplace(target, source).second) << "twice";
      EXPECT_TRUE(is_close(points, target, source));
    });
  std::size_t expected = 0;
  for (std::size_t i = 0; i < points.at.size(); ++i)
    for (std::size_t j = 0; j < points.at.size(); ++j) expected += is_close(points, i, j) ? 1 : 0;
  EXPECT_EQ(pairs.size(), expected);
}

std::vector<PointFields> fields_of(const Points& points, double tolerance) {
  const FarField far(points.at, options_for(tolerance, kKappa), points.reaches);
  const NearField near(far, kKappa, points.reaches);
  std::vector<PointFields> fields(points.at.size());
  far.apply(points.sources, fields);
  near.apply(points.sources, fields);
  return fields;
}

/// By the formulas, one pair after the other.
PointFields direct_fields(const Points& points, std::size_t target) {
  PointFields sums;
  for (std::size_t j = 0; j < points.at.size(); ++j) {
    if (is_close(points, target, j)) continue;
    for (const std::size_t kernel : {kPlain, kScreened}) {
      const double kappa = kernel == kPlain ? 0 : kKappa;
      const Vec3 rho = points.at[target] - points.at[j];
      const double r = rho.norm();
      const double g = std::exp(-kappa * r) / (4 * std::numbers::pi * r);
      const double dg = -g * (kappa + 1 / r);
      const double ddg = g * (kappa * kappa + 2 * kappa / r + 2 / (r * r));
      const ChargeAndDipole& source = points.sources[j][kernel];
      const Vec3 e = rho / r;
      const double along = source.dipole.dot(e);
      sums[kernel].potential += source.charge * g - along * dg;
      sums[kernel].gradient += source.charge * dg * e - (ddg * along * e + dg / r * (source.dipole - along * e));
    }
  }
  return sums;
}

TEST(NearField, MakesWithTheFarFieldTheSumOverAllPairsThatAreNotClose) {
  const Points points = points_with_reaches(7);
  for (const double tolerance : {1e-3, 1e-6}) {
    const std::vector<PointFields> fields = fields_of(points, tolerance);
    double errors = 0, norms = 0, potential_errors = 0, potential_norms = 0;
    for (std::size_t i = 0; i < points.at.size(); i += 7) {
      const PointFields expected = direct_fields(points, i);
      for (const std::size_t kernel : {kPlain, kScreened}) {
        errors += (fields[i][kernel].gradient - expected[kernel].gradient).squaredNorm();
        norms += expected[kernel].gradient.squaredNorm();
        potential_errors += std::pow(fields[i][kernel].potential - expected[kernel].potential, 2);
        potential_norms += std::pow(expected[kernel].potential, 2);
      }
    }
    EXPECT_LT(std::sqrt(errors / norms), tolerance);
    EXPECT_LT(std::sqrt(potential_errors / potential_norms), tolerance);
  }
}

TEST(NearField, HasTheSameBytesForAnyNumberOfThreads) {
  const Points points = points_with_reaches(11);
  expect_same_for_any_threads([&] {
    std::vector<double> numbers;
    for (const PointFields& fields : fields_of(points, 1e-3))
      for (const PotentialAndGradient& f : fields) numbers.insert(numbers.end(), {f.potential, f.gradient.x(), f.gradient.z()});
    return numbers;
  });
}

}  // namespace
}  // namespace smopt::metrics
