#pragma once

#include <functional>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::baselines {

/// A mesh made with an edge length, to have a number of vertices.
struct VertexSearchResult {
  TriangleMesh mesh;       ///< of all that were made, the one whose number of vertices is nearest
  double edge_length = 0;  ///< Å, that it was made with
  int runs = 0;
  bool is_near = false;  ///< within kVertexTolerance of the target
};

/// Part of the target by which the number of vertices may be off: what a table would call the same number.
inline constexpr double kVertexTolerance = 0.01;
/// No more meshes than this are made: the secant rule takes two to four.
inline constexpr int kMostRuns = 6;

/// Looks for the edge length with which `remesh` gives `target` vertices: the secant rule on the logarithms of both, as their number goes
/// about with the inverse square of the length. Begins with `first_length` > 0 (Å).
VertexSearchResult search_vertex_count(std::size_t target, double first_length,
                                       const std::function<TriangleMesh(double edge_length)>& remesh);

}  // namespace smopt::baselines
