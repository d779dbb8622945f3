#include "smopt/improve/remesh/remesh.h"

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>

#include "smopt/error.h"
#include "smopt/improve/remesh/goal_check.h"
#include "smopt/improve/remesh/patch_shape.h"
#include "smopt/improve/remesh/remesh_state.h"
#include "smopt/improve/remesh/sizing.h"
#include "smopt/improve/remesh/surface_worker.h"
#include "smopt/improve/tile_sweep.h"
#include "smopt/mesh/spatial_order.h"
#include "smopt/parallel.h"

namespace smopt {
namespace {

/// Rings around what an operation changed that the next round looks at again.
constexpr int kRingsAround = 2;
/// Refinement where nothing else helps: by how much edges become shorter, in how many rings, and how many rounds follow.
constexpr double kRefinement = 0.7;
constexpr int kRefinedRings = 3;
constexpr int kRoundsOfRefinement = 3;
/// It ends when the mesh has grown by more than this: molecules grow by less than 1 %, meshes full of needles would grow without end.
constexpr double kLargestGrowth = 1.1;
/// From this round on the sizes are set right for the number of vertices, as long as it is off by more than this part; before, splits are ahead
/// of collapses.
constexpr int kFirstAdjustment = 1;
constexpr double kTolerableMiss = 0.02;
/// Rounds after such a change, and that may be added for that in all.
constexpr int kRoundsToSettle = 2, kRoundsOfAdjustment = 6;
/// Sweeps at the end in which vertices give back volume, at most.
constexpr int kPaymentSweeps = 4;

class Remesher {
 public:
  Remesher(const TriangleMesh& mesh, const RemeshOptions& options, const ProgressCallback& progress)
      : options_(options),
        progress_(progress),
        state_(mesh, options),
        workers_([this] { return std::make_unique<SurfaceWorker>(state_); }) {
    if (std::isfinite(options.deviation)) state_.bound.emplace(mesh, options.deviation);
    WantedSizes wanted = find_sizes(mesh, state_.surface.rings(), options);
    state_.sizes = std::move(wanted.edges);
    wanted_vertices_ = wanted.vertices;
  }

  RemeshReport run() {
    run_rounds();
    std::vector<VertexId> missing = repaired(those_that_miss(all_vertices()));
    const auto most = static_cast<std::size_t>(kLargestGrowth * static_cast<double>(all_vertices().size()));
    for (int i = 0; i < options_.refinements && options_.splits; ++i) {
      const std::vector<VertexId> misshapen = filtered(missing, [&](VertexId v) { return has_bad_shape(state_, v); });
      if (misshapen.empty() || all_vertices().size() > most) break;
      missing = refined(misshapen);
    }
    give_back_volume();
    collect();
    return std::move(report_);
  }

  [[nodiscard]] TriangleMesh result() const { return state_.surface.compacted(); }

 private:
  /// As many as are asked for, and some more while the number of vertices is off.
  void run_rounds() {
    std::vector<VertexId> active = all_vertices();
    int last = options_.rounds;
    for (; report_.rounds < last && !active.empty(); ++report_.rounds) {
      active = run_round(active);
      const bool has_settled = report_.rounds >= kFirstAdjustment || active.empty();
      if (!has_settled || !adjust_sizes()) continue;
      active = all_vertices();
      last = std::min(std::max(last, report_.rounds + 1 + kRoundsToSettle), options_.rounds + kRoundsOfAdjustment);
    }
  }

  /// Splits, collapses, flips and relaxation. Returns what is to be looked at next.
  std::vector<VertexId> run_round(const std::vector<VertexId>& active) {
    std::ranges::fill(state_.is_touched, 0);
    report_progress(progress_, "remeshing", done());
    for (const OperationKind kind : {kSplit, kCollapse, kFlip}) change_all(kind == kSplit ? active : with_touched(active), kind);
    const std::vector<VertexId> changed = with_touched(active);
    sweep(changed, [](SurfaceWorker& worker, VertexId v) { return worker.relax(v); });
    return around_touched();
  }

