#pragma once

#include <map>
#include <string>
#include <utility>

#include "smopt/improve/method.h"

namespace smopt::baselines {

/// What a method makes of a mesh.
struct MethodResult {
  TriangleMesh mesh;
  MethodReport report;
};

/// Runs an entry of the registry on a copy of the mesh.
inline MethodResult run_method(const Method& method, TriangleMesh mesh, const std::map<std::string, std::string>& options = {},
                               const ProgressCallback& progress = {}) {
  MethodResult result{std::move(mesh), {}};
  result.report = method.run(result.mesh, OptionValues(method.options, options), progress);
  return result;
}

}  // namespace smopt::baselines
