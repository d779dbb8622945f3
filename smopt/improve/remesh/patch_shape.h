#pragma once

#include "smopt/improve/remesh/patch.h"
#include "smopt/improve/remesh/remesh_state.h"

namespace smopt {

/// The worst quality of a patch before and after.
struct PatchShape {
  double before = 0;
  double after = 0;

  [[nodiscard]] double gain() const { return after - before; }
  /// Whether what missed a goal reaches it, or gains at least so much.
  [[nodiscard]] bool is_repaired_by(double smallest_gain) const { return before < 1 && (gain() > smallest_gain || after >= 1); }
};

/// Of its triangles. Cost: O(size of the patch).
PatchShape triangle_shape(const RemeshState& state, const Patch& patch);

/// Whether the surface bends nowhere in the new patch by more than 60°, or by no more than in the old one.
bool keeps_bends(const RemeshState& state, const Patch& patch);

/// The worst quality of the triangles around v, were it at x.
double star_quality_at(const RemeshState& state, VertexId v, const Vec3& x);

/// The worst quality of the edges of the star of v, those of its outline included, were it at x.
double star_bend_at(const RemeshState& state, VertexId v, const Vec3& x);

}  // namespace smopt
