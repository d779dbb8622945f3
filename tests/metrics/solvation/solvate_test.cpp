#include "metrics/solvation/solvate.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "smopt/error.h"
#include "smopt/mesh/orientation.h"
#include "tests/metrics/solvation/direct_energy.h"
#include "tests/metrics/solvation/kirkwood.h"
#include "tests/support/shapes.h"
#include "tests/support/threads.h"

namespace smopt::metrics {
namespace {

using namespace smopt::testing;

constexpr double kRadius = 4;

Molecule molecule_of(std::span<const PointCharge> charges) {
  Molecule molecule;
  for (const PointCharge& c : charges) {
    molecule.centers.push_back(c.position);
    molecule.charges.push_back(c.charge);
    molecule.radii.push_back(1);
  }
  return molecule;
}

const std::vector<PointCharge> kCentral = {{Vec3::Zero(), 1}};
const std::vector<PointCharge> kThree = {{{1.5, 0.3, -1}, 1}, {{-1, 1.2, 0.4}, -0.7}, {{0.2, -2, 1}, 0.9}};

SolvationOptions with_salt(double millimolar) {
  SolvationOptions options;
  options.medium.ionic_strength = millimolar;
  return options;
}

DielectricSphere sphere_in(const DielectricModel& medium) {
  return {medium.inner, medium.outer, medium.kappa()};
}

/// An icosphere whose vertices were moved along the sphere, so that no two triangles are alike.
TriangleMesh irregular_sphere(int subdivisions, double radius = kRadius) {
  TriangleMesh mesh = noisy(icosphere(subdivisions), 0.3 / (1 << subdivisions), 7);
  for (Vec3& p : mesh.points) p *= radius / p.norm();
  return mesh;
}

double relative_error(const TriangleMesh& mesh, std::span<const PointCharge> charges, const SolvationOptions& options) {
  const Solvation result = solvate(mesh, molecule_of(charges), options);
  EXPECT_EQ(result.status, SolvationStatus::success) << result.reason;
  return std::abs(result.polar / kirkwood_energy(kRadius, sphere_in(options.medium), charges) - 1);
}

TEST(DielectricModel, HasAfmpbsDefaults) {
  EXPECT_NEAR(DielectricModel().kappa(), 0.125714, 5e-7);
  EXPECT_EQ(DielectricModel().ratio(), 40);
  EXPECT_NEAR(DielectricModel().thermal_energy(), 0.59616, 1e-5);
}

/// Errors below this are those of the sums, not the mesh's.
constexpr double kNegligible = 5e-5;

/// Of a tighter accuracy than the default's, so that the mesh's error shows.
SolvationOptions accurate_with_salt(double millimolar) {
  SolvationOptions options = with_salt(millimolar);
  options.accuracy = 1e-3;
  return options;
}

/// Without salt a constant potential is the solution, which is exact on any mesh. What is wanted is 0.5 % at 10 000 vertices, at first order or better.
TEST(Solvate, BornsEnergyConvergesAtFirstOrderOrBetter) {
  for (const double salt : {0.0, 150.0}) {
    const SolvationOptions options = accurate_with_salt(salt);
    double last = std::numeric_limits<double>::infinity();
    for (const int subdivisions : {3, 4, 5}) {
      const double error = relative_error(icosphere(subdivisions, kRadius), kCentral, options);
      EXPECT_LT(error, std::max(last / 2, kNegligible)) << salt << ' ' << subdivisions;
      last = error;
    }
    EXPECT_LT(last, 0.001);
  }
}

TEST(Solvate, KirkwoodsEnergyConvergesAtFirstOrderOrBetter) {
  for (const double salt : {0.0, 150.0}) {
    const SolvationOptions options = accurate_with_salt(salt);
    double last = std::numeric_limits<double>::infinity();
    for (const int subdivisions : {2, 3, 4, 5}) {
      const double error = relative_error(irregular_sphere(subdivisions), kThree, options);
      EXPECT_LT(error, last / 2) << salt << ' ' << subdivisions;
      last = error;
    }
    EXPECT_LT(last, 0.001);
  }
}

TEST(Solvate, UnknownsAreKirkwoodsAtTheVertices) {
  const SolvationOptions options;
  const TriangleMesh mesh = icosphere(4, kRadius);
  const Solvation result = solvate(mesh, molecule_of(kThree), options);
  double errors[2] = {}, norms[2] = {};
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const SurfacePotential exact = kirkwood_potential(kRadius, sphere_in(options.medium), kThree, mesh.points[v]);
    errors[0] += std::pow(result.potential[v] / kPotentialUnit - exact.potential, 2);
    errors[1] += std::pow(result.normal_derivative[v] / kPotentialUnit - exact.normal_derivative, 2);
    norms[0] += exact.potential * exact.potential;
    norms[1] += exact.normal_derivative * exact.normal_derivative;
  }
  EXPECT_LT(std::sqrt(errors[0] / norms[0]), 0.01);
  EXPECT_LT(std::sqrt(errors[1] / norms[1]), 0.01);
}

TEST(Solvate, OtherMediaAreTheirFormulasToo) {
  for (const DielectricModel& medium :
       {DielectricModel{1, 78.5, 500, 310}, DielectricModel{4, 4, 100, 298}, DielectricModel{80, 2, 0, 300}}) {
    SolvationOptions options;
    options.medium = medium;
    const double exact = kirkwood_energy(kRadius, sphere_in(medium), kThree);
    EXPECT_NEAR(solvate(icosphere(4, kRadius), molecule_of(kThree), options).polar, exact, 0.01 * std::abs(exact));
  }
}

TEST(Solvate, NothingHappensWhereBothMediaAreTheSame) {
  SolvationOptions options = with_salt(0);
  options.medium.inner = options.medium.outer = 7;
  EXPECT_NEAR(solvate(icosphere(3, kRadius), molecule_of(kThree), options).polar, 0, 1e-12);
}

TEST(Solvate, EnergyGoesWithTheSquareOfTheCharges) {
  const TriangleMesh mesh = irregular_sphere(3);
  std::vector<PointCharge> doubled = kThree;
  for (PointCharge& c : doubled) c.charge *= -2;
  const double polar = solvate(mesh, molecule_of(kThree)).polar;
  EXPECT_NEAR(solvate(mesh, molecule_of(doubled)).polar, 4 * polar, 1e-10 * std::abs(polar));
}

TEST(Solvate, EnergyGoesWithTheInverseOfTheLengthsWithoutSalt) {
  std::vector<PointCharge> larger = kThree;
  for (PointCharge& c : larger) c.position *= 4;
  SolvationOptions options = with_salt(0);
  options.residual = 1e-10;  // whose norm adds up numbers of different units
  const double polar = solvate(irregular_sphere(3), molecule_of(kThree), options).polar;
  EXPECT_NEAR(solvate(irregular_sphere(3, 4 * kRadius), molecule_of(larger), options).polar, polar / 4, 1e-8 * std::abs(polar));
}

struct Motion {
  Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  Vec3 shift = {31, -12, 5};

