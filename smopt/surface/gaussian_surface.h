#pragma once

#include <cstddef>

#include "smopt/io/molecule.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt {

/// Which Gaussian surface, and how finely it is sampled.
struct GaussianSurfaceOptions {
  double decay = 0.6;      ///< d of the kernel exp(-d(|x - x_i|² - r_i²)), 1/Å²; a larger decay shows more detail; > 0
  double isovalue = 1.0;   ///< c of the level set φ = c; > 0
  double spacing = 0.745;  ///< edge of the grid's cubes, Å; > 0. 0.745 Å gives the AChE monomer about 68 000 vertices (the paper: 67 955)
};

/// What the generator met on its way.
struct GaussianSurfaceReport {
  std::size_t atoms = 0;
  std::size_t grid_nodes = 0;         ///< of the whole box
  std::size_t surface_cells = 0;      ///< cells the surface crosses
  std::size_t ambiguous_cells = 0;    ///< cells with an ambiguous face or more than one loop
  std::size_t tunnel_cells = 0;       ///< cells in which two loops are the ends of one tunnel
  std::size_t interior_vertices = 0;  ///< vertices inside cells, where no other triangulation is free of intersections
};

/// Meshes the Gaussian surface φ = c of a molecule on a uniform grid.
///
/// φ(x) = Σ exp(-d(|x - x_i|² - r_i²)) (Liu et al. 2017, equations 1 and 2), sampled at the nodes of a grid. The mesh has one vertex
/// on each grid edge that the surface crosses, at the zero of the linear interpolant along the edge, and is closed, edge- and
/// vertex-manifold, oriented outwards (towards smaller φ), free of intersections, and topologically that of the trilinear interpolant
/// in every cell. A few ambiguous cells get a vertex inside as well (see `trilinear_surface`).
/// \throws InvalidInput for a molecule without atoms, a negative or non-finite radius or coordinate, or an isovalue that the field
/// never reaches.
/// \throws InvalidOption for an option out of its range.
/// Cost: O(atoms × kernel support + grid nodes).
TriangleMesh gaussian_surface(const Molecule& molecule, const GaussianSurfaceOptions& options, GaussianSurfaceReport* report = nullptr,
                              const ProgressCallback& progress = {});

}  // namespace smopt