  void change_all(const std::vector<VertexId>& active, OperationKind kind) {
    if (!is_enabled(options_, kind)) return;
    const std::vector<VertexId> visited = filtered(active, [&](VertexId v) { return may_be_wanted_around(state_, v, kind); });
    if (kind == kSplit) take_spare_numbers(visited);
    sweep(visited, [kind](SurfaceWorker& worker, VertexId v) { return worker.change(v, kind); });
  }

  /// Works on what misses a goal until nothing changes. Returns what still does.
  std::vector<VertexId> repaired(std::vector<VertexId> missing) {
    for (int i = 0; i < options_.repairs && !missing.empty(); ++i) {
      ++report_.repairs;
      std::ranges::fill(state_.is_touched, 0);
      report_progress(progress_, "repairs", static_cast<double>(i) / options_.repairs);
      take_spare_numbers(missing);
      sweep(worst_first(missing), [](SurfaceWorker& worker, VertexId v) { return worker.repair(v); });
      const std::vector<VertexId> changed = around_touched();
      missing = those_that_miss(united(missing, changed));
      has_come_to_rest_ = changed.empty();
      if (has_come_to_rest_) break;
    }
    return missing;
  }

  /// Each tile and each block of it will be visited in this order.
  [[nodiscard]] std::vector<VertexId> worst_first(const std::vector<VertexId>& vertices) const {
    std::vector<std::pair<double, VertexId>> order(vertices.size());
    for_ranges_in_parallel(vertices.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        order[i] = {star_quality_at(state_, vertices[i], state_.surface.point(vertices[i])), vertices[i]};
    });
    std::ranges::sort(order);
    std::vector<VertexId> result;
    result.reserve(order.size());
    for (const auto& [quality, v] : order) result.push_back(v);
    return result;
  }

  /// Where the surface has features that are too small for the triangles there, nothing helps but smaller ones: edges become shorter around the
  /// vertices, and rounds and repairs go on from there. Returns what still misses a goal.
  std::vector<VertexId> refined(const std::vector<VertexId>& misshapen) {
    ++report_.refinements;
    std::vector<VertexId> region = with_rings(misshapen, kRefinedRings);
    for (const VertexId v : region) state_.sizes[v] *= kRefinement;
    std::vector<VertexId> visited = region;
    for (int i = 0; i < kRoundsOfRefinement; ++i) {
      region = run_round(region);
      visited = united(visited, region);
    }
    return repaired(those_that_miss(visited));
  }

  void give_back_volume() {
    if (!options_.preserves_volume) return;
    for (int i = 0; i < kPaymentSweeps; ++i) {
      const std::vector<VertexId> debtors = filtered(all_vertices(), [&](VertexId v) { return state_.ledger.has_debt(state_.surface, v); });
      if (debtors.empty()) return;
      sweep(debtors, [](SurfaceWorker& worker, VertexId v) { return worker.give_back(v); });
    }
  }

  void take_spare_numbers(const std::vector<VertexId>& visited) {
    state_.spare.take(state_.surface, visited);
    state_.grow();
  }

  /// Visits the vertices, those that are still there, tile by tile.
  template <class Visitor>
  void sweep(const std::vector<VertexId>& vertices, const Visitor& visitor) {
    if (vertices.empty()) return;
    const SweepSchedule schedule(state_.surface.guarded().grid, state_.surface.mesh(), vertices);
    sweep_tiles(
        schedule, true,
        [&](std::span<const VertexId> group, const TriangleGrid::CubeRange* region, std::size_t, std::vector<VertexId>& postponed) {
          SurfaceWorker& worker = *workers_.local();
          worker.enter(group, region);
          for (const VertexId v : group)
            if (state_.surface.is_in_use(v) && visitor(worker, v) == Visit::postponed) postponed.push_back(v);
        },
        [&](double) { report_progress(progress_, "remeshing", done()); });
  }

  [[nodiscard]] double done() const {
    return options_.rounds > 0 ? std::min(1.0, static_cast<double>(report_.rounds) / options_.rounds) : 1;
  }