  [[nodiscard]] TriangleMesh operator()(TriangleMesh mesh) const {
    for (Vec3& p : mesh.points) p = turn * p + shift;
    return mesh;
  }
  [[nodiscard]] std::vector<PointCharge> operator()(std::vector<PointCharge> charges) const {
    for (PointCharge& c : charges) c.position = turn * c.position + shift;
    return charges;
  }
};

TEST(Solvate, EnergyIsInvariantUnderRigidMotionByDirectSummation) {
  SolvationOptions options;
  options.is_direct = true;
  options.residual = 1e-10;
  const TriangleMesh mesh = irregular_sphere(4);
  const double polar = solvate(mesh, molecule_of(kThree), options).polar;
  const Motion motion;
  EXPECT_NEAR(solvate(motion(mesh), molecule_of(motion(kThree)), options).polar, polar, 1e-6 * std::abs(polar));
}

TEST(Solvate, EnergyIsInvariantUnderRigidMotionWithinTheAccuracy) {
  const TriangleMesh mesh = irregular_sphere(4);
  const Motion motion;
  for (const double accuracy : {1e-2, 1e-3}) {
    SolvationOptions options;
    options.accuracy = accuracy;
    const double polar = solvate(mesh, molecule_of(kThree), options).polar;
    EXPECT_NEAR(solvate(motion(mesh), molecule_of(motion(kThree)), options).polar, polar, accuracy * std::abs(polar));
  }
}

TEST(Solvate, IsWithinTheAccuracyOfDirectSummation) {
  const TriangleMesh mesh = irregular_sphere(4);
  for (const double accuracy : {1e-2, 1e-3, 1e-4}) {
    SolvationOptions options;
    options.accuracy = accuracy;
    options.residual = 1e-9;
    const double polar = solvate(mesh, molecule_of(kThree), options).polar;
    options.is_direct = true;
    EXPECT_NEAR(solvate(mesh, molecule_of(kThree), options).polar, polar, accuracy * std::abs(polar));
  }
}

/// What was asked, of what the sums change of the energy.
TEST(Solvate, IsWithinTheAccuracyOfTheBestSums) {
  for (const int subdivisions : {3, 4}) {
    const TriangleMesh mesh = irregular_sphere(subdivisions);
    SolvationOptions options;
    options.residual = 1e-9;
    options.accuracy = 1e-4;
    const double best = solvate(mesh, molecule_of(kThree), options).polar;
    for (const double accuracy : {0.1, 1e-2, 3e-3, 1e-3}) {
      options.accuracy = accuracy;
      EXPECT_NEAR(solvate(mesh, molecule_of(kThree), options).polar, best, accuracy * std::abs(best)) << subdivisions;
    }
  }
}

/// The same unknowns give nearly the same energy by a sum that shares nothing with the solver's: what is left is smaller than the mesh's own error, and of
/// second order as that is.
TEST(Solvate, EnergyIsWhatItsUnknownsStandFor) {
  double last = std::numeric_limits<double>::infinity();
  for (const int subdivisions : {3, 4}) {
    const TriangleMesh mesh = irregular_sphere(subdivisions);
    SolvationOptions options;
    options.accuracy = 1e-3;
    const Solvation result = solvate(mesh, molecule_of(kThree), options);
    std::vector<SurfacePotential> unknowns;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
      unknowns.push_back({result.potential[v] / kPotentialUnit, result.normal_derivative[v] / kPotentialUnit});
    const double direct = direct_polar_energy(mesh, sphere_in(options.medium), kThree, unknowns);
    const double difference = std::abs(result.polar - direct);
    EXPECT_LT(difference, std::abs(direct - kirkwood_energy(kRadius, sphere_in(options.medium), kThree)));
    EXPECT_LT(difference, last / 3);
    last = difference;
  }
}

TEST(Solvate, DoesNotDependOnTheNumbersOfTheVertices) {
  SolvationOptions options;
  options.residual = 1e-10;
  options.is_direct = true;
  const TriangleMesh mesh = irregular_sphere(3);
  const double polar = solvate(mesh, molecule_of(kThree), options).polar;
  EXPECT_NEAR(solvate(relabelled(mesh, 5), molecule_of(kThree), options).polar, polar, 1e-7 * std::abs(polar));
}

TEST(Solvate, HasTheSameBytesForAnyNumberOfThreads) {
  const TriangleMesh mesh = irregular_sphere(4);
  expect_same_for_any_threads([&] {
    const Solvation result = solvate(mesh, molecule_of(kThree));
    std::vector<double> numbers = result.potential;
    numbers.insert(numbers.end(), result.normal_derivative.begin(), result.normal_derivative.end());
    numbers.push_back(result.polar);
    return numbers;
  });
}

TEST(Solvate, NonpolarPartIsOfAreaAndVolume) {
  const Solvation result = solvate(cube(), molecule_of(std::vector<PointCharge>{{{0.5, 0.5, 0.5}, 1}}));
  EXPECT_NEAR(result.area, 6, 1e-14);
  EXPECT_NEAR(result.volume, 1, 1e-14);
  EXPECT_NEAR(result.nonpolar, 0.005 * 6 + 0.035, 1e-15);
  EXPECT_EQ(result.total(), result.polar + result.nonpolar);
}

TEST(Solvate, TurnsAMeshOfNegativeVolumeRound) {
  const TriangleMesh mesh = icosphere(2, kRadius);
  const Solvation result = solvate(reversed(mesh), molecule_of(kThree));
  EXPECT_NEAR(result.polar, solvate(mesh, molecule_of(kThree)).polar, 1e-5 * std::abs(result.polar));
  EXPECT_GT(result.volume, 0);
}

TEST(Solvate, TwoSpheresFarApartAddUp) {
  std::vector<PointCharge> both = kThree;
  const Vec3 away(4000, 0, 0);
  for (const PointCharge& c : kThree) both.push_back({c.position + away, c.charge});
  const TriangleMesh mesh = irregular_sphere(3);
  const double one = solvate(mesh, molecule_of(kThree)).polar;
  const double two = solvate(joined(mesh, translated(mesh, away)), molecule_of(both)).polar;
  EXPECT_NEAR(two, 2 * one, SolvationOptions().accuracy * std::abs(one));
}

TEST(Solvate, WithoutChargesThereIsNothingToSolve) {
  for (const std::vector<PointCharge>& charges : {std::vector<PointCharge>{}, std::vector<PointCharge>{{Vec3::Zero(), 0}}}) {
    const Solvation result = solvate(icosphere(2, kRadius), molecule_of(charges));
    EXPECT_EQ(result.status, SolvationStatus::no_charges);
    EXPECT_EQ(result.polar, 0);
    EXPECT_GT(result.nonpolar, 0);
    EXPECT_FALSE(result.reason.empty());
    EXPECT_THAT(result.potential, ::testing::Each(0.0));
  }
}

TEST(Solvate, TellsThatItDidNotConverge) {
  SolvationOptions options;
  options.max_iterations = 2;
  const Solvation result = solvate(irregular_sphere(3), molecule_of(kThree), options);
  EXPECT_EQ(result.status, SolvationStatus::not_converged);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_GT(result.relative_residual, options.residual);
  EXPECT_THAT(result.reason, ::testing::HasSubstr("2 iterations"));
}

TEST(Solvate, RestartsReachTheSameSolution) {
  SolvationOptions options;
  options.block = 1;
  const double polar = solvate(irregular_sphere(3), molecule_of(kThree), options).polar;
  options.restart = 3;
  const Solvation restarted = solvate(irregular_sphere(3), molecule_of(kThree), options);
  EXPECT_EQ(restarted.status, SolvationStatus::success);
  EXPECT_NEAR(restarted.polar, polar, 1e-5 * std::abs(polar));
}

TEST(Solvate, SolutionDoesNotDependOnThePreconditionersBlocks) {
  SolvationOptions options;
  const Solvation blocks = solvate(irregular_sphere(3), molecule_of(kThree), options);
  options.block = 1;
  const Solvation points = solvate(irregular_sphere(3), molecule_of(kThree), options);
  EXPECT_NEAR(points.polar, blocks.polar, 1e-5 * std::abs(blocks.polar));
}

TEST(Solvate, ChargesThatCancelAtOnePlaceHaveNoEnergy) {
  const Solvation result = solvate(icosphere(2, kRadius), molecule_of(std::vector<PointCharge>{{{1, 0, 0}, 1}, {{1, 0, 0}, -1}}));
  EXPECT_EQ(result.status, SolvationStatus::success) << result.reason;
  EXPECT_EQ(result.polar, 0);
}

/// A shell: the water inside it screens a charge in its wall as the water outside does.
TEST(Solvate, CavitiesPointInwards) {
  const std::vector<PointCharge> charges = {{{3, 0, 0}, 1}};
  const TriangleMesh shell = joined(icosphere(4, kRadius), reversed(icosphere(3, 2)));
  const Solvation result = solvate(shell, molecule_of(charges));
  EXPECT_EQ(result.status, SolvationStatus::success) << result.reason;
  EXPECT_EQ(result.charges_outside, 0);
  EXPECT_LT(result.polar, solvate(icosphere(4, kRadius), molecule_of(charges)).polar);
  EXPECT_EQ(solvate(shell, molecule_of(kCentral)).charges_outside, 1);
}

TEST(Solvate, RefusesComponentsThatPointTheWrongWay) {
  const Molecule molecule = molecule_of(kCentral);
  EXPECT_THROW(solvate(joined(icosphere(2, kRadius), reversed(translated(icosphere(2), {10, 0, 0}))), molecule), InvalidMesh);
  EXPECT_THROW(solvate(joined(icosphere(2, kRadius), icosphere(2)), molecule), InvalidMesh);
}

TEST(Solvate, RefusesASurfaceThatEnclosesNothing) {
  const Molecule molecule = molecule_of(kCentral);
  const TriangleMesh pillow = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_THROW(solvate(pillow, molecule), InvalidMesh);
  EXPECT_THROW(solvate(scaled(tetrahedron(), 0), molecule), InvalidMesh);
}

TEST(Solvate, RefusesAtomsThatAreNotFinite) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(solvate(icosphere(1), molecule_of(std::vector<PointCharge>{{{0, 0, inf}, 1}})), InvalidInput);
  EXPECT_THROW(solvate(icosphere(1), molecule_of(std::vector<PointCharge>{{{0, 0, 0}, inf}})), InvalidInput);
}

