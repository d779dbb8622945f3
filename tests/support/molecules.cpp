#include "tests/support/molecules.h"

#include <random>

namespace smopt::testing {

Molecule molecule_of(std::vector<Vec3> centers, std::vector<double> radii) {
  const std::size_t n = centers.size();
  return {std::move(centers), std::vector<double>(n, 0.0), std::move(radii)};
}

Molecule random_cluster(std::size_t atoms, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> distance(0.5, 3);
  std::uniform_real_distribution<double> radius(0, 2);
  std::vector<Vec3> centers = {Vec3(normal(random), normal(random), normal(random))};
  std::vector<double> radii = {radius(random)};
  while (centers.size() < atoms) {
    const Vec3& from = centers[random() % centers.size()];
    const Vec3 direction = Vec3(normal(random), normal(random), normal(random)).normalized();
    centers.emplace_back(from + distance(random) * direction);
    radii.push_back(radius(random));
  }
  return molecule_of(std::move(centers), std::move(radii));
}

}  // namespace smopt::testing
