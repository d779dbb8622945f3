#pragma once

#include <array>
#include <cstdint>

#include "smopt/geometry/vec3.h"

/// Exact decisions on closed segments and triangles: contact counts as meeting. Degenerate (collinear) triangles are treated as the
/// segments they are. Cost: a few orient3d each.
namespace smopt {

using TrianglePoints = std::array<Vec3, 3>;

/// The triangle turned so that corner `first` comes first.
TrianglePoints starting_at(const TrianglePoints& t, int first);

/// Whether two closed segments have a point in common.
bool segments_meet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Whether a closed segment and a closed triangle have a point in common.
bool segment_meets_triangle(const Vec3& a, const Vec3& b, const TrianglePoints& t);

/// Whether two closed triangles without a shared corner have a point in common.
bool triangles_meet(const TrianglePoints& p, const TrianglePoints& q);

/// Whether two triangles with the shared corner p[0] = q[0] meet elsewhere than there.
bool triangles_meet_beyond_vertex(const TrianglePoints& p, const TrianglePoints& q);

/// Whether two triangles with the shared edge p[0]p[1] = q[0]q[1] meet elsewhere than there: folded onto each other in one plane.
bool triangles_meet_beyond_edge(const TrianglePoints& p, const TrianglePoints& q);

/// Whether two triangles meet elsewhere than in the corners and the edge that they share by index; two triangles on the same three vertices
/// do.
bool triangles_meet_beyond_shared(const TrianglePoints& p, const std::array<std::uint32_t, 3>& p_ids, const TrianglePoints& q,
                                  const std::array<std::uint32_t, 3>& q_ids);

/// Whether the point lies strictly inside the tetrahedron abcd (of either orientation).
bool strictly_inside_tetrahedron(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace smopt
