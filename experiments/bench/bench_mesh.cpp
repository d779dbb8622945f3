#include "experiments/bench/bench_mesh.h"

#include <malloc.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "experiments/datasets.h"
#include "smopt/improve/prepare.h"
#include "smopt/improve/redundant_points.h"
#include "smopt/io/molecule.h"
#include "smopt/surface/gaussian_surface.h"

namespace smopt::bench {
namespace {

/// From one copy to the next, Å: the molecule is 75 Å long, and its surface lies some Å outside the atoms' centres.
constexpr double kCopyDistance = 90;

const experiments::Dataset& ache_monomer() {
  static const experiments::Dataset dataset = [] {
    const std::array<std::string, 1> names{"ache-monomer"};
    return experiments::find_datasets(experiments::all_datasets(), names).front();
  }();
  return dataset;
}

void add_atom(Molecule& molecule, const Vec3& center, double radius) {
  molecule.centers.push_back(center);
  molecule.charges.push_back(0);
  molecule.radii.push_back(radius);
}

/// Forty overlapping spheres on a helix.
Molecule helix() {
  constexpr int kAtoms = 40;
  constexpr double kRadius = 1.7;
  Molecule molecule;
  for (int i = 0; i < kAtoms; ++i) add_atom(molecule, {6 * std::cos(0.4 * i), 6 * std::sin(0.4 * i), 0.5 * i}, kRadius);
  return molecule;
}

/// On a cubic lattice, filled row by row.
Molecule copies_of(const Molecule& molecule, int copies) {
  int side = 1;
  while (side * side * side < copies) ++side;
  Molecule all;
  for (int copy = 0; copy < copies; ++copy) {
    const Vec3 offset = kCopyDistance * Vec3(copy % side, copy / side % side, copy / (side * side));
    for (std::size_t i = 0; i < molecule.atom_count(); ++i) add_atom(all, molecule.centers[i] + offset, molecule.radii[i]);
  }
  return all;
}

BenchMesh make(int copies) {
  BenchMesh mesh;
  const Molecule molecule = copies == 0 ? helix() : copies_of(read_molecule(ache_monomer().path), copies);
  mesh.surface = gaussian_surface(molecule, ache_monomer().surface);
  mesh.prepared = mesh.surface;
  prepare(mesh.prepared, CavityPolicy::delete_cavities);
  remove_redundant_points(mesh.prepared, {});
  return mesh;
}

std::optional<std::pair<int, BenchMesh>>& kept() {
  static std::optional<std::pair<int, BenchMesh>> mesh;
  return mesh;
}

}  // namespace

const BenchMesh& bench_mesh(int copies) {
  if (!kept() || kept()->first != copies) {
    forget_bench_mesh();
    kept().emplace(copies, make(copies));
  }
  return kept()->second;
}

void forget_bench_mesh() {
  kept().reset();
  malloc_trim(0);
}

}  // namespace smopt::bench
