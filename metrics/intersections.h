#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::metrics {

struct IntersectionOptions {
  std::size_t list_limit = std::numeric_limits<std::size_t>::max();  ///< how many of the pairs are listed; all are counted
  /// Where there are more the search ends without a number. A mesh that an unstable method has blown up has billions, as every triangle
  /// meets every other; ten million take some twenty seconds and 200 MB.
  std::size_t count_limit = 10'000'000;
};

struct Intersections {
  std::optional<std::size_t> count;              ///< intersecting pairs; empty where a corner is not finite, or beyond `count_limit`
  std::string why_not_counted;                   ///< "a triangle has a corner that is not finite"; empty where they were
  std::vector<std::pair<FaceId, FaceId>> pairs;  ///< the first `list_limit` of them: smaller id first, sorted
};

/// Counts the pairs of triangles that meet elsewhere than in a vertex or an edge they share.
///
/// A vertex is shared when both triangles name the same index; equal coordinates do not make it so. An unordered pair counts once; two
/// faces on the same three vertices are one pair; a degenerate face (corners exactly collinear) belongs to no pair. Touching counts.
/// Candidates come from CGAL's box intersection, the answer from CGAL's exact predicates; nothing of smopt/improve or smopt/geometry is
/// used, so that this can judge them. Works on any soup. The result does not depend on the number of threads. Cost: O(n log³ n +
/// candidates); on all cores of the current TBB arena.
Intersections find_intersections(const TriangleMesh& mesh, const IntersectionOptions& options = {});

}  // namespace smopt::metrics
