#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::experiments {

/// Which ready meshes count as clean, smooth and closed.
struct MeshChoiceRule {
  std::size_t least_vertices = 2000;
  /// An edge is sharp where the normals of its two triangles turn by more than this, degrees. A smooth surface that is sampled well enough to
  /// be one turns less; the edges of a machine part, about 90°.
  double sharp_turn_deg = 60;
  /// Of the edges that may be sharp. In the archive of libcgal-demo the share is at most 0.6 % for the smooth models and at least 1.4 % for
  /// machine parts and for animals of so few triangles that each limb is a prism.
  double largest_sharp_share = 0.01;
};

/// Why a mesh is left.
struct MeshFault {
  std::string reason;  ///< "not smooth"; empty: it is taken
  std::string detail;  ///< "3.2 % of the edges are sharp"; may be empty
};

/// A ready mesh, taken or left.
struct MeshCandidate {
  std::string name;  ///< of its file, without the ending
  std::filesystem::path file;
  std::size_t vertices = 0;
  MeshFault fault;
  std::optional<TriangleMesh> mesh;  ///< where it is taken
};

/// Of the edges with two triangles, the share with a turn of more than `turn_deg` between the triangles' normals. Triangles without an area have
/// no normal, and their edges do not count. 0 where there is no edge. Cost: O(n log n).
double share_of_sharp_edges(const TriangleMesh& mesh, double turn_deg);

/// Measures a mesh against the rule: vertices, closed, manifold, oriented, no degenerate triangle, no two vertices at one place, no
/// intersecting pair, smooth. \return the first that it is not.
MeshFault fault_of(const TriangleMesh& mesh, const MeshChoiceRule& rule);

/// Reads every OFF file in a folder and the folders in it, by name, and holds it against the rule. What cannot be read is left, with the reader's
/// reason.
std::vector<MeshCandidate> choose_meshes(const std::filesystem::path& folder, const MeshChoiceRule& rule);

/// Reads every OFF file likewise, and takes whatever can be read.
std::vector<MeshCandidate> all_meshes(const std::filesystem::path& folder);

/// Unpacks the OFF files of an archive (.tar.gz) by `tar`. \throws InvalidInput with what tar said.
void unpack_meshes(const std::filesystem::path& archive, const std::filesystem::path& folder);

}  // namespace smopt::experiments
