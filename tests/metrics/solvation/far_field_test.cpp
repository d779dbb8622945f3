#include "metrics/solvation/far_field.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "smopt/error.h"
#include "tests/support/shapes.h"
#include "tests/support/threads.h"

namespace smopt::metrics {
namespace {

using namespace smopt::testing;

constexpr double kAfmpbKappa = 0.125714;

std::vector<Vec3> points_in_cube(std::size_t count, std::uint32_t seed, double edge = 20) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-edge / 2, edge / 2);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
  return points;
}

/// About as dense as the vertices of a molecule's mesh.
std::vector<Vec3> points_on_bumpy_sphere(int subdivisions) {
  std::vector<Vec3> points = icosphere(subdivisions).points;
  const double radius = std::sqrt(0.07 * static_cast<double>(points.size()));
  for (Vec3& p : points) p *= radius * (1 + 0.15 * std::sin(5 * p.x()) * std::cos(4 * p.y()) + 0.1 * std::sin(7 * p.z()));
  return points;
}

std::vector<PointSources> random_sources(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<PointSources> sources(count);
  for (PointSources& source : sources)
    for (ChargeAndDipole& s : source) s = {number(random), {number(random), number(random), number(random)}};
  return sources;
}

/// Charges and dipoles that hardly change from a point to the next, as a solution's do.
std::vector<PointSources> smooth_sources(const std::vector<Vec3>& points) {
  std::vector<PointSources> sources(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 u = points[i] / 30;
    sources[i] = {ChargeAndDipole{0.3 + u.x(), u.normalized() * (0.5 + u.y())},
                  ChargeAndDipole{0.2 - u.z(), u.normalized() * (0.7 - u.x())}};
  }
  return sources;
}

/// One term of the sum by its textbook formula, in terms of the kernel's derivatives along r.
PotentialAndGradient term(const Vec3& x, const Vec3& y, const ChargeAndDipole& source, double kappa) {
  const Vec3 rho = x - y;
  const double r = rho.norm();
  const double g = std::exp(-kappa * r) / (4 * std::numbers::pi * r);
  const double dg = -g * (kappa + 1 / r);
  const double ddg = g * (kappa * kappa + 2 * kappa / r + 2 / (r * r));
  const Vec3 e = rho / r;
  const double along = source.dipole.dot(e);
  return {source.charge * g - along * dg, source.charge * dg * e - (ddg * along * e + dg / r * (source.dipole - along * e))};
}

void add(PotentialAndGradient& sum, const PotentialAndGradient& more) {
  sum.potential += more.potential;
  sum.gradient += more.gradient;
}

/// The points that are near a point by the lists of `far`.
std::vector<bool> near_points(const FarField& far, ClusterId leaf) {
  std::vector<bool> near(far.tree().order().size(), false);
  for (const ClusterId source : far.near_sources(leaf))
    for (const std::uint32_t p : far.tree().points_of(source)) near[p] = true;
  return near;
}

/// Direct sums are taken at each sixteenth point.
constexpr std::uint32_t kStride = 16;

struct DirectSums {
  std::vector<PointFields> far;
  std::vector<PointFields> all;  ///< of all other points
};

DirectSums direct_sums(const std::vector<Vec3>& points, const std::vector<PointSources>& sources, double kappa, const FarField& far) {
  DirectSums sums{std::vector<PointFields>(points.size()), std::vector<PointFields>(points.size())};
  for (const ClusterId leaf : far.tree().leaves()) {
    const std::vector<bool> near = near_points(far, leaf);
    for (const std::uint32_t i : far.tree().points_of(leaf)) {
      if (i % kStride != 0) continue;
      for (std::size_t j = 0; j < points.size(); ++j) {
        if (i == j) continue;
        for (const std::size_t kernel : {kPlain, kScreened}) {
          const PotentialAndGradient t = term(points[i], points[j], sources[j][kernel], kernel == kPlain ? 0 : kappa);
          add(sums.all[i][kernel], t);
          if (!near[j]) add(sums.far[i][kernel], t);
        }
      }
    }
  }
  return sums;
}

