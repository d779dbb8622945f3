#include "smopt/surface/gaussian_field.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include "smopt/error.h"
#include "tests/support/molecules.h"

namespace smopt {
namespace {

using ::testing::HasSubstr;
using testing::molecule_of;
using ::testing::ThrowsMessage;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Molecule random_molecule(std::size_t atoms, std::uint32_t seed, double half_edge = 5) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-half_edge, half_edge);
  std::uniform_real_distribution<double> radius(0, 2);
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < atoms; ++i) {
    centers.emplace_back(place(random), place(random), place(random));
    radii.push_back(radius(random));
  }
  return molecule_of(centers, radii);
}

double direct_sum(const Molecule& molecule, double decay, const Vec3& x) {
  double sum = 0;
  for (std::size_t i = 0; i < molecule.atom_count(); ++i)
    sum += std::exp(-decay * ((x - molecule.centers[i]).squaredNorm() - molecule.radii[i] * molecule.radii[i]));
  return sum;
}

/// A block of the unbounded grid with a node at `origin`.
ScalarGrid block_of(const Vec3& origin, double spacing, std::array<std::int32_t, 3> first, std::array<std::uint32_t, 3> size) {
  return {size, origin, spacing, {}, first};
}

/// A block that holds the whole field.
ScalarGrid whole(const GaussianField& field, double spacing) {
  ScalarGrid grid = block_of(field.low(), spacing, {-1, -1, -1}, {});
  for (int axis = 0; axis < 3; ++axis)
    grid.size[axis] = static_cast<std::uint32_t>(std::ceil((field.high()[axis] - field.low()[axis]) / spacing)) + 3;
  return grid;
}

/// Calls visit(position, value) for all nodes.
template <class Visit>
void for_each_node(const ScalarGrid& grid, const Visit& visit) {
  for (std::size_t k = 0; k < grid.size[2]; ++k) {
    for (std::size_t j = 0; j < grid.size[1]; ++j) {
      for (std::size_t i = 0; i < grid.size[0]; ++i)
        visit(Vec3(grid.coordinate(0, i), grid.coordinate(1, j), grid.coordinate(2, k)), grid.values[grid.index(i, j, k)]);
    }
  }
}

std::vector<Vec3> random_points(std::size_t count, std::uint32_t seed, double half_edge = 9) {
  return random_molecule(count, seed, half_edge).centers;
}

TEST(GaussianField, AtNodesIsTheSumOfTheKernelsUpToTheTermsLeftOut) {
  for (const auto& [decay, spacing] : {std::pair{0.6, 0.7}, std::pair{0.3, 0.23}, std::pair{1.2, 1.9}, std::pair{0.6, 6.0}}) {
    const Molecule molecule = random_molecule(30, 1);
    const GaussianField field(molecule, {decay, 1e-6});
    ScalarGrid grid = whole(field, spacing);
    field.sample(grid);
    const double bound = 30 * 1e-6;
    for_each_node(grid, [&, decay = decay](const Vec3& x, double value) {
      const double expected = direct_sum(molecule, decay, x);
      ASSERT_NEAR(value, expected, bound + 1e-12 * expected) << x.transpose();
    });
  }
}

TEST(GaussianField, OfVeryLargeAtomsOnCoarseGridsIsTheSumOfTheKernels) {
  // Kernels so steep from node to node that factors would leave the range of a double.
  const Molecule molecule = molecule_of({{0.2, 0.1, -0.3}, {4, 5, 6}}, {20, 1});
  const GaussianField field(molecule, {0.7, 1e-9});
  for (const double spacing : {1.0, 8.0, 11.0, 40.0, 1000.0}) {
    ScalarGrid grid = whole(field, spacing);
    field.sample(grid);
    for_each_node(grid, [&](const Vec3& x, double value) {
      const double expected = direct_sum(molecule, 0.7, x);
      ASSERT_NEAR(value, expected, 2e-9 + 1e-12 * expected) << spacing;
    });
  }
}

TEST(GaussianField, AtAPointIsTheSumOfTheKernelsUpToTheTermsLeftOut) {
  const Molecule molecule = random_molecule(200, 2);
  const GaussianField field(molecule, {0.6, 1e-6});
  for (const Vec3& x : random_points(500, 3)) {
    const double expected = direct_sum(molecule, 0.6, x);
    EXPECT_NEAR(field.value(x), expected, 200 * 1e-6 + 1e-12 * expected);
    EXPECT_NEAR(field.jet(x).value, field.value(x), 1e-12 * expected);
  }
}