  template <class Predicate>
  [[nodiscard]] std::vector<VertexId> filtered(const std::vector<VertexId>& vertices, const Predicate& is_wanted) const {
    std::vector<char> flags(vertices.size());
    for_ranges_in_parallel(vertices.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) flags[i] = state_.surface.is_in_use(vertices[i]) && is_wanted(vertices[i]) ? 1 : 0;
    });
    std::vector<VertexId> result;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (flags[i] != 0) result.push_back(vertices[i]);
    return result;
  }

  [[nodiscard]] std::vector<VertexId> all_vertices() const {
    std::vector<VertexId> all;
    for (VertexId v = 0; v < state_.surface.mesh().vertex_count(); ++v)
      if (state_.surface.is_in_use(v)) all.push_back(v);
    return all;
  }

  [[nodiscard]] std::vector<VertexId> those_that_miss(const std::vector<VertexId>& vertices) const {
    return filtered(vertices, [&](VertexId v) { return misses_a_goal(state_, v); });
  }

  /// The vertices and those whose stars changed, ascending.
  [[nodiscard]] std::vector<VertexId> with_touched(const std::vector<VertexId>& vertices) const {
    return united(vertices, marked(state_.is_touched));
  }

  /// Those whose stars changed and some rings around them, ascending.
  [[nodiscard]] std::vector<VertexId> around_touched() const { return with_rings(marked(state_.is_touched), kRingsAround); }

  [[nodiscard]] std::vector<VertexId> with_rings(const std::vector<VertexId>& vertices, int rings) const {
    std::vector<char> marks(state_.is_touched.size(), 0);
    for (const VertexId v : vertices) marks[v] = 1;
    std::vector<VertexId> front = vertices;
    for (int ring = 0; ring < rings; ++ring) {
      std::vector<VertexId> next;
      for (const VertexId v : front) {
        for (const VertexId w : state_.surface.rings().vertices(v)) {
          if (marks[w] != 0) continue;
          marks[w] = 1;
          next.push_back(w);
        }
      }
      front = std::move(next);
    }
    return marked(marks);
  }

  [[nodiscard]] static std::vector<VertexId> united(const std::vector<VertexId>& a, const std::vector<VertexId>& b) {
    std::vector<VertexId> all;
    all.reserve(a.size() + b.size());
    std::ranges::set_union(a, b, std::back_inserter(all));
    return all;
  }

  [[nodiscard]] std::vector<VertexId> marked(const std::vector<char>& marks) const {
    std::vector<VertexId> vertices;
    for (VertexId v = 0; v < marks.size(); ++v)
      if (marks[v] != 0 && state_.surface.is_in_use(v)) vertices.push_back(v);
    return vertices;
  }

  /// Where the number of vertices is off, sizes become as much larger or smaller. Returns whether they did.
  bool adjust_sizes() {
    if (!options_.splits || !options_.collapses) return false;
    const double excess = static_cast<double>(all_vertices().size()) / wanted_vertices_;
    if (std::abs(excess - 1) <= kTolerableMiss) return false;
    for (double& size : state_.sizes) size *= std::sqrt(excess);
    return true;
  }

  void collect() {
    for (const std::unique_ptr<SurfaceWorker>& worker : workers_) {
      report_.moves += worker->moves();
      for (const OperationKind kind : {kFlip, kCollapse, kSplit}) report_.*operation(kind).counts += worker->operations()[kind];
    }
    report_.volume_owed = state_.ledger.total();
    take_spare_numbers({0});
    report_.goals = check_goals(state_, *workers_.local());
    const bool is_reached = std::ranges::all_of(report_.goals, [](const GoalOutcome& goal) { return goal.missing == 0; });
    report_.stopped_because = is_reached ? "all goals reached" : has_come_to_rest_ ? "nothing helps any more" : "repairs";
  }

  const RemeshOptions& options_;
  const ProgressCallback& progress_;
  RemeshState state_;
  tbb::enumerable_thread_specific<std::unique_ptr<SurfaceWorker>> workers_;
  double wanted_vertices_ = 0;
  bool has_come_to_rest_ = false;  // the last repair changed nothing
  RemeshReport report_;
};

}  // namespace

RemeshReport remesh(TriangleMesh& mesh, const RemeshOptions& options, const ProgressCallback& progress) {
  require_valid(options);
  SpatiallyOrderedMesh ordered(mesh);
  Remesher remesher(ordered.mesh(), options, progress);
  RemeshReport report = remesher.run();
  mesh = remesher.result();
  return report;
}

}  // namespace smopt