struct Errors {
  double potential;
  double gradient;
};

/// Of the far part, relative to `whole`, in the 2-norm over the points where direct sums were taken.
Errors errors(const std::vector<PointFields>& fields, const DirectSums& direct, const std::vector<PointFields>& whole, std::size_t kernel) {
  double squared[4] = {};
  for (std::size_t i = 0; i < fields.size(); i += kStride) {
    squared[0] += std::pow(fields[i][kernel].potential - direct.far[i][kernel].potential, 2);
    squared[1] += (fields[i][kernel].gradient - direct.far[i][kernel].gradient).squaredNorm();
    squared[2] += std::pow(whole[i][kernel].potential, 2);
    squared[3] += whole[i][kernel].gradient.squaredNorm();
  }
  return {std::sqrt(squared[0] / squared[2]), std::sqrt(squared[1] / squared[3])};
}

std::vector<PointFields> far_part(const FarField& far, const std::vector<PointSources>& sources) {
  std::vector<PointFields> fields(sources.size());
  far.apply(sources, fields);
  return fields;
}

void expect_within_tolerance(const std::vector<Vec3>& points, const std::vector<PointSources>& sources,
                             const std::vector<double>& kappas = {0.0, kAfmpbKappa, 1.0}) {
  for (const double kappa : kappas) {
    // What is near does not depend on the tolerance.
    const DirectSums direct = direct_sums(points, sources, kappa, FarField(points, options_for(1e-3, kappa)));
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      const std::vector<PointFields> fields = far_part(FarField(points, options_for(tolerance, kappa)), sources);
      for (const std::size_t kernel : {kPlain, kScreened}) {
        const Errors e = errors(fields, direct, direct.all, kernel);
        EXPECT_LT(e.potential, tolerance) << "kappa " << kappa << ", kernel " << kernel;
        EXPECT_LT(e.gradient, tolerance) << "kappa " << kappa << ", kernel " << kernel;
      }
    }
  }
}

TEST(FarField, IsWithinTheToleranceOfDirectSummationInACube) {
  expect_within_tolerance(points_in_cube(6000, 11), random_sources(6000, 12));
}

TEST(FarField, IsWithinTheToleranceOfDirectSummationOnASurface) {
  const std::vector<Vec3> points = points_on_bumpy_sphere(4);
  expect_within_tolerance(points, random_sources(points.size(), 13));
  expect_within_tolerance(points, smooth_sources(points));
}

TEST(FarField, IsWithinTheToleranceWhereItsGridsAreMany) {
  const std::vector<Vec3> points = points_on_bumpy_sphere(5);
  expect_within_tolerance(points, smooth_sources(points), {kAfmpbKappa});
}

TEST(FarField, ErrorFallsWithTheDegree) {
  const std::vector<Vec3> points = points_on_bumpy_sphere(4);
  const std::vector<PointSources> sources = smooth_sources(points);
  double last = 1;
  for (const int degree : {2, 3, 4, 5, 6}) {
    // Leaves of a few points, so that grids are used on many levels.
    const FarField far(points, {.kappa = kAfmpbKappa, .theta = 0.7, .degree = degree, .leaf_size = 8});
    const DirectSums direct = direct_sums(points, sources, kAfmpbKappa, far);
    const Errors e = errors(far_part(far, sources), direct, direct.far, kScreened);
    EXPECT_LT(e.gradient, last / 2) << degree;
    last = e.gradient;
  }
}

TEST(FarField, IsExactWhereNoClusterIsLargeEnoughForAGrid) {
  const std::vector<Vec3> points = points_in_cube(600, 17);
  const std::vector<PointSources> sources = random_sources(600, 18);
  for (const double kappa : {0.0, kAfmpbKappa, 1.0, 30.0}) {
    const FarField far(points, {.kappa = kappa, .theta = 0.7, .degree = 16, .leaf_size = 16});
    const DirectSums direct = direct_sums(points, sources, kappa, far);
    const std::vector<PointFields> fields = far_part(far, sources);
    for (const std::size_t kernel : {kPlain, kScreened}) {
      const Errors e = errors(fields, direct, direct.far, kernel);
      EXPECT_LT(e.potential, 1e-13) << kappa;
      EXPECT_LT(e.gradient, 1e-13) << kappa;
    }
  }
}

