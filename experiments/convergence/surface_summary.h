#pragma once

#include <cstddef>
#include <cstdint>

#include "metrics/histogram.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/surface/gaussian_field.h"
#include "smopt/surface/level_set_distance.h"

namespace smopt::experiments {

/// What a closed surface comes to.
struct Size {
  std::size_t vertices = 0;
  std::int64_t euler_characteristic = 0;
  double area = 0;    ///< Å²
  double volume = 0;  ///< Å³; that of cavities is subtracted
};

/// A generated surface in a row of the study.
struct SurfaceSummary {
  Size all;   ///< with every component
  Size main;  ///< the outer component of the largest volume
  std::size_t components = 0;
  std::size_t cavities = 0;
  std::size_t specks = 0;  ///< components of `kSpeckVertices` or fewer
  metrics::Histogram edge_ratio;
};

/// \pre mesh is a closed, oriented manifold. Cost: O(n).
SurfaceSummary summarise(const TriangleMesh& mesh);

/// How near a surface is to φ = c, and how much of φ = c is bent too sharply for that to fix its topology.
struct Nearness {
  LevelSetDistance distance;  ///< of the vertices
  double sharp_share = 0;     ///< share of the vertices at which φ = c is bent by a radius of `sharp_below` or less
};

/// \param sharp_below  ångström. Cost: that of `distance_to_level_set`.
Nearness nearness_of(const TriangleMesh& mesh, const GaussianField& field, double isovalue, double sharp_below);

}  // namespace smopt::experiments
