#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// One kind of fault: how often, and the first places in words.
struct Fault {
  std::size_t count = 0;
  std::vector<std::string> examples;  ///< at most kMaxFaultExamples

  [[nodiscard]] bool any() const { return count > 0; }
};

/// Faults are shown with this many places each: enough to find a pattern, few enough to read.
inline constexpr std::size_t kMaxFaultExamples = 3;

/// What keeps a mesh from being a closed, consistently oriented, edge- and vertex-manifold surface of finite coordinates.
struct ValidityReport {
  Fault nonfinite_vertices;           ///< NaN or infinite coordinate
  Fault repeated_corners;             ///< triangles with the same vertex twice
  Fault boundary_edges;               ///< edges with one triangle: the surface is open
  Fault nonmanifold_edges;            ///< edges with more than two triangles
  Fault inconsistent_edges;           ///< edges whose two triangles disagree in orientation (can be mended)
  Fault nonmanifold_vertices;         ///< vertices whose triangles form more than one fan
  Fault duplicate_faces;              ///< triangles on the same three vertices as an earlier one
  std::size_t isolated_vertices = 0;  ///< vertices without a triangle (harmless)
  bool is_empty = false;              ///< no triangle at all

  /// Closed, manifold and finite; orientation may be inconsistent.
  [[nodiscard]] bool is_closed_manifold() const;
  [[nodiscard]] bool is_oriented() const { return !inconsistent_edges.any(); }
  /// Every fault with its places, separated by "; "; empty when there is none.
  [[nodiscard]] std::string describe() const;
};

/// Cost: O(n) for a valid mesh; O(n log n) when something is wrong and must be found.
ValidityReport check_validity(const TriangleMesh& mesh);

/// \throws InvalidMesh with `describe()` unless the mesh is a closed manifold of finite coordinates.
void require_closed_manifold(const ValidityReport& report);

}  // namespace smopt
