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
  /// Whether it may be wanted there for the sake of density; quick. Where it is the same from both ends, from one of them only.
  bool (*may_be_wanted)(const RemeshState& state, VertexId v, std::size_t slot);
  /// Where the report counts it.
  OperationCounts RemeshReport::*counts;
  const char* plural;  ///< its name in messages
};

// In the order in which equal gains are preferred.
enum OperationKind : std::uint8_t { kFlip, kCollapse, kSplit, kOperationKinds };

}  // namespace smopt
