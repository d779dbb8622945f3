#pragma once

#include <string>
#include <string_view>
#include <vector>

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

}  // namespace smopt::experiments
