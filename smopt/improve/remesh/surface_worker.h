#pragma once

#include <array>
#include <span>
#include <vector>

#include "smopt/improve/remesh/operation.h"
#include "smopt/improve/remesh/patch_guard.h"
#include "smopt/improve/remesh/remesh_state.h"
#include "smopt/improve/vertex_mover.h"

namespace smopt {

/// What became of an operation that is possible and wanted, or why it is not.
enum class Verdict : std::uint8_t { done, postponed, not_manifold, no_gain, bends, too_many_neighbours, meets, deviates, refused, kCount };

/// How often each verdict was given.
using VerdictCounts = std::array<std::size_t, static_cast<std::size_t>(Verdict::kCount)>;

/// Works on one vertex after the other, keeping to a region; each thread has one.
class SurfaceWorker {
 public:
  explicit SurfaceWorker(RemeshState& state);
  SurfaceWorker(const SurfaceWorker&) = delete;
  SurfaceWorker& operator=(const SurfaceWorker&) = delete;

  /// Announces the vertices to be visited next, neighbours in space, and the part of the surface that is this thread's (null: all of it).
  void enter(std::span<const VertexId> group, const TriangleGrid::CubeRange* region);

  /// Makes the wanted operation of one kind at v that gains most, of those that are allowed.
  Visit change(VertexId v, OperationKind kind);
  /// Moves v towards the centroid of its star. Between two calls of `enter`, either `relax` or others.
  Visit relax(VertexId v);
  /// Moves v so that it gives back volume, as far as no goal is missed for that. As `relax`.
  Visit give_back(VertexId v);
  /// Where a goal is missed around v: moves it to where that is better, or makes the operation that gains most.
  Visit repair(VertexId v);
  /// What would become of each operation at v, and of moving it (counted under `flips`, …, `moves`). Changes nothing.
  void judge_all(VertexId v, std::array<VerdictCounts, kOperationKinds>& operations, VerdictCounts& moves);

  [[nodiscard]] const std::array<OperationCounts, kOperationKinds>& operations() const { return operations_; }
  [[nodiscard]] const MoveCounts& moves() const { return moves_; }

 private:
  struct Candidate {
    double gain;
    OperationKind kind;
    std::size_t slot;
  };

  [[nodiscard]] bool is_star_within_region(VertexId v) const;
  void add_candidates(VertexId v, OperationKind kind, Purpose purpose);
  Visit make_best(VertexId v);
  [[nodiscard]] Verdict judge(const Patch& patch);
  [[nodiscard]] bool is_within_region(const Patch& patch) const;
  [[nodiscard]] bool is_within_bound(const Patch& patch);
  void make(const Patch& patch);
  Visit move(VertexId v, const Vec3& step);
  [[nodiscard]] Vec3 keeping_volume(VertexId v, const Vec3& step) const;
  struct StarShape {
    double triangles, bends;
  };
  [[nodiscard]] StarShape star_shape_at(VertexId v, const Vec3& x) const;
  [[nodiscard]] static bool is_worse(const StarShape& then, const StarShape& now);
  [[nodiscard]] double gain_of_going_to(VertexId v, const Vec3& x, const StarShape& now) const;
  [[nodiscard]] Vec3 best_step(VertexId v) const;

  RemeshState& state_;
  const TriangleGrid::CubeRange* region_ = nullptr;
  Patch patch_;
  PatchGuard guard_;
  VertexMover mover_;
  std::vector<Candidate> candidates_;
  std::vector<TrianglePoints> corners_;  // of the new triangles
  std::array<OperationCounts, kOperationKinds> operations_{};
  MoveCounts moves_;
};

/// The operations by their kinds.
const Operation& operation(OperationKind kind);
/// Whether the options allow it.
bool is_enabled(const RemeshOptions& options, OperationKind kind);
/// Whether it may be wanted at an edge of v for the sake of density.
bool may_be_wanted_around(const RemeshState& state, VertexId v, OperationKind kind);

}  // namespace smopt
