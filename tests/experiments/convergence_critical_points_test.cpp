#include "experiments/convergence/critical_points.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "experiments/convergence/change_explanation.h"
#include "tests/experiments/convergence_molecules.h"

namespace smopt::experiments {
namespace {

using namespace testing;
using ::testing::DoubleNear;
using ::testing::ElementsAre;

/// All cubes that a kernel reaches.
std::vector<CriticalPoint> all_critical_points(const GaussianField& field) {
  const CellLattice lattice = partition_space(field, 1, 1).lattice;
  return critical_points_near(field, 1, lattice, field.reached_cubes(lattice.origin, lattice.root_edge));
}

std::vector<int> indices_of(const std::vector<CriticalPoint>& points) {
  std::vector<int> indices;
  for (const CriticalPoint& point : points) indices.push_back(point.index());
  std::sort(indices.begin(), indices.end());
  return indices;
}

/// By Morse's theory: maxima − saddles of index 2 + saddles of index 1 − minima, for a function that falls to zero at infinity.
int alternating_sum(const std::vector<CriticalPoint>& points) {
  int sum = 0;
  for (const CriticalPoint& point : points) sum += point.index() % 2 == 1 ? 1 : -1;
  return sum;
}

TEST(CriticalPoints, OfTwoAtomsAreTheMaximaAndTheSaddleHalfWayBetween) {
  const double distance = merging_distance() + 0.1;
  const Vec3 direction = Vec3(1, 2, 3).normalized();
  const GaussianField field = field_of(two_atoms(distance));
  const std::vector<CriticalPoint> points = all_critical_points(field);
  ASSERT_THAT(indices_of(points), ElementsAre(2, 3, 3));

  const CriticalPoint& saddle = points.front();  // nearest to the isovalue
  const double value = 2 * std::exp(-kDecay * (distance * distance / 4 - kRadius * kRadius));
  EXPECT_LT((saddle.position - distance / 2 * direction).norm(), 1e-5);
  EXPECT_NEAR(saddle.value, value, 1e-5);
  EXPECT_NEAR(saddle.curvatures[0], -2 * kDecay * value, 1e-4);
  EXPECT_NEAR(saddle.curvatures[1], -2 * kDecay * value, 1e-4);
  EXPECT_NEAR(saddle.curvatures[2], (kDecay * kDecay * distance * distance - 2 * kDecay) * value, 1e-4);
  EXPECT_EQ(saddle.gain_when_inside(), -2);
}

TEST(CriticalPoints, OfThreeAtomsInATriangleAreThreeMaximaThreeNecksAndTheHole) {
  const double side = 4;
  const Molecule triangle = molecule_of({{0, 0, 0}, {side, 0, 0}, {side / 2, side * std::sqrt(3.0) / 2, 0}});
  const std::vector<CriticalPoint> points = all_critical_points(field_of(triangle));
  ASSERT_THAT(indices_of(points), ElementsAre(1, 2, 2, 2, 3, 3, 3));

  const auto hole = std::find_if(points.begin(), points.end(), [](const CriticalPoint& point) { return point.index() == 1; });
  EXPECT_LT((hole->position - Vec3(side / 2, side / std::sqrt(12.0), 0)).norm(), 1e-5);
  EXPECT_NEAR(hole->value, 3 * std::exp(-kDecay * (side * side / 3 - kRadius * kRadius)), 1e-5);
  EXPECT_EQ(hole->gain_when_inside(), 2);
}

TEST(CriticalPoints, OfRandomClustersLeaveNoneOutByMorsesCount) {
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U})
    EXPECT_EQ(alternating_sum(all_critical_points(field_of(random_cluster(30, seed)))), 1) << seed;
}

TEST(CriticalPoints, ComeInTheOrderOfTheirDistanceFromTheIsovalue) {
  const std::vector<CriticalPoint> points = all_critical_points(field_of(random_cluster(20, 7)));
  ASSERT_GT(points.size(), 20U);
  EXPECT_TRUE(std::is_sorted(points.begin(), points.end(),
                             [](const CriticalPoint& a, const CriticalPoint& b) { return std::abs(a.value - 1) < std::abs(b.value - 1); }));
}

TEST(BendRadius, OfOneAtomIsItsRadius) {
  const GaussianField field = field_of(molecule_of({{0.3, 0.2, 0.1}}));
  EXPECT_THAT(bend_radius(field, Vec3(0.3, 0.2, 0.1) + kRadius * Vec3(1, -1, 1).normalized()), DoubleNear(kRadius, 1e-9));
}

TEST(EventNames, TellWhatHappensToThePartsOfTheInside) {
  CriticalPoint point;
  point.curvatures = {-1, -1, 1};
  EXPECT_EQ(event_name(point, false), "neck cut");
  EXPECT_EQ(event_name(point, true), "neck joined");
  point.curvatures = {1, 1, 1};
  EXPECT_EQ(event_name(point, false), "pocket opened");
  EXPECT_EQ(point.gain_when_inside(), -2);
}

}  // namespace
}  // namespace smopt::experiments
