#pragma once

#include <vector>

#include "smopt/mesh/rings.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt::baselines {

/// One Jacobi step of GAMer's angle-weighted smoothing (Yu, Holst, Cheng, McCammon, J. Mol. Graph. Model. 26:1370, 2008, section 2.2.2).
///
/// Each neighbour s of a vertex x, with the neighbours p and q before and after it in the ring, proposes the point where x would halve the
/// angle (p, s, q): its projection on the plane through s that holds the bisector and stands on the triangle p s q. The proposals are weighted
/// by cos(p, s, q) + 1. The displacement d to their mean is damped by the local structure tensor T = Σ n nᵀ, over the normals n of the
/// vertices in the `tensor_rings` rings around x (without x): the part along each eigenvector is divided by 1 + its eigenvalue, which is
/// (I + T)⁻¹ d. Along the normal of a flat region that leaves nearly nothing, across it everything; at an edge both normals are held.
/// As in GAMer 2, normals are weighted by area, and a normal without length is left out of T.
///
/// A neighbour at the same place as p or q proposes nothing (GAMer gives up there); a vertex without proposals stays.
/// \param rings  of `mesh`. \param next  of the size of mesh.points. Same bytes for any number of threads.
/// Cost: on the order of the vertices in the rings; a microsecond a vertex with two.
void angle_weighted_step(const TriangleMesh& mesh, const VertexRings& rings, int tensor_rings, std::vector<Vec3>& next);

}  // namespace smopt::baselines
