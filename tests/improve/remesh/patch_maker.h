#pragma once

#include <optional>

#include "smopt/improve/remesh/operation.h"
#include "smopt/improve/remesh/patch_guard.h"
#include "smopt/improve/remesh/remesh_state.h"
#include "tests/improve/guarantee/random.h"

namespace smopt::testing {

/// A surface on which single operations are tried, judged and made.
class PatchMaker {
 public:
  explicit PatchMaker(const TriangleMesh& mesh);
  PatchMaker(const PatchMaker&) = delete;
  PatchMaker& operator=(const PatchMaker&) = delete;

  [[nodiscard]] const EditableSurface& surface() const { return state_.surface; }
  [[nodiscard]] RemeshState& state() { return state_; }
  [[nodiscard]] const Patch& patch() const { return patch_; }

  /// Describes an operation on the edge from v to w; false where it is none. Read it by `patch`.
  bool propose(OperationKind kind, VertexId v, VertexId w);
  /// The same for an edge and a kind drawn at random.
  bool propose_any(Random& random);
  /// Whether the guard lets what was described last pass.
  bool is_ok() { return guard_.is_ok(patch_); }
  /// Makes what was described last.
  void make();
  /// Proposes and makes an operation if it is possible, fits and is allowed.
  bool try_any(Random& random);

  /// The triangles in use, with all points.
  [[nodiscard]] TriangleMesh mesh() const;
  /// What `mesh` would be after what was described last.
  [[nodiscard]] TriangleMesh mesh_after() const;

 private:
  RemeshOptions options_;
  RemeshState state_;
  Patch patch_;
  PatchGuard guard_;
};

}  // namespace smopt::testing
