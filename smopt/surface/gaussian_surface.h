#pragma once

#include <cstddef>
#include <cstdint>

#include "smopt/io/molecule.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"
#include "smopt/surface/adaptive_surface.h"
#include "smopt/surface/gaussian_field.h"

namespace smopt {

/// Which Gaussian surface, and how finely it is sampled.
struct GaussianSurfaceOptions {
  double decay = 0.6;      ///< d of the kernel exp(-d(|x - x_i|² - r_i²)), 1/Å²; a larger decay shows more detail; > 0
  double isovalue = 1.0;   ///< c of the level set φ = c; > 0
  double spacing = 0.745;  ///< edge of the grid's cubes, Å; > 0. 0.745 Å gives the AChE monomer about 68 000 vertices (the paper: 67 955)
  /// 0: the uniform grid of that spacing. Else cubes are divided until the surface lies within this distance of φ = c, Å; > 0.
  double error = 0;
  /// Memory that making the mesh may take, bytes; 0: as much as the machine has. It is estimated before the field is sampled, to a few parts
  /// in ten; that takes a tenth of the time when a bound from the atoms alone is above the limit. The molecule, and writing the mesh, are not
  /// part of it.
  std::uint64_t max_memory_bytes = 0;
};

/// What the generator met on its way.
struct GaussianSurfaceReport {
  std::size_t atoms = 0;
  std::size_t grid_nodes = 0;         ///< at which the field was sampled; 0 where cubes were divided
  std::size_t surface_cells = 0;      ///< cells the surface crosses
  std::size_t ambiguous_cells = 0;    ///< cells with an ambiguous face or more than one loop
  std::size_t tunnel_cells = 0;       ///< cells in which two loops are the ends of one tunnel
  std::size_t interior_vertices = 0;  ///< vertices inside cells, where no other triangulation is free of intersections
  AdaptiveSurfaceReport adaptive;     ///< more, where cubes were divided
};

/// The field whose level set `gaussian_surface` meshes with these options.
GaussianFieldOptions gaussian_field_options(const GaussianSurfaceOptions& options);

/// Meshes the Gaussian surface φ = c of a molecule.
///
/// φ(x) = Σ exp(-d(|x - x_i|² - r_i²)) (Liu et al. 2017, equations 1 and 2), sampled at the corners of cubes: of a uniform grid
/// (`uniform_surface`), or of cubes that are divided where the surface asks for it (`partition_space`). The mesh has one vertex on each edge of a
/// cube that the surface crosses, at the zero of the linear interpolant along the edge, and is closed, edge- and vertex-manifold, oriented
/// outwards (towards smaller φ), free of intersections, and topologically that of the continuous piecewise trilinear interpolant. A few cells get
/// a vertex inside as well.
/// \throws InvalidInput for a molecule without atoms, a negative or non-finite radius or coordinate, an isovalue that the field never reaches
/// or reaches only between the samples, more memory than the limit, or more vertices than 32-bit indices can number.
/// \throws InvalidOption for an option out of its range.
/// Cost: linear in the atoms and the cells near the surface. All cores, same result for any number of them.
TriangleMesh gaussian_surface(const Molecule& molecule, const GaussianSurfaceOptions& options, GaussianSurfaceReport* report = nullptr,
                              const ProgressCallback& progress = {});

}  // namespace smopt
