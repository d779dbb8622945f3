#pragma once

#include <cstddef>

namespace smopt {

/// Moves of one round or of all.
struct MoveCounts {
  std::size_t accepted = 0;   ///< moves made, the shortened ones included
  std::size_t shortened = 0;  ///< of these, made with a halved step
  std::size_t refused = 0;    ///< not made, whatever the step

  MoveCounts& operator+=(const MoveCounts& other) {
    accepted += other.accepted;
    shortened += other.shortened;
    refused += other.refused;
    return *this;
  }
};

/// One sweep over some vertices.
struct RoundReport {
  std::size_t active = 0;  ///< vertices visited
  MoveCounts moves;
  std::size_t stuck = 0;    ///< of the active, passed over: refused before, and no vertex of their ring has moved since
  double longest_move = 0;  ///< Å
};

}  // namespace smopt