TEST(Solvate, AChargeOnAVertexIsNotFinite) {
  const TriangleMesh mesh = icosphere(2, kRadius);
  std::vector<PointCharge> charges = kThree;
  charges.push_back({mesh.points[17], 0.3});
  const Solvation result = solvate(mesh, molecule_of(charges));
  EXPECT_EQ(result.status, SolvationStatus::nonfinite);
  EXPECT_THAT(result.reason, ::testing::HasSubstr("vertex 17"));
  EXPECT_TRUE(std::isnan(result.polar));
  EXPECT_EQ(result.charges_outside, 1);
}

TEST(Solvate, CountsChargesOutside) {
  std::vector<PointCharge> charges = kThree;
  charges.push_back({{5, 0, 0}, 1});
  EXPECT_EQ(solvate(icosphere(3, kRadius), molecule_of(charges)).charges_outside, 1);
  EXPECT_EQ(solvate(icosphere(3, kRadius), molecule_of(kThree)).charges_outside, 0);
}

/// A vertex put into a triangle's middle, from where it is pulled out to `height`; its three triangles may have no area.
TriangleMesh with_vertex_in_face(TriangleMesh mesh, FaceId face, const Vec3& position) {
  const Triangle t = mesh.triangles[face];
  const auto v = static_cast<VertexId>(mesh.vertex_count());
  mesh.points.push_back(position);
  mesh.triangles[face] = {t[0], t[1], v};
  mesh.triangles.push_back({t[1], t[2], v});
  mesh.triangles.push_back({t[2], t[0], v});
  return mesh;
}

