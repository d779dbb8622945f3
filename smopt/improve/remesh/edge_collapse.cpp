#include "smopt/improve/remesh/edge_collapse.h"

#include <algorithm>

#include "smopt/improve/remesh/patch_shape.h"

namespace smopt {
namespace {

constexpr std::uint32_t kMinValence = 3;
/// Edges are too short below this part of their size (Botsch and Kobbelt: 4/5; less saves collapses and the splits that they would cost).
constexpr double kTooShort = 0.7;
/// No edge may come to be longer than this, in parts of its size: it would be split again.
constexpr double kTooLong = 1.5, kTooLongInRepairs = 1.7;
constexpr int kLargestExcess = 2, kSmallestExcess = -2;
/// A collapse may make triangles worse down to this.
constexpr double kMendableQuality = 0.5;
/// Repairs: see `edge_flip.cpp`; a collapse takes detail away, so it must gain more than a flip.
constexpr double kSmallestRepair = 0.05, kCost = 0.03, kLastResort = 1e-3;
/// A vertex of this valence or less goes even where no angle gains, as long as none gets worse than this.
constexpr std::size_t kUnwantedValence = 4;
constexpr double kNearlyGood = 0.6, kUnwantedVertexWorth = 0.1;

/// \param ring  of u, beginning at v.
bool keeps_manifold(const EditableSurface& surface, std::span<const VertexId> ring) {
  const VertexId v = ring.front();
  const std::size_t n = ring.size();
  if (surface.valence(ring[1]) <= kMinValence || surface.valence(ring[n - 1]) <= kMinValence) return false;
  if (surface.valence(v) + n < kMinValence + 4) return false;
  return std::ranges::none_of(ring.subspan(2, n - 3), [&](VertexId w) { return surface.are_neighbours(v, w); });
}

bool propose(RemeshState& state, VertexId u, std::size_t slot, Patch& patch) {
  const EditableSurface& surface = state.surface;
  const std::span<const VertexId> ring = surface.rings().vertices(u);
  const std::span<const FaceId> faces = surface.rings().faces(u);
  const std::size_t n = ring.size();
  patch.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = slot + i < n ? slot + i : slot + i - n;
    patch.boundary.push_back(ring[k]);
    patch.old_faces.push_back(faces[k]);
  }
  if (!keeps_manifold(surface, patch.boundary)) return false;
  const std::vector<VertexId>& r = patch.boundary;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Triangle t{r[0], r[i], r[i + 1]};
    patch.new_triangles.push_back(t);
    patch.new_faces.push_back(patch.old_faces[i]);
    patch.swept.push_back({t, u});
    if (i > 1) patch.walls.push_back({r[0], r[i], u});
  }
  patch.removed = u;
  patch.center = surface.point(u);
  patch.target = surface.point(r[0]);
  return true;
}

bool keeps_edges_short(const RemeshState& state, const Patch& patch, double too_long) {
  const std::span<const VertexId> ring = patch.boundary;
  return std::ranges::all_of(ring.subspan(2, ring.size() - 3),
                             [&](VertexId w) { return state.relative_length(ring.front(), w) < too_long; });
}

int excess_after(const RemeshState& state, const Patch& patch) {
  return state.excess(patch.boundary[0]) + static_cast<int>(patch.boundary.size()) - 4;
}

double gain_for_density(const RemeshState& state, const Patch& patch) {
  const double length = state.relative_length(patch.removed, patch.boundary[0]);
  if (length >= kTooShort || excess_after(state, patch) > kLargestExcess || !keeps_edges_short(state, patch, kTooLong)) return 0;
  const PatchShape shape = triangle_shape(state, patch);
  return shape.after >= std::min(shape.before, kMendableQuality) ? kTooShort - length : 0;
}

double gain_for_goals(const RemeshState& state, const Patch& patch) {
  const int excess = excess_after(state, patch);
  if (excess > kLargestExcess || excess < kSmallestExcess || !keeps_edges_short(state, patch, kTooLongInRepairs)) return 0;
  const PatchShape shape = triangle_shape(state, patch);
  if (shape.is_repaired_by(kSmallestRepair)) return std::max(shape.gain() - kCost, kLastResort);
  const bool is_unwanted = patch.boundary.size() <= kUnwantedValence;
  return is_unwanted && shape.after >= std::min(shape.before, kNearlyGood) ? kUnwantedVertexWorth : 0;
}

double gain(const RemeshState& state, const Patch& patch, Purpose purpose) {
  return purpose == Purpose::density ? gain_for_density(state, patch) : gain_for_goals(state, patch);
}

bool is_too_short(const RemeshState& state, VertexId v, std::size_t slot) {
  return state.relative_length(v, state.surface.rings().vertices(v)[slot]) < kTooShort;
}

}  // namespace

const Operation kEdgeCollapse{propose, gain, is_too_short, &RemeshReport::collapses, "collapses"};

}  // namespace smopt
