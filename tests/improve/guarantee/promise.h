#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "smopt/improve/improve.h"
#include "smopt/mesh/triangle_mesh.h"

/// What `improve` promises, told without its predicates and without its notion of components and cavities.
namespace smopt::testing {

/// One component: Euler characteristic, sign of the enclosed volume, how many other components it lies in.
using Shell = std::tuple<int, int, int>;

/// The shells of a closed mesh, sorted. Nesting by winding number: \pre no two components intersect.
std::vector<Shell> shells(const TriangleMesh& mesh);

/// The mesh without what the policy removes; triangles and vertices keep their order.
TriangleMesh without_removed_components(const TriangleMesh& mesh, CavityPolicy policy);

/// Improves a copy of the mesh, which has no intersecting pairs, and expects: a closed manifold without pairs, no new degenerate triangle,
/// the same shells but for those removed, and the same triangles unless redundant points were removed.
void expect_promise_kept(const TriangleMesh& before, const ImproveOptions& options);

/// Improves a copy of a mesh that may have intersecting pairs and degenerate triangles: none is added, no component changes its topology.
void expect_no_new_fault(const TriangleMesh& before, const ImproveOptions& options);

/// Expects the same bytes from one and from two threads.
void expect_same_bytes_for_one_and_two_threads(const TriangleMesh& before, const ImproveOptions& options);

/// One of the combinations of options that tests cycle through: each step rule, cavities kept or deleted, angles kept or not, redundant
/// points kept or deleted with either tolerance, screening as by default or so that nearly all vertices stay active.
ImproveOptions combination(std::size_t index);
std::string describe(const ImproveOptions& options);

}  // namespace smopt::testing