/// A corner is doubled: the edge between the two has no length, and the two triangles at it no area.
TriangleMesh with_split_vertex(TriangleMesh mesh, VertexId v) {
  const auto twin = static_cast<VertexId>(mesh.vertex_count());
  mesh.points.push_back(mesh.points[v]);
  // The triangles of the star, in order around it.
  std::vector<Triangle> fan;
  for (const Triangle& t : mesh.triangles)
    for (int c = 0; c < 3; ++c)
      if (t[c] == v) fan.push_back({t[c], t[(c + 1) % 3], t[(c + 2) % 3]});
  for (std::size_t k = 0; k + 1 < fan.size(); ++k)
    for (std::size_t next = k + 1; next < fan.size(); ++next)
      if (fan[next][1] == fan[k][2]) std::swap(fan[k + 1], fan[next]);
  for (Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < fan.size() / 2; ++k)
      for (int c = 0; c < 3; ++c)
        if (t[c] == v && t[(c + 1) % 3] == fan[k][1]) t[c] = twin;
  mesh.triangles.push_back({v, fan[0][1], twin});
  mesh.triangles.push_back({twin, fan[fan.size() / 2 - 1][2], v});
  return mesh;
}

TEST(Solvate, ATwinOfAVertexChangesNothing) {
  const TriangleMesh mesh = irregular_sphere(3);
  const double polar = solvate(mesh, molecule_of(kThree)).polar;
  const Solvation result = solvate(with_split_vertex(mesh, 100), molecule_of(kThree));
  EXPECT_EQ(result.status, SolvationStatus::success) << result.reason;
  EXPECT_NEAR(result.polar, polar, 2e-3 * std::abs(polar));
}

