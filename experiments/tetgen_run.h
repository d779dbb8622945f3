#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::experiments {

/// What TetGen is asked for, and how long it may take.
struct TetgenTrial {
  std::string switches;
  double time_limit_seconds = 0;
};

/// TetGen's radius–edge ratio 1.4 by its refinement of the surface as well: needles can keep it busy without end, so five minutes are all it
/// gets (65 000 good vertices take one).
inline constexpr const char* kQualitySwitches = "pq1.4";

/// `p` and `pY` of every case; tetrahedra of bounded shape, too, of smopt's mesh and smopt2's (initial meshes would take all of the time: that of
/// the AChE monomer has not ended after five minutes).
std::vector<TetgenTrial> tetgen_trials(std::string_view method);

/// A record's `tetgen`: by switches what `smopt tetrahedralize --json` prints, whatever becomes of it. Where `p` fails, nothing else that
/// refines its result is tried, and the reason says so. \throws Cancelled
nlohmann::ordered_json tetgen_of(const TriangleMesh& mesh, const std::vector<TetgenTrial>& trials, const ProgressCallback& progress);

}  // namespace smopt::experiments