TEST(GaussianField, HasTheDerivativesOfItsDifferences) {
  const GaussianField field(random_molecule(50, 4), {0.6, 1e-12});
  const double step = 1e-4;
  for (const Vec3& x : random_points(50, 5, 5)) {
    const FieldJet jet = field.jet(x);
    const double scale = jet.value + 1;
    for (int axis = 0; axis < 3; ++axis) {
      const FieldJet ahead = field.jet(x + step * Vec3::Unit(axis));
      const FieldJet behind = field.jet(x - step * Vec3::Unit(axis));
      EXPECT_NEAR(jet.gradient[axis], (ahead.value - behind.value) / (2 * step), 1e-6 * scale);
      const Vec3 row = (ahead.gradient - behind.gradient) / (2 * step);
      EXPECT_LT((jet.hessian.col(axis) - row).norm(), 1e-5 * scale);
    }
  }
}

TEST(GaussianField, LeavesOutLessThanTenLeastTermsAtTheDensityOfProteins) {
  // 0.1 atoms per cubic ångström, far enough around the points for what is left out to be there.
  constexpr double kHalfEdge = 14;
  std::mt19937 random(6);
  std::uniform_real_distribution<double> place(-kHalfEdge, kHalfEdge);
  std::vector<Vec3> centers;
  while (static_cast<double>(centers.size()) < 0.1 * std::pow(2 * kHalfEdge, 3))
    centers.emplace_back(place(random), place(random), place(random));
  const Molecule molecule = molecule_of(centers, std::vector<double>(centers.size(), 1.5));
  for (const double least_term : {1e-4, 1e-6}) {
    const GaussianField field(molecule, {0.6, least_term});
    ScalarGrid grid = block_of({0.03, 0.02, 0.01}, 0.9, {-2, -2, -2}, {5, 5, 5});
    field.sample(grid);
    double most = 0;
    for_each_node(grid, [&](const Vec3& x, double value) {
      const double expected = direct_sum(molecule, 0.6, x);
      most = std::max({most, expected - value, expected - field.value(x)});
    });
    EXPECT_LT(most, 10 * least_term);
    EXPECT_GT(most, least_term);  // or the test could not fail
  }
}

TEST(GaussianField, HasTheSameBitsInEveryBlock) {
  for (const auto& [spacing, least_term] : {std::pair{0.745, 1e-6}, std::pair{0.2, 1e-6}, std::pair{3.1, 1e-3}, std::pair{9.0, 1e-40}}) {
    const GaussianField field(random_molecule(60, 7), {0.6, least_term});
    const Vec3 origin = field.low() - Vec3(0.3, 0.2, 0.1);
    const auto nodes = static_cast<std::int32_t>(std::ceil((field.high() - origin).maxCoeff() / spacing)) + 2;
    const auto size = static_cast<std::uint32_t>(nodes);
    ScalarGrid all = block_of(origin, spacing, {0, 0, 0}, {size, size, size});
    field.sample(all);
    std::mt19937 random(8);
    for (int trial = 0; trial < 200; ++trial) {
      ScalarGrid block = block_of(origin, spacing, {}, {});
      for (int axis = 0; axis < 3; ++axis) {
        block.first[axis] = static_cast<std::int32_t>(random() % size);
        block.size[axis] = 1 + static_cast<std::uint32_t>(random()) % std::min(17U, size - static_cast<std::uint32_t>(block.first[axis]));
      }
      field.sample(block);
      for (std::size_t k = 0; k < block.size[2]; ++k) {
        for (std::size_t j = 0; j < block.size[1]; ++j) {
          for (std::size_t i = 0; i < block.size[0]; ++i) {
            const auto& f = block.first;
            ASSERT_EQ(block.values[block.index(i, j, k)], all.values[all.index(i + f[0], j + f[1], k + f[2])]) << spacing;
          }
        }
      }
    }
  }
}