TEST(Solvate, AVertexInTheMiddleOfATriangleChangesLittle) {
  const TriangleMesh mesh = irregular_sphere(3);
  const Triangle& t = mesh.triangles[50];
  const Vec3 middle = (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3;
  const double polar = solvate(mesh, molecule_of(kThree)).polar;
  const Solvation result = solvate(with_vertex_in_face(mesh, 50, middle), molecule_of(kThree));
  EXPECT_EQ(result.status, SolvationStatus::success) << result.reason;
  EXPECT_NEAR(result.polar, polar, 2e-3 * std::abs(polar));
}

/// All triangles at a vertex have no area: AFMPB divides by zero there.
TEST(Solvate, NamesVerticesWithoutANormalAndSolvesForTheOthers) {
  TriangleMesh mesh = irregular_sphere(3);
  const double polar = solvate(mesh, molecule_of(kThree)).polar;
  const std::size_t before = mesh.vertex_count();
  // A triangle folded flat onto one of its edges, three times: the new vertex's triangles lie on that edge.
  const Triangle t = mesh.triangles[50];
  mesh = with_vertex_in_face(mesh, 50, mesh.points[t[0]]);
  mesh = with_vertex_in_face(mesh, static_cast<FaceId>(mesh.triangle_count() - 1), mesh.points[t[0]]);
  const Solvation result = solvate(mesh, molecule_of(kThree));
  EXPECT_THAT(result.degenerate_vertices, ::testing::Contains(static_cast<VertexId>(before + 1)));
  EXPECT_EQ(result.status, SolvationStatus::success) << result.reason;
  EXPECT_NEAR(result.polar, polar, 2e-3 * std::abs(polar));
}

TEST(Solvate, LeavesOutPointsInNoTriangle) {
  TriangleMesh mesh = irregular_sphere(2);
  const Solvation without = solvate(mesh, molecule_of(kThree));
  mesh.points.insert(mesh.points.begin() + 5, Vec3(0.1, 0.2, 0.3));
  for (Triangle& t : mesh.triangles)
    for (VertexId& v : t)
      if (v >= 5) ++v;
  const Solvation result = solvate(mesh, molecule_of(kThree));
  EXPECT_EQ(result.polar, without.polar);
  ASSERT_EQ(result.potential.size(), mesh.vertex_count());
  EXPECT_TRUE(std::isnan(result.potential[5]));
  EXPECT_EQ(result.potential[6], without.potential[5]);
}

TEST(Solvate, RefusesASurfaceThatIsNone) {
  const Molecule molecule = molecule_of(kThree);
  EXPECT_THROW(solvate({}, molecule), InvalidMesh);
  TriangleMesh open = icosphere(1);
  open.triangles.pop_back();
  EXPECT_THROW(solvate(open, molecule), InvalidMesh);
  TriangleMesh turned = icosphere(1);
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  EXPECT_THROW(solvate(turned, molecule), InvalidMesh);
  TriangleMesh nowhere = icosphere(1);
  nowhere.points[2].x() = std::nan("");
  EXPECT_THROW(solvate(nowhere, molecule), InvalidMesh);
}

TEST(Solvate, RefusesOptionsOutOfTheirRange) {
  const auto refuses = [](auto change) {
    SolvationOptions options;
    change(options);
    EXPECT_THROW(solvate(icosphere(1), molecule_of(kCentral), options), InvalidOption);
  };
  refuses([](SolvationOptions& o) { o.medium.inner = 0; });
  refuses([](SolvationOptions& o) { o.medium.outer = std::nan(""); });
  refuses([](SolvationOptions& o) { o.medium.ionic_strength = -1; });
  refuses([](SolvationOptions& o) { o.medium.temperature = 0; });
  refuses([](SolvationOptions& o) { o.medium.ionic_strength = 1e308; });
  refuses([](SolvationOptions& o) { o.accuracy = 0.5; });
  refuses([](SolvationOptions& o) { o.accuracy = 0.9e-4; });
  refuses([](SolvationOptions& o) { o.residual = 0; });
  refuses([](SolvationOptions& o) { o.max_iterations = 0; });
  refuses([](SolvationOptions& o) { o.restart = 0; });
  refuses([](SolvationOptions& o) { o.block = 0; });
}

TEST(Solvate, RefusesWhatNeedsMoreMemoryThanAllowedWithTheEstimate) {
  SolvationOptions options;
  options.max_memory_bytes = 1 << 20;
  try {
    solvate(icosphere(4, kRadius), molecule_of(kThree), options);
    FAIL() << "not refused";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), ::testing::ContainsRegex("some [0-9]+ MB"));
  }
}

