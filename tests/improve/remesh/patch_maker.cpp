#include "tests/improve/remesh/patch_maker.h"

#include <algorithm>
#include <array>
#include <set>

#include "smopt/improve/remesh/edge_collapse.h"
#include "smopt/improve/remesh/edge_flip.h"
#include "smopt/improve/remesh/edge_split.h"

namespace smopt::testing {

PatchMaker::PatchMaker(const TriangleMesh& mesh) : state_(mesh, options_), guard_(state_.surface) {
  state_.grow();
  guard_.enter(nullptr);
}

bool PatchMaker::propose(OperationKind kind, VertexId v, VertexId w) {
  constexpr std::array<const Operation*, kOperationKinds> kOperations = {&kEdgeFlip, &kEdgeCollapse, &kEdgeSplit};
  if (kind == kSplit) {
    state_.spare.take(state_.surface, {v});
    state_.grow();
  }
  patch_.clear();
  return kOperations[kind]->propose(state_, v, state_.surface.slot_of(v, w), patch_);
}

bool PatchMaker::propose_any(Random& random) {
  VertexId v = 0;
  do v = static_cast<VertexId>(random.integer(0, static_cast<int>(surface().mesh().vertex_count()) - 1));
  while (!surface().is_in_use(v));
  const auto ring = surface().rings().vertices(v);
  const VertexId w = ring[static_cast<std::size_t>(random.integer(0, static_cast<int>(ring.size()) - 1))];
  return propose(static_cast<OperationKind>(random.integer(0, kOperationKinds - 1)), v, w);
}

void PatchMaker::make() {
  state_.surface.replace(patch_);
}

bool PatchMaker::try_any(Random& random) {
  if (!propose_any(random) || !surface().has_room_for(patch_) || !is_ok()) return false;
  make();
  return true;
}

TriangleMesh PatchMaker::mesh() const {
  std::set<FaceId> used;
  const VertexRings& rings = surface().rings();
  for (VertexId v = 0; v < rings.vertex_count(); ++v) used.insert(rings.faces(v).begin(), rings.faces(v).end());
  TriangleMesh result{surface().mesh().points, {}};
  for (const FaceId f : used) result.triangles.push_back(surface().mesh().triangles[f]);
  return result;
}

TriangleMesh PatchMaker::mesh_after() const {
  TriangleMesh result = mesh();
  std::set<Triangle> old;
  for (const FaceId f : patch_.old_faces) old.insert(surface().mesh().triangles[f]);
  std::erase_if(result.triangles, [&](const Triangle& t) { return old.count(t) > 0; });
  result.triangles.insert(result.triangles.end(), patch_.new_triangles.begin(), patch_.new_triangles.end());
  return result;
}

}  // namespace smopt::testing
