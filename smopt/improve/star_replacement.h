#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "smopt/improve/redundant_points.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// The triangles that would take a vertex's place: the ring's triangle, or the two along a diagonal of the ring, the first being (one end
/// of the diagonal, a side, the other end).
struct StarReplacement {
  std::array<Triangle, 2> triangles{};
  std::size_t count = 0;

  [[nodiscard]] std::span<const Triangle> all() const { return {triangles.data(), count}; }
};

/// None, one or two.
struct StarReplacements {
  std::array<StarReplacement, 2> replacements{};
  std::size_t count = 0;

  [[nodiscard]] std::span<const StarReplacement> all() const { return {replacements.data(), count}; }
};

/// The replacements of a vertex of valence 3 or 4 that are within the tolerance, the nearest first. It is redundant when there is one.
/// \param ring  the vertices around v in order
StarReplacements replacements_within_tolerance(const TriangleMesh& mesh, VertexId v, std::span<const VertexId> ring,
                                               const RedundantPointOptions& options);

/// Whether the new triangles are degenerate or meet each other elsewhere than in the diagonal. Decided exactly.
bool is_degenerate(const TriangleMesh& mesh, const StarReplacement& replacement);

/// Whether triangle f meets the tetrahedra between v and its replacement elsewhere than in what it shares with them. Decided exactly.
/// \pre f is not of the star of v.
bool meets_replacement(const TriangleMesh& mesh, FaceId f, VertexId v, const StarReplacement& replacement);

}  // namespace smopt
