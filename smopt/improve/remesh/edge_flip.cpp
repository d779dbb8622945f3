#include "smopt/improve/remesh/edge_flip.h"

#include "smopt/improve/remesh/patch_shape.h"

namespace smopt {
namespace {

/// A flip for the sake of valences may make triangles worse down to this; relaxation mends more than that.
constexpr double kMendableQuality = 0.6;
/// The same when all is about to be done.
constexpr double kNearlyGood = 0.8;
/// Angles must gain so much for a flip that leaves the valences' sum of squares as it is …
constexpr double kClearGain = 0.1;
/// … and so much for one that adds up to this many to it, at a triangle that is not even nearly good.
constexpr double kLargeGain = 0.3;
constexpr int kTolerableExcess = 2;
/// Repairs go on for gains above this.
constexpr double kSmallestRepair = 0.02;
/// What one less in the valences' sum of squares is worth beside a goal.
constexpr double kValenceWorth = 0.02;

bool propose(RemeshState& state, VertexId a, std::size_t slot, Patch& patch) {
  const EditableSurface& surface = state.surface;
  const auto [b, c, d, left_face, right_face] = surface.edge_at(a, slot);
  if (surface.valence(a) <= 3 || surface.valence(b) <= 3 || surface.are_neighbours(c, d)) return false;
  patch.clear();
  patch.boundary.assign({c, a, d, b});
  patch.old_faces.assign({left_face, right_face});
  patch.new_triangles.assign({Triangle{c, a, d}, Triangle{d, b, c}});
  patch.new_faces = patch.old_faces;
  patch.swept.push_back({{c, a, d}, b});
  patch.center = 0.5 * (surface.point(a) + surface.point(b));
  patch.target = surface.point(c);
  return true;
}

/// By how much the sum of the squares of the excess valences falls when the edge ab gives way to cd.
int valence_gain(const RemeshState& state, VertexId a, VertexId b, VertexId c, VertexId d) {
  const auto growing = [&](VertexId v) { return -2 * state.excess(v) - 1; };
  const auto shrinking = [&](VertexId v) { return 2 * state.excess(v) - 1; };
  return shrinking(a) + shrinking(b) + growing(c) + growing(d);
}

int valence_gain(const RemeshState& state, const Patch& patch) {
  return valence_gain(state, patch.boundary[1], patch.boundary[3], patch.boundary[0], patch.boundary[2]);
}

bool may_be_wanted(const RemeshState& state, VertexId a, std::size_t slot) {
  const EditableSurface::Edge edge = state.surface.edge_at(a, slot);
  return a < edge.to && valence_gain(state, a, edge.to, edge.left, edge.right) >= -kTolerableExcess;
}

double gain_for_density(const RemeshState& state, const Patch& patch) {
  const int valences = valence_gain(state, patch);
  const PatchShape shape = triangle_shape(state, patch);
  const bool is_wanted = (valences > 0 && shape.after > std::min(shape.before, kMendableQuality)) ||
                         (valences == 0 && shape.gain() > kClearGain) || (shape.before < kNearlyGood && shape.gain() > kLargeGain);
  return is_wanted ? 1 + kTolerableExcess + valences + shape.gain() : 0;
}

double gain_for_goals(const RemeshState& state, const Patch& patch) {
  const int valences = valence_gain(state, patch);
  const PatchShape shape = triangle_shape(state, patch);
  if (shape.is_repaired_by(kSmallestRepair)) return shape.gain() + kValenceWorth * valences;
  return valences > 0 && shape.after >= std::min(shape.before, kNearlyGood) ? kValenceWorth * valences : 0;
}

double gain(const RemeshState& state, const Patch& patch, Purpose purpose) {
  return purpose == Purpose::density ? gain_for_density(state, patch) : gain_for_goals(state, patch);
}

}  // namespace

const Operation kEdgeFlip{propose, gain, may_be_wanted, &RemeshReport::flips, "flips"};

}  // namespace smopt
