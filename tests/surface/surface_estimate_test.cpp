#include "smopt/surface/surface_estimate.h"

#include <gmock/gmock.h>

#include "smopt/surface/gaussian_surface.h"
#include "tests/support/molecules.h"

namespace smopt {
namespace {

double vertices_of(const Molecule& molecule, const UniformSurface& surface) {
  return static_cast<double>(gaussian_surface(molecule, {0.6, surface.isovalue, surface.spacing}).vertex_count());
}

TEST(SurfaceEstimate, CountsTheVerticesToATenth) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const Molecule molecule = testing::random_cluster(1000, seed);
    const GaussianField field(molecule, {});
    for (const UniformSurface& surface : {UniformSurface{1, 0.745}, UniformSurface{1, 0.4}, UniformSurface{0.5, 0.5}}) {
      const double vertices = vertices_of(molecule, surface);
      EXPECT_NEAR(estimated_vertices(field, surface), vertices, 0.1 * vertices) << "seed " << seed << ", spacing " << surface.spacing;
    }
  }
}

TEST(SurfaceEstimate, CountsTheVerticesOfACoarseGridThemselves) {
  const Molecule molecule = testing::random_cluster(300, 4);
  const double vertices = vertices_of(molecule, {1, 1.6});
  EXPECT_NEAR(estimated_vertices(GaussianField(molecule, {}), {1, 1.6}), vertices, 0.001 * vertices);  // a few are inside of cells
}

TEST(SurfaceEstimate, BoundsTheVerticesByTheAtoms) {
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U}) {
    for (const std::size_t atoms : {1, 2, 10, 100}) {
      Molecule molecule = testing::random_cluster(atoms, seed);
      molecule.radii.front() = 2;
      const GaussianField field(molecule, {});
      for (const UniformSurface& surface : {UniformSurface{1, 0.3}, UniformSurface{1, 1.2}, UniformSurface{0.2, 0.5}})
        EXPECT_GT(most_vertices(field, surface), vertices_of(molecule, surface)) << atoms << " atoms, seed " << seed;
    }
  }
  const GaussianField at_one_place(testing::molecule_of(std::vector<Vec3>(50, Vec3::Zero()), std::vector<double>(50, 0)), {});
  EXPECT_GT(most_vertices(at_one_place, {1, 0.2}), 1.5 * 4 * 3.14 * std::log(50.0) / 0.6 / 0.04);
}

}  // namespace
}  // namespace smopt
