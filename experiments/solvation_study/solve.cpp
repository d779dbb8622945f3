#include "experiments/solvation_study/solve.h"

#include <fmt/format.h>

#include <exception>

namespace smopt::experiments {

Solve solve(const TriangleMesh& surface, const Molecule& molecule, const metrics::SolvationOptions& options) {
  Solve solve;
  solve.vertices = surface.vertex_count();
  try {
    solve.result = metrics::solvate(surface, molecule, options);
    solve.result->potential = {};
    solve.result->normal_derivative = {};
  } catch (const std::exception& error) {
    solve.failure = error.what();
  }
  return solve;
}

std::string describe(const Solve& solve) {
  if (!solve.result) return fmt::format("failed: {}", solve.failure);
  const std::string status = to_string(solve.result->status);
  return solve.result->reason.empty() ? status : fmt::format("{}: {}", status, solve.result->reason);
}

}  // namespace smopt::experiments
