#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "metrics/solvation/solvate.h"

namespace smopt::experiments {

/// Told what was just done, in a few words.
using StudyLog = std::function<void(const std::string&)>;

/// One solve of the study: what became of it.
struct Solve {
  std::size_t vertices = 0;
  std::optional<metrics::Solvation> result;  ///< without the numbers at the vertices
  std::string failure;                       ///< why there is no result

  [[nodiscard]] bool is_success() const { return result && result->status == metrics::SolvationStatus::success; }
};

/// Solves with the options' defaults. A throw is a failure with its reason.
Solve solve(const TriangleMesh& surface, const Molecule& molecule, const metrics::SolvationOptions& options = {});

/// "success", "not_converged: …", "failed: …".
std::string describe(const Solve& solve);

}  // namespace smopt::experiments