TEST(FarField, LeavesHaveGridsToo) {
  const std::vector<Vec3> points = points_on_bumpy_sphere(4);
  const std::vector<PointSources> sources = smooth_sources(points);
  const FarField far(points, {.kappa = kAfmpbKappa, .theta = 0.7, .degree = 3, .leaf_size = 100});
  const DirectSums direct = direct_sums(points, sources, kAfmpbKappa, far);
  EXPECT_LT(errors(far_part(far, sources), direct, direct.all, kPlain).gradient, 1e-3);
}

TEST(FarField, HasTheSameBytesForAnyNumberOfThreads) {
  const std::vector<Vec3> points = points_on_bumpy_sphere(5);
  const std::vector<PointSources> sources = random_sources(points.size(), 19);
  expect_same_for_any_threads([&] {
    std::vector<double> numbers;
    for (const PointFields& fields : far_part(FarField(points, {.degree = 4}), sources))
      for (const PotentialAndGradient& f : fields)
        numbers.insert(numbers.end(), {f.potential, f.gradient.x(), f.gradient.y(), f.gradient.z()});
    return numbers;
  });
}

TEST(FarField, IsLinearAndAddsToWhatIsThere) {
  const std::vector<Vec3> points = points_in_cube(3000, 23);
  const std::vector<PointSources> a = random_sources(3000, 24);
  const std::vector<PointSources> b = random_sources(3000, 25);
  std::vector<PointSources> combined(3000);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < kKernels; ++k) combined[i][k] = {a[i][k].charge - 4 * b[i][k].charge, a[i][k].dipole - 4 * b[i][k].dipole};
  const FarField far(points, {.degree = 3});
  std::vector<PointFields> sum = far_part(far, combined);
  for (int times = 0; times < 4; ++times) far.apply(b, sum);
  const std::vector<PointFields> expected = far_part(far, a);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    for (std::size_t k = 0; k < kKernels; ++k) {
      EXPECT_NEAR(sum[i][k].potential, expected[i][k].potential, 1e-11);
      EXPECT_LT((sum[i][k].gradient - expected[i][k].gradient).norm(), 1e-11);
    }
  }
}

TEST(FarField, ScalesWithTheUnitOfLength) {
  std::vector<Vec3> points = points_on_bumpy_sphere(4);
  const std::vector<PointSources> sources = random_sources(points.size(), 29);
  const FarFieldOptions options{.kappa = 0.5, .degree = 3};
  const std::vector<PointFields> fields = far_part(FarField(points, options), sources);
  // Powers of two are exact; charges are in 1/r, dipoles in 1/r².
  std::vector<PointSources> as_dipoles = sources;
  for (Vec3& p : points) p *= 4;
  for (PointSources& source : as_dipoles)
    for (ChargeAndDipole& s : source) s.dipole *= 4;
  const std::vector<PointFields> scaled = far_part(FarField(points, {.kappa = 0.125, .degree = 3}), as_dipoles);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < kKernels; ++k) {
      EXPECT_DOUBLE_EQ(scaled[i][k].potential * 4, fields[i][k].potential);
      EXPECT_LE((scaled[i][k].gradient * 16 - fields[i][k].gradient).norm(), 1e-14 * fields[i][k].gradient.norm());
    }
  }
}

TEST(FarField, BothKernelsAreOneWithoutScreening) {
  const std::vector<Vec3> points = points_in_cube(2000, 31);
  std::vector<PointSources> sources = random_sources(2000, 32);
  for (PointSources& source : sources) source[kScreened] = source[kPlain];
  for (const PointFields& fields : far_part(FarField(points, {.kappa = 0, .degree = 3}), sources)) {
    EXPECT_EQ(fields[kPlain].potential, fields[kScreened].potential);
    EXPECT_LE((fields[kPlain].gradient - fields[kScreened].gradient).norm(), 1e-13 * (1 + fields[kPlain].gradient.norm()));
  }
}

