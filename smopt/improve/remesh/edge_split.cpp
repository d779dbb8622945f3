#include "smopt/improve/remesh/edge_split.h"

#include <algorithm>

#include "smopt/improve/remesh/patch_shape.h"

namespace smopt {
namespace {

/// Edges are too long above this part of their size (Botsch and Kobbelt: 4/3; more saves a third of the splits, each of which costs a collapse, and
/// the angles are as good).
constexpr double kTooLong = 1.5;
/// Repairs split no edge shorter than this, lest the mesh becomes finer and finer around what nothing mends …
constexpr double kLongEnough = 0.9;
/// … and only for a gain above this, as a split costs vertices.
constexpr double kSmallestRepair = 0.05, kCost = 0.04, kLastResort = 1e-3;

bool propose(RemeshState& state, VertexId a, std::size_t slot, Patch& patch) {
  EditableSurface& surface = state.surface;
  const auto [b, c, d, left_face, right_face] = surface.edge_at(a, slot);
  const VertexId m = state.spare.vertex(a);
  const auto [spare0, spare1] = state.spare.faces(a);
  if (surface.is_in_use(m)) return false;  // one split a visit
  surface.place(m, 0.5 * (surface.point(a) + surface.point(b)));
  state.sizes[m] = 0.5 * (state.sizes[a] + state.sizes[b]);
  patch.clear();
  patch.boundary.assign({c, a, d, b});
  patch.old_faces.assign({left_face, right_face});
  patch.new_triangles.assign({Triangle{m, c, a}, Triangle{m, a, d}, Triangle{m, d, b}, Triangle{m, b, c}});
  patch.new_faces.assign({left_face, right_face, spare0, spare1});
  patch.swept.assign({{{a, b, c}, m}, {{a, d, b}, m}});
  patch.walls.push_back({a, b, m});
  patch.added = m;
  patch.center = surface.point(m);
  patch.target = surface.point(m);
  return true;
}

double gain(const RemeshState& state, const Patch& patch, Purpose purpose) {
  const double length = state.relative_length(patch.boundary[1], patch.boundary[3]);
  if (purpose == Purpose::density) return length - kTooLong;
  if (length < kLongEnough) return 0;
  const PatchShape shape = triangle_shape(state, patch);
  return shape.is_repaired_by(kSmallestRepair) ? std::max(shape.gain() - kCost, kLastResort) : 0;
}

bool is_too_long(const RemeshState& state, VertexId v, std::size_t slot) {
  const VertexId w = state.surface.rings().vertices(v)[slot];
  return v < w && state.relative_length(v, w) > kTooLong;
}

}  // namespace

const Operation kEdgeSplit{propose, gain, is_too_long, &RemeshReport::splits, "splits"};

}  // namespace smopt
