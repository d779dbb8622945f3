#pragma once

#include <functional>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::baselines {

/// Runs `call` into CGAL: what CGAL would print about a violated condition is not printed, and its exception becomes MethodFailed with the
/// condition in it. CGAL has one handler for the whole process: not for two calls at once.
void call_cgal(const std::function<void()>& call);

/// \throws MethodFailed that names the first vertex whose coordinates are not finite.
void require_finite_result(const TriangleMesh& mesh);

}  // namespace smopt::baselines