TEST(GaussianField, HasTheSameBitsOnGridsThatAreHalvedWhereItIsAskedForThem) {
  const GaussianField field(random_molecule(60, 5), {0.6, 1e-6});
  ScalarGrid coarse{{9, 10, 11}, {-3.1, -2.7, -3.3}, 0.7, {}, {1, 0, -1}};
  ScalarGrid fine = coarse;
  fine.spacing = 0.5 * coarse.spacing;
  for (int axis = 0; axis < 3; ++axis) {
    fine.first[axis] = 2 * coarse.first[axis];
    fine.size[axis] = 2 * coarse.size[axis] - 1;
  }
  field.sample(coarse, SampleBits::of_position);
  field.sample(fine, SampleBits::of_position);
  for (std::size_t k = 0; k < coarse.size[2]; ++k) {
    for (std::size_t j = 0; j < coarse.size[1]; ++j) {
      for (std::size_t i = 0; i < coarse.size[0]; ++i)
        ASSERT_EQ(coarse.values[coarse.index(i, j, k)], fine.values[fine.index(2 * i, 2 * j, 2 * k)]);
    }
  }
}

TEST(GaussianField, IsZeroOutsideOfItsBox) {
  const GaussianField field(random_molecule(10, 9), {0.6, 1e-6});
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 x = 0.5 * (field.low() + field.high());
      x[axis] = (side < 0 ? field.low() : field.high())[axis] + side * 1e-6;
      EXPECT_EQ(field.value(x), 0.0);
      EXPECT_EQ(field.jet(x).value, 0.0);
      ScalarGrid node = block_of(x, 1, {0, 0, 0}, {1, 1, 1});
      field.sample(node);
      EXPECT_EQ(node.values.front(), 0.0);
      EXPECT_FALSE(field.reaches(x, x));
    }
  }
}

TEST(GaussianField, FarFromTheOriginIsTheSame) {
  const Molecule near = random_molecule(40, 10);
  const Vec3 shift(131072, -131072, 65536);  // powers of two: the moved atoms are rounded to 1e-11 Å, no more
  std::vector<Vec3> moved;
  for (const Vec3& center : near.centers) moved.push_back(center + shift);
  const GaussianField field(near, {});
  const GaussianField far(molecule_of(moved, near.radii), {});
  for (const Vec3& x : random_points(100, 11)) EXPECT_NEAR(far.value(x + shift), field.value(x), 1e-9 * (1 + field.value(x)) + 4e-6);
}

TEST(GaussianField, OfAtomsFarApartIsThatOfEach) {
  std::vector<Vec3> centers;
  for (int i = 0; i < 8; ++i) centers.emplace_back(1e6 * (i & 1), 1e6 * (i >> 1 & 1), 1e6 * (i >> 2));
  const GaussianField field(molecule_of(centers, std::vector<double>(8, 1.5)), {});
  for (const Vec3& center : centers) {
    EXPECT_NEAR(field.value(center + Vec3(1.5, 0, 0)), 1, 1e-9);
    EXPECT_NEAR(field.jet(center + Vec3(0, 0, 1.5)).gradient.z(), -2 * 0.6 * 1.5, 1e-9);
    EXPECT_TRUE(field.reaches(center, center));
  }
  EXPECT_TRUE(field.reaches(field.low(), field.high()));
  EXPECT_FALSE(field.reaches(Vec3::Constant(1e5), Vec3::Constant(9e5)));
  EXPECT_EQ(field.reached_cubes(field.low() - Vec3::Constant(100), 1000).size(), 8U);
}

TEST(GaussianField, OfAtomsAtOnePlaceAddsUp) {
  const Vec3 place(1, 2, 3);
  const GaussianField one(molecule_of({place}, {1.2}), {});
  const GaussianField three(molecule_of({place, place, place}, {1.2, 1.2, 1.2}), {});
  for (const Vec3& x : random_points(20, 12, 4)) EXPECT_NEAR(three.value(x), 3 * one.value(x), 1e-14 * one.value(x));
}

