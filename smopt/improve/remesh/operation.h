#pragma once

#include <cstddef>
#include <cstdint>

#include "smopt/improve/remesh/patch.h"
#include "smopt/improve/remesh/remesh_state.h"

namespace smopt {

/// What an operation is wanted for.
enum class Purpose {
  density,  ///< edges of the wanted length, valences near 6
  goals     ///< what misses a goal gets better
};

/// An operation that replaces the triangles around an edge.
struct Operation {
  /// Describes it for the edge from v to its ring vertex `slot`; false where it would leave no manifold of the same topology.
  bool (*propose)(RemeshState& state, VertexId v, std::size_t slot, Patch& patch);
  /// How much is gained by what was described last; 0 or less: it is not wanted.
  double (*gain)(const RemeshState& state, const Patch& patch, Purpose purpose);
  /// Whether a visit to v for the sake of density may find anything; quick.
  bool (*is_worth_a_visit)(const RemeshState& state, VertexId v);
  /// Where the report counts it.
  OperationCounts RemeshReport::*counts;
  const char* plural;  ///< its name in messages
};

// In the order in which equal gains are preferred.
enum OperationKind : std::uint8_t { kFlip, kCollapse, kSplit, kOperationKinds };

}  // namespace smopt
