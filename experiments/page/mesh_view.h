#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "experiments/page/shown_part.h"

namespace smopt::experiments {

/// How many triangles of a mesh are shown at most; of a larger one, what lies around its worst place. A laptop's graphics draws as many, with
/// edges, twice, at a fluent rate, and they are 1.6 MB of the page: six methods of six molecules fit in.
inline constexpr std::size_t kShownTriangles = 150'000;
/// Triangles that are listed for each measure, and intersecting pairs: more than anybody visits one by one.
inline constexpr std::size_t kListedTriangles = 50;
inline constexpr std::size_t kListedPairs = 200;
/// Beyond so many the pairs are not listed: a mesh that was blown up has billions. As many are found in some two seconds.
inline constexpr std::size_t kSearchedPairs = 1'000'000;

/// A mesh as the page shows it.
struct MeshView {
  std::string positions;  ///< `pack_words` of the coordinates, single precision, relative to the ball's centre; x, y, z by vertex
  std::string indices;    ///< `pack_words` of the triangles' corners
  /// vertices, triangles (of the whole mesh); shown_vertices, shown_triangles, undrawable_triangles;
  /// worst: for each measure [[index among the shown, id in the mesh, value, rank], …];
  /// pairs: {count (of the shown part, null when there are too many), listed: [[index, index, id, id], …], why_not_counted}
  nlohmann::ordered_json facts;
};

/// What lies in the ball, with its worst triangles and its intersecting pairs.
/// \param has_pairs  false: it is known that there are no intersecting pairs, and none are looked for.
/// Cost: O(n log n) of the mesh; the search for pairs, of the shown part alone (a pair of it is one of the whole mesh, as the vertices are
/// shared alike).
MeshView mesh_view(const TriangleMesh& mesh, const Ball& ball, bool has_pairs);

/// The ball that all meshes of a molecule are shown in: around the middle of the first intersecting pair of the initial mesh, or, where there
/// is none, around its triangle with the smallest angle; infinite, around the middle of the bounding box, where the mesh has no more than
/// `shown` triangles.
Ball ball_to_show(const TriangleMesh& initial, std::size_t shown, bool has_pairs);

}  // namespace smopt::experiments