TEST(Solvate, PredictsMoreMemoryForMoreOfEverything) {
  const auto bytes = [](int subdivisions, std::size_t charges, auto change) {
    SolvationOptions options;
    change(options);
    return predicted_solvation_bytes(icosphere(subdivisions, kRadius), molecule_of(std::vector<PointCharge>(charges, kCentral[0])),
                                     options);
  };
  const auto defaults = [](SolvationOptions&) {};
  const double usual = bytes(4, 10, defaults);
  EXPECT_GT(bytes(5, 10, defaults), 2 * usual);
  EXPECT_GT(bytes(4, 100'000, defaults), usual + 100'000 * sizeof(PointCharge));
  EXPECT_GT(bytes(4, 10, [](SolvationOptions& o) { o.accuracy = 1e-4; }), usual);
  EXPECT_GT(bytes(4, 10, [](SolvationOptions& o) { o.block = 1000; }), usual);
  EXPECT_LT(bytes(4, 10, [](SolvationOptions& o) { o.restart = 10; }), usual);
  // A block cannot be larger than the surface.
  EXPECT_EQ(bytes(3, 10, [](SolvationOptions& o) { o.block = 642; }), bytes(3, 10, [](SolvationOptions& o) { o.block = 2'000'000'000; }));
}

TEST(Solvate, CanBeCancelled) {
  for (const std::string_view at : {"close pairs", "solving"}) {
    SolvationOptions options;
    options.progress = [at](std::string_view stage, double) { return stage != at; };
    EXPECT_THROW(solvate(icosphere(3, kRadius), molecule_of(kThree), options), Cancelled) << at;
  }
}

}  // namespace
}  // namespace smopt::metrics
