#pragma once

#include <gmock/gmock.h>

#include <string>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::testing {

/// Empty when every edge has exactly two triangles in opposite directions and every vertex's triangles form one fan; otherwise what is
/// wrong. Written without the library's own validity check, so that it can judge it.
std::string why_not_closed_manifold(const TriangleMesh& mesh);

MATCHER(IsClosedManifold, negation ? "is not a closed, oriented manifold" : "is a closed, oriented manifold") {
  const std::string why = why_not_closed_manifold(arg);
  *result_listener << why;
  return why.empty();
}

/// V − E + F, isolated vertices not counted.
int euler_characteristic(const TriangleMesh& mesh);

/// Enclosed volume by the divergence theorem, positive for outward orientation; area as the sum of the triangles'.
double enclosed_volume(const TriangleMesh& mesh);
double surface_area(const TriangleMesh& mesh);

}  // namespace smopt::testing