TEST(FarField, NearPairsAreCounted) {
  const std::vector<Vec3> points = points_on_bumpy_sphere(3);
  const FarField far(points, {.leaf_size = 10});
  std::uint64_t pairs = 0;
  for (const ClusterId leaf : far.tree().leaves()) {
    const std::vector<bool> near = near_points(far, leaf);
    pairs += far.tree()[leaf].size() * static_cast<std::uint64_t>(std::count(near.begin(), near.end(), true));
  }
  EXPECT_EQ(far.near_pair_count(), pairs);
  EXPECT_LT(pairs, points.size() * points.size());
}

TEST(FarField, IsZeroForNoPointsOnePointAndEqualPoints) {
  for (const std::size_t count : {0, 1, 700}) {
    const std::vector<Vec3> points(count, Vec3(3, -1, 1e6));
    const FarField far(points, {.degree = 3, .leaf_size = 20});
    EXPECT_EQ(far.near_pair_count(), count * count);
    for (const PointFields& fields : far_part(far, random_sources(count, 37))) {
      for (const PotentialAndGradient& f : fields) {
        EXPECT_EQ(f.potential, 0);
        EXPECT_EQ(f.gradient, Vec3::Zero());
      }
    }
  }
}

/// What the second of two clouds does at the first. One may be many points at one place: a cluster without an extent beside one with.
void expect_far_clouds_within(double tolerance, const std::vector<Vec3>& first, const std::vector<Vec3>& second) {
  std::vector<Vec3> points = first;
  points.insert(points.end(), second.begin(), second.end());
  std::vector<PointSources> sources = random_sources(points.size(), 41);
  std::fill_n(sources.begin(), first.size(), PointSources{});
  const double kappa = 1e-3;
  const FarField far(points, {.kappa = kappa, .theta = 0.7, .degree = 5, .leaf_size = 32});
  EXPECT_LE(far.near_pair_count(), first.size() * first.size() + second.size() * second.size());
  DirectSums direct = direct_sums(points, sources, kappa, far);
  std::vector<PointFields> fields = far_part(far, sources);
  direct.far.resize(first.size());
  fields.resize(first.size());
  for (const std::size_t kernel : {kPlain, kScreened}) {
    const Errors e = errors(fields, direct, direct.far, kernel);
    EXPECT_LT(e.potential, tolerance);
    EXPECT_LT(e.gradient, tolerance);
  }
}

TEST(FarField, ActsBetweenCloudsFarApart) {
  std::vector<Vec3> far_away = points_in_cube(500, 44);
  for (Vec3& p : far_away) p += Vec3(3000, 100, -50);
  expect_far_clouds_within(1e-8, points_in_cube(1000, 43), far_away);
}

TEST(FarField, ActsBetweenACloudAndManyPointsAtOnePlace) {
  expect_far_clouds_within(1e-6, points_in_cube(1000, 43), std::vector<Vec3>(500, Vec3(300, 100, -50)));
}

TEST(FarField, WorksOnFlatAndStraightSetsOfPoints) {
  for (const int dimensions : {1, 2}) {
    std::vector<Vec3> points = points_in_cube(3000, 47, 200);
    for (Vec3& p : points) p.tail(3 - dimensions).setConstant(7);
    const std::vector<PointSources> sources = smooth_sources(points);
    const FarField far(points, options_for(1e-5, kAfmpbKappa));
    const DirectSums direct = direct_sums(points, sources, kAfmpbKappa, far);
    const Errors e = errors(far_part(far, sources), direct, direct.all, kScreened);
    EXPECT_LT(e.potential, 1e-5);
    EXPECT_LT(e.gradient, 1e-5);
  }
}

