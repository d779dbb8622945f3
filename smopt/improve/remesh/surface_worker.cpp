#include "smopt/improve/remesh/surface_worker.h"

#include <algorithm>
#include <tuple>

#include "smopt/improve/remesh/bounded_guard.h"
#include "smopt/improve/remesh/edge_collapse.h"
#include "smopt/improve/remesh/edge_flip.h"
#include "smopt/improve/remesh/edge_split.h"
#include "smopt/improve/remesh/patch_shape.h"
#include "smopt/improve/remesh/relaxation.h"

namespace smopt {
namespace {

/// A step is halved this often where the guard refuses it: what is then left of it is hardly worth the question.
constexpr int kHalvings = 4;
/// Relaxation leaves vertices where they are that would move by less than this part of an edge: no angle changes by more than some degrees.
constexpr double kLeastStepRel = 0.02;
/// Repairs move a vertex for a gain above this, and try steps of these parts.
constexpr double kSmallestRepair = 0.01;
constexpr std::array<double, 3> kStepParts = {1, 0.5, 0.25};

/// Moves are refused that leave an angle that misses the goal and is smaller than it was.
MoveRules move_rules(const RemeshGoals& goals) {
  MoveRules rules;
  rules.halvings = kHalvings;
  rules.keeps_angles = true;
  rules.min_angle_deg = goals.min_angle_deg;
  return rules;
}

}  // namespace

const Operation& operation(OperationKind kind) {
  static const std::array<const Operation*, kOperationKinds> kAll = {&kEdgeFlip, &kEdgeCollapse, &kEdgeSplit};
  return *kAll[kind];
}

bool is_enabled(const RemeshOptions& options, OperationKind kind) {
  return std::array<bool, kOperationKinds>{options.flips, options.collapses, options.splits}[kind];
}

bool may_be_wanted_around(const RemeshState& state, VertexId v, OperationKind kind) {
  for (std::size_t slot = 0; slot < state.surface.valence(v); ++slot)
    if (operation(kind).may_be_wanted(state, v, slot)) return true;
  return false;
}

SurfaceWorker::SurfaceWorker(RemeshState& state)
    : state_(state), guard_(state.surface), mover_(state.surface.guarded(), move_rules(state.options.goals), make_bounded_guard(state)) {}

void SurfaceWorker::enter(std::span<const VertexId> group, const TriangleGrid::CubeRange* region) {
  region_ = region;
  guard_.enter(region);
  mover_.enter(group, region);
}

/// Rings of vertices outside may be changed by others at this moment; those of the ring of v are looked at for nearly every question about v.
bool SurfaceWorker::is_star_within_region(VertexId v) const {
  if (region_ == nullptr) return true;
  const TriangleGrid& grid = state_.surface.guarded().grid;
  Box box = grid.box_of(state_.surface.point(v));
  for (const VertexId w : state_.surface.rings().vertices(v)) box.unite(grid.box_of(state_.surface.point(w)));
  return region_->contains(grid.reading(box));
}

Visit SurfaceWorker::change(VertexId v, OperationKind kind) {
  if (!is_star_within_region(v)) return Visit::postponed;
  candidates_.clear();
  add_candidates(v, kind, Purpose::density);
  return candidates_.empty() ? Visit::unmoved : make_best(v);
}

void SurfaceWorker::add_candidates(VertexId v, OperationKind kind, Purpose purpose) {
  if (!is_enabled(state_.options, kind)) return;
  for (std::size_t slot = 0; slot < state_.surface.valence(v); ++slot) {
    if (purpose == Purpose::density && !operation(kind).may_be_wanted(state_, v, slot)) continue;
    if (!operation(kind).propose(state_, v, slot, patch_)) continue;
    const double gain = operation(kind).gain(state_, patch_, purpose);
    if (gain > 0) candidates_.push_back({gain, kind, slot});
  }
}

Visit SurfaceWorker::make_best(VertexId v) {
  std::ranges::sort(candidates_, {}, [](const Candidate& c) { return std::tuple(-c.gain, c.kind, c.slot); });
  for (const Candidate& candidate : candidates_) {
    operation(candidate.kind).propose(state_, v, candidate.slot, patch_);
    switch (judge(patch_)) {
      case Verdict::done:
        make(patch_);
        ++operations_[candidate.kind].done;
        return Visit::moved;
      case Verdict::postponed:
        return Visit::postponed;
      default:
        ++operations_[candidate.kind].refused;
    }
  }
  return Visit::refused;
}

Verdict SurfaceWorker::judge(const Patch& patch) {
  if (!keeps_bends(state_, patch)) return Verdict::bends;
  if (!state_.surface.has_room_for(patch)) return Verdict::too_many_neighbours;
  if (!is_within_region(patch)) return Verdict::postponed;
  if (!guard_.is_ok(patch)) return Verdict::meets;
  if (!is_within_bound(patch)) return Verdict::deviates;
  return guard_.must_wait(patch) ? Verdict::postponed : Verdict::done;
}

bool SurfaceWorker::is_within_region(const Patch& patch) const {
  if (!guard_.is_within_region(patch)) return false;
  if (region_ == nullptr || !state_.bound) return true;
  return region_->contains(state_.surface.guarded().grid.reading(state_.bound->reach(guard_.reach_of(patch))));
}

bool SurfaceWorker::is_within_bound(const Patch& patch) {
  if (!state_.bound) return true;
  const EditableSurface& surface = state_.surface;
  corners_.clear();
  for (const Triangle& t : patch.new_triangles) corners_.push_back({surface.point(t[0]), surface.point(t[1]), surface.point(t[2])});
  return state_.bound->allows(surface.mesh(), surface.guarded().grid, patch.old_faces, corners_);
}

void SurfaceWorker::make(const Patch& patch) {
  if (state_.options.preserves_volume) state_.ledger.book(state_.surface, patch);
  state_.surface.replace(patch);
  for (const VertexId w : patch.boundary) state_.is_touched[w] = 1;
  if (patch.added != kNoVertex) state_.is_touched[patch.added] = 1;
}

Visit SurfaceWorker::relax(VertexId v) {
  if (!is_star_within_region(v)) return Visit::postponed;
  const Vec3 step = keeping_volume(v, step_to_centroid(state_.surface, v));
  const double least = kLeastStepRel * state_.sizes[v];
  return step.squaredNorm() < least * least ? Visit::unmoved : move(v, step);
}

Visit SurfaceWorker::give_back(VertexId v) {
  if (!is_star_within_region(v)) return Visit::postponed;
  const Vec3& x = state_.surface.point(v);
  const Vec3 step = keeping_volume(v, Vec3::Zero());
  const StarShape now = star_shape_at(v, x);
  for (const double part : kStepParts)
    if (!is_worse(star_shape_at(v, x + part * step), now)) return move(v, part * step);
  return Visit::refused;
}

Vec3 SurfaceWorker::keeping_volume(VertexId v, const Vec3& step) const {
  return state_.options.preserves_volume ? state_.ledger.keeping_volume(state_.surface, v, step) : step;
}

Visit SurfaceWorker::move(VertexId v, const Vec3& step) {
  const Vec3 former = state_.surface.point(v);
  const Visit visit = mover_.visit(v, step);
  if (visit == Visit::refused) ++moves_.refused;
  if (visit != Visit::moved && visit != Visit::moved_shortened) return visit;
  if (state_.options.preserves_volume) state_.ledger.book_move(state_.surface, v, former);
  ++moves_.accepted;
  moves_.shortened += visit == Visit::moved_shortened ? 1 : 0;
  return visit;
}

SurfaceWorker::StarShape SurfaceWorker::star_shape_at(VertexId v, const Vec3& x) const {
  return {star_quality_at(state_, v, x), star_bend_at(state_, v, x)};
}

/// Whether triangles or bends come to miss a goal, or miss it by more.
bool SurfaceWorker::is_worse(const StarShape& then, const StarShape& now) {
  return then.triangles < std::min(now.triangles, 1.0) || then.bends < std::min(now.bends, 1.0);
}

/// By how much the worst triangle of the star gains at x, or, where all reach the goals, its worst bend; 0 where the other is worse.
double SurfaceWorker::gain_of_going_to(VertexId v, const Vec3& x, const StarShape& now) const {
  const StarShape then = star_shape_at(v, x);
  if (is_worse(then, now)) return 0;
  return now.triangles < 1 ? then.triangles - now.triangles : then.bends - now.bends;
}

Vec3 SurfaceWorker::best_step(VertexId v) const {
  const Vec3& x = state_.surface.point(v);
  const StarShape now = star_shape_at(v, x);
  double best = 0;
  Vec3 result = Vec3::Zero();
  for (const Vec3& step : steps_to_better_angles(state_, v)) {
    for (const double part : kStepParts) {
      const Vec3 candidate = keeping_volume(v, part * step);
      const double gain = gain_of_going_to(v, x + candidate, now);
      const bool reaches_goal = std::min(now.triangles, now.bends) + gain >= 1;
      if (gain <= best || (gain < kSmallestRepair && !reaches_goal)) continue;
      best = gain;
      result = candidate;
    }
  }
  return result;
}

Visit SurfaceWorker::repair(VertexId v) {
  if (!is_star_within_region(v)) return Visit::postponed;
  const StarShape shape = star_shape_at(v, state_.surface.point(v));
  const bool misses = shape.triangles < 1 || shape.bends < 1;
  const bool is_odd = std::abs(state_.excess(v)) > state_.options.goals.valence_spread;
  if (!misses && !is_odd) return Visit::unmoved;
  if (misses) {
    mover_.enter({&v, 1}, region_);
    const Visit visit = move(v, best_step(v));
    if (visit == Visit::moved || visit == Visit::moved_shortened) state_.is_touched[v] = 1;
    if (visit != Visit::refused && visit != Visit::unmoved) return visit;
  }
  candidates_.clear();
  for (const OperationKind kind : {kFlip, kCollapse, kSplit})
    if (misses || kind != kSplit) add_candidates(v, kind, Purpose::goals);
  return make_best(v);
}

void SurfaceWorker::judge_all(VertexId v, std::array<VerdictCounts, kOperationKinds>& operations, VerdictCounts& moves) {
  const auto count = [](VerdictCounts& counts, Verdict verdict) { ++counts[static_cast<std::size_t>(verdict)]; };
  enter({&v, 1}, nullptr);
  for (const OperationKind kind : {kFlip, kCollapse, kSplit}) {
    if (!is_enabled(state_.options, kind)) continue;
    for (std::size_t slot = 0; slot < state_.surface.valence(v); ++slot) {
      if (!operation(kind).propose(state_, v, slot, patch_))
        count(operations[kind], Verdict::not_manifold);
      else if (!(operation(kind).gain(state_, patch_, Purpose::goals) > 0))
        count(operations[kind], Verdict::no_gain);
      else
        count(operations[kind], judge(patch_));
    }
  }
  count(moves, best_step(v).isZero() ? Verdict::no_gain : Verdict::refused);
}

}  // namespace smopt