TEST(GaussianField, ReachedCubesAreThoseWithNodesThatAreNotZero) {
  const GaussianField field(random_molecule(12, 13, 20), {0.6, 1e-6});
  const Vec3 origin(0.1, -0.2, 0.3);
  for (const double edge : {30.0, 8.0, 3.0, 1.1}) {
    const auto cubes = field.reached_cubes(origin, edge);
    const auto by_zyx = [](const auto& a, const auto& b) { return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]); };
    EXPECT_TRUE(std::is_sorted(cubes.begin(), cubes.end(), by_zyx)) << edge;
    EXPECT_EQ(std::adjacent_find(cubes.begin(), cubes.end()), cubes.end()) << edge;
    ScalarGrid grid = whole(field, 0.37);
    field.sample(grid);
    for_each_node(grid, [&](const Vec3& x, double value) {
      if (value == 0) return;
      const Vec3 at = ((x - origin) / edge).array().floor();
      const std::array<std::int32_t, 3> cube = {static_cast<std::int32_t>(at.x()), static_cast<std::int32_t>(at.y()),
                                                static_cast<std::int32_t>(at.z())};
      ASSERT_TRUE(std::binary_search(cubes.begin(), cubes.end(), cube, by_zyx)) << edge;
    });
    for (const auto& cube : cubes) {
      const Vec3 middle = origin + edge * Vec3(cube[0] + 0.5, cube[1] + 0.5, cube[2] + 0.5);
      const bool is_reached = std::ranges::any_of(field.kernels(), [&](const Kernel& kernel) {
        return (kernel.center - middle).cwiseAbs().maxCoeff() <= (1 + 1e-6) * kernel.reach + 0.5 * edge;
      });
      ASSERT_TRUE(is_reached) << edge;
    }
  }
}

TEST(GaussianField, RefusesCubesTooSmallToBeNumbered) {
  const GaussianField field(molecule_of({{0, 0, 0}, {1e5, 0, 0}}, {1, 1}), {});
  EXPECT_THAT([&] { static_cast<void>(field.reached_cubes(field.low(), 1e-5)); },
              ThrowsMessage<InvalidInput>(HasSubstr("too large for blocks of 1e-05")));
}

TEST(GaussianField, SaysThatItMayReachAValueWhereverANodeDoes) {
  const GaussianField field(random_molecule(40, 14, 12), {0.6, 1e-6});
  std::mt19937 random(15);
  int certain = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 low = random_points(1, static_cast<std::uint32_t>(random()), 16).front();
    ScalarGrid block = block_of(low, 0.5, {}, {5, 5, 5});
    field.sample(block);
    const double highest = *std::max_element(block.values.begin(), block.values.end());
    const Vec3 high(block.coordinate(0, 4), block.coordinate(1, 4), block.coordinate(2, 4));
    if (highest > 0) {
      ASSERT_TRUE(field.may_reach(highest, low, high));
    }
    if (!field.may_reach(1, low, high)) ++certain;
  }
  EXPECT_GT(certain, 100);
}

TEST(GaussianField, RefusesMoleculesItCannotSample) {
  const auto build = [](const Molecule& molecule) { return [&molecule] { GaussianField(molecule, {}); }; };
  const Molecule empty;
  EXPECT_THAT(build(empty), ThrowsMessage<InvalidInput>(HasSubstr("no atoms")));
  const Molecule negative = molecule_of({{0, 0, 0}, {1, 0, 0}}, {1, -1.5});
  EXPECT_THAT(build(negative), ThrowsMessage<InvalidInput>(HasSubstr("atom 2 of 2: the radius -1.5 is negative")));
  const Molecule nan_radius = molecule_of({{0, 0, 0}}, {std::nan("")});
  EXPECT_THAT(build(nan_radius), ThrowsMessage<InvalidInput>(HasSubstr("atom 1 of 1: the radius nan is not finite")));
  const Molecule infinite = molecule_of({{0, kInfinity, 0}}, {1});
  EXPECT_THAT(build(infinite), ThrowsMessage<InvalidInput>(HasSubstr("atom 1 of 1: the position (0, inf, 0)")));
  const Molecule huge = molecule_of({{0, 0, 0}}, {100});
  EXPECT_THAT(build(huge), ThrowsMessage<InvalidInput>(HasSubstr("too large")));
  const Molecule unequal{{{0, 0, 0}}, {0}, {}};
  EXPECT_THAT(build(unequal), ThrowsMessage<InvalidInput>(HasSubstr("1 atoms and 0 radii")));
}

TEST(GaussianField, RefusesOptionsOutOfRange) {
  const Molecule molecule = molecule_of({{0, 0, 0}}, {1});
  for (const double bad : {0.0, -1.0, kInfinity, std::nan("")}) {
    EXPECT_THROW(GaussianField(molecule, {bad, 1e-6}), InvalidOption);
    EXPECT_THROW(GaussianField(molecule, {0.6, bad}), InvalidOption);
  }
}

}  // namespace
}  // namespace smopt
