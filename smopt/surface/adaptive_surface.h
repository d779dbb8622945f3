#pragma once

#include <cstddef>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"
#include "smopt/surface/adaptive_partition.h"

namespace smopt {

/// What the mesher of an adaptive partition met on its way.
struct AdaptiveSurfaceReport {
  AdaptivePartitionReport divided;
  std::vector<std::size_t> surface_cells;  ///< cells the surface crosses, by level
  double finest_edge = 0;                  ///< of the smallest of these, ångström
  std::size_t hanging_cells = 0;           ///< of these: with smaller neighbours across a face
  std::size_t folded_cells = 0;            ///< of these: single-valued along no axis, and filled from a point inside
  std::size_t ambiguous_cells = 0;         ///< cells with an ambiguous face or more than one loop
  std::size_t tunnel_cells = 0;            ///< cells in which two loops are the ends of one tunnel
  std::size_t interior_vertices = 0;       ///< vertices inside cells
};

/// Meshes the level set of the continuous, piecewise trilinear interpolant of an adaptive partition.
///
/// One vertex on each edge of the partition that the surface crosses, at the zero of the linear interpolant; edges that smaller cells have in
/// two halves count as these. A cell without smaller neighbours is filled as `triangulate_cell` says. The others hold one disc each (see
/// `partition_space`): its polygon is filled by clipping ears where it is single-valued along an axis, and from a point inside where not.
/// The mesh is closed, edge- and vertex-manifold, oriented outwards, free of intersections, and topologically that of the interpolant.
/// Cost: O(cells the surface crosses). All cores, same result for any number of them.
TriangleMesh adaptive_surface(const AdaptivePartition& partition, AdaptiveSurfaceReport* report = nullptr,
                              const ProgressCallback& progress = {});

}  // namespace smopt