TEST(FarField, TighterTolerancesGiveHigherDegrees) {
  int last = 0;
  for (const double tolerance : {0.5, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
    EXPECT_GE(options_for(tolerance, 0).degree, last);
    last = options_for(tolerance, 0).degree;
  }
  EXPECT_EQ(options_for(0.1, 0.7).kappa, 0.7);
}

TEST(FarField, MemoryIsEstimatedInProportionToThePoints) {
  const FarFieldOptions options;
  EXPECT_GT(far_field_bytes(1000, options), 1000.0 * 3 * sizeof(double));
  EXPECT_NEAR(far_field_bytes(2'000'000, options) / far_field_bytes(1'000'000, options), 2, 1e-3);
}

TEST(FarField, RefusesWhatItCannotUse) {
  const std::vector<Vec3> points = points_in_cube(10, 53);
  for (const FarFieldOptions& options :
       {FarFieldOptions{.kappa = -1}, FarFieldOptions{.kappa = std::nan("")}, FarFieldOptions{.theta = 1}, FarFieldOptions{.theta = 0},
        FarFieldOptions{.degree = 0}, FarFieldOptions{.degree = kHighestDegree + 1}, FarFieldOptions{.leaf_size = 0}})
    EXPECT_THROW(FarField(points, options), InvalidOption);
  for (const double tolerance : {0.0, 1e-12, 1.0, std::nan("")}) EXPECT_THROW(options_for(tolerance, 0), InvalidOption);
  EXPECT_THROW(FarField({Vec3(0, std::nan(""), 0)}, {}), InvalidInput);
  std::vector<PointFields> too_few(9);
  EXPECT_THROW(FarField(points, {}).apply(random_sources(10, 1), too_few), InvalidInput);
}

TEST(FarField, CanBeCancelled) {
  const std::vector<Vec3> points = points_on_bumpy_sphere(3);
  std::vector<PointFields> fields(points.size());
  const auto cancel_halfway = [](std::string_view, double fraction) { return fraction < 0.5; };
  EXPECT_THROW(FarField(points, {.degree = 2}).apply(random_sources(points.size(), 1), fields, cancel_halfway), Cancelled);
}

TEST(PairSums, AreThoseOfTheFormulaForAnyScreening) {
  const std::vector<Vec3> points = points_in_cube(8, 59);
  const PointSources source = random_sources(1, 60)[0];
  for (const double kappa : {0.0, 1e-3, kAfmpbKappa, 1.0, 20.0, 1e4}) {
    SourceView view;
    view.count = 1;
    const double origin = 0;
    view.position = {&origin, &origin, &origin};
    for (const std::size_t kernel : {kPlain, kScreened}) {
      view.charge[kernel] = &source[kernel].charge;
      for (std::size_t axis = 0; axis < 3; ++axis) view.dipole[kernel][axis] = &source[kernel].dipole[static_cast<Eigen::Index>(axis)];
    }
    std::vector<TargetLanes> lanes(1);
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) lanes[0].position[axis][i] = points[i][static_cast<Eigen::Index>(axis)];
    add_pair_sums(view, kappa, lanes, SourceKind::charges_and_dipoles, TargetKind::potentials_and_gradients);
    for (const std::size_t kernel : {kPlain, kScreened}) {
      for (std::size_t i = 0; i < 8; ++i) {
        const PotentialAndGradient t = term(points[i], Vec3::Zero(), source[kernel], kernel == kPlain ? 0 : kappa);
        const auto& g = lanes[0].gradient[kernel];
        const double factor = 0.25 * std::numbers::inv_pi;
        const double scale = t.gradient.norm();
        // Argument errors of exp grow with the argument.
        EXPECT_NEAR(lanes[0].potential[kernel][i] * factor, t.potential, 1e-13 * (1 + scale)) << kappa;
        EXPECT_LE((Vec3(g[0][i], g[1][i], g[2][i]) * factor - t.gradient).norm(), 1e-13 * scale + 1e-290) << kappa;
      }
    }
  }
}

}  // namespace
}  // namespace smopt::metrics
