#include "smopt/improve/smoothing.h"

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "smopt/error.h"
#include "smopt/improve/screening.h"
#include "smopt/improve/sweep_schedule.h"
#include "smopt/improve/vertex_mover.h"
#include "smopt/mesh/rings.h"
#include "smopt/mesh/spatial_order.h"

namespace smopt {
namespace {

class Smoother {
 public:
  /// \param order  all vertices, in the order in which each block of the schedule visits its own.
  Smoother(TriangleMesh& mesh, const VertexRings& rings, const std::vector<VertexId>& order, const SmoothingOptions& options,
           const ProgressCallback& progress)
      : options_(options),
        progress_(progress),
        order_(order),
        surface_(mesh, rings),
        movers_([this] { return VertexMover(surface_, options_, GuardFactory(options_.guard, surface_, options_.vicinity)()); }),
        is_stuck_(mesh.vertex_count(), 0) {}

  SmoothingReport run() {
    Screening screening(surface_.mesh, surface_.rings, options_.thresholds);
    sweep(SweepSchedule(surface_.grid, surface_.mesh, vertices_with_star()));
    ActiveSet active = screening.of_all();
    while (!is_finished(active)) {
      sweep_until_screening(SweepSchedule(surface_.grid, surface_.mesh, active.vertices));
      active = screening.of_stars(active.vertices);
    }
    report_.low_quality = active.low_quality;
    report_.stuck = static_cast<std::size_t>(std::count(is_stuck_.begin(), is_stuck_.end(), 1));
    return std::move(report_);
  }

 private:
  [[nodiscard]] std::vector<VertexId> vertices_with_star() const {
    std::vector<VertexId> vertices;
    vertices.reserve(order_.size());
    for (const VertexId v : order_)
      if (surface_.rings.valence(v) > 0) vertices.push_back(v);
    return vertices;
  }

  [[nodiscard]] bool has_rounds_left() const { return static_cast<int>(report_.rounds.size()) < options_.rounds; }

  bool is_finished(const ActiveSet& active) {
    if (active.low_quality == 0)
      report_.stopped_because = "quality reached";
    else if (has_come_to_rest_)
      report_.stopped_because = "nothing moved";
    else if (!has_rounds_left())
      report_.stopped_because = "rounds";
    return !report_.stopped_because.empty();
  }

  /// Sweeps as often as the options say, or until nothing moves any more.
  void sweep_until_screening(const SweepSchedule& schedule) {
    for (int i = 0; i < options_.rounds_per_screening && has_rounds_left(); ++i) {
      const bool has_moved = sweep(schedule);
      has_come_to_rest_ = i == 0 && !has_moved;
      if (!has_moved) return;
    }
  }

  /// The tiles of one colour after the other, then what had to wait. Returns whether anything moved.
  bool sweep(const SweepSchedule& schedule) {
    propose_steps(schedule);
    std::vector<RoundReport> of_tiles(schedule.tile_count());
    std::vector<std::vector<VertexId>> postponed(schedule.tile_count());
    for (int color = 0; color < SweepSchedule::kColors; ++color) {
      report_progress(progress_, "smoothing", done(static_cast<double>(color) / SweepSchedule::kColors));
      const std::span<const SweepSchedule::Tile> tiles = schedule.tiles(color);
      for_each_index(tiles.size(), [&](std::size_t i) {
        const std::size_t index = schedule.index_of(tiles[i]);
        for (const std::span<const VertexId> group : tiles[i].groups) visit_all(group, &tiles[i].region, of_tiles[index], postponed[index]);
      });
    }
    RoundReport round;
    std::vector<VertexId> none;
    for (const std::vector<VertexId>& vertices : postponed)
      for (const VertexId& v : vertices) visit_all({&v, 1}, nullptr, round, none);
    for (const RoundReport& tile : of_tiles) add(round, tile);
    round.active = schedule.vertices().size();
    add(report_.moves, round.moves);
    report_.rounds.push_back(round);
    return round.moves.accepted > 0;
  }

  /// By all threads where the guard can share the surface, else by one.
  template <class Work>
  void for_each_index(std::size_t count, const Work& work) {
    if (options_.guard == GuardKind::exact) return tbb::parallel_for(std::size_t{0}, count, work);
    for (std::size_t i = 0; i < count; ++i) work(i);
  }

  void propose_steps(const SweepSchedule& schedule) {
    if (options_.order != SweepOrder::jacobi) return;
    steps_.resize(surface_.mesh.vertex_count());
    tbb::parallel_for(std::size_t{0}, schedule.vertices().size(), [&](std::size_t i) {
      const VertexId v = schedule.vertices()[i];
      steps_[v] = movers_.local().proposed_step_of(v);
    });
  }

  static void add(MoveCounts& sum, const MoveCounts& part) {
    sum.accepted += part.accepted;
    sum.shortened += part.shortened;
    sum.refused += part.refused;
  }

  static void add(RoundReport& round, const RoundReport& part) {
    add(round.moves, part.moves);
    round.stuck += part.stuck;
    round.longest_move = std::max(round.longest_move, part.longest_move);
  }

  void visit_all(std::span<const VertexId> vertices, const TriangleGrid::CubeRange* region, RoundReport& round,
                 std::vector<VertexId>& postponed) {
    VertexMover& mover = movers_.local();
    mover.enter(vertices, region);
    for (const VertexId v : vertices) {
      if (is_stuck_[v] != 0) {
        ++round.stuck;
        continue;
      }
      const Visit outcome = mover.visit(v, options_.order == SweepOrder::jacobi ? steps_[v] : mover.proposed_step_of(v));
      if (outcome == Visit::postponed) postponed.push_back(v);
      if (outcome == Visit::refused) {
        is_stuck_[v] = 1;
        ++round.moves.refused;
      }
      if (outcome != Visit::moved && outcome != Visit::moved_shortened) continue;
      for (const VertexId w : surface_.rings.vertices(v)) is_stuck_[w] = 0;
      ++round.moves.accepted;
      round.moves.shortened += outcome == Visit::moved_shortened ? 1 : 0;
      round.longest_move = std::max(round.longest_move, mover.moved_by());
    }
  }

  /// The first sweep takes about half of the time, whatever follows.
  [[nodiscard]] double done(double fraction_of_round) const {
    const double rounds_done = static_cast<double>(report_.rounds.size());
    return rounds_done == 0 ? 0.5 * fraction_of_round : 0.5 + 0.5 * (rounds_done + fraction_of_round) / options_.rounds;
  }

  const SmoothingOptions& options_;
  const ProgressCallback& progress_;
  const std::vector<VertexId>& order_;
  GuardedSurface surface_;
  tbb::enumerable_thread_specific<VertexMover> movers_;
  std::vector<char> is_stuck_;     // per vertex: refused, and its ring has not moved since
  std::vector<Vec3> steps_;        // per vertex: proposed at the beginning of the sweep (Jacobi only)
  bool has_come_to_rest_ = false;  // a newly chosen active set has not moved
  SmoothingReport report_;
};

void require_valid(const SmoothingOptions& options) {
  const auto& [edge_ratio, min_angle_deg] = options.thresholds;
  if (options.rounds < 0) throw InvalidOption(fmt::format("rounds: expected at least 0, got {}", options.rounds));
  if (options.rounds_per_screening < 1)
    throw InvalidOption(fmt::format("rounds-per-screening: expected at least 1, got {}", options.rounds_per_screening));
  if (options.vicinity < 1) throw InvalidOption(fmt::format("vicinity: expected at least 1, got {}", options.vicinity));
  if (options.halvings < 0) throw InvalidOption(fmt::format("halvings: expected at least 0, got {}", options.halvings));
  if (!(edge_ratio >= 0 && edge_ratio < 1)) throw InvalidOption(fmt::format("edge-ratio: expected a number in [0, 1), got {}", edge_ratio));
  if (!(min_angle_deg >= 0 && min_angle_deg < 60))
    throw InvalidOption(fmt::format("min-angle: expected a number in [0, 60), got {}", min_angle_deg));
}

}  // namespace

SmoothingReport smooth(TriangleMesh& mesh, const SmoothingOptions& options, const ProgressCallback& progress) {
  require_valid(options);
  if (options.rounds == 0) {
    SmoothingReport report;
    report.stopped_because = "rounds";
    return report;
  }
  SpatiallyOrderedMesh ordered(mesh);
  const std::optional<VertexRings> rings = build_rings(ordered.mesh());
  if (!rings) throw InvalidMesh("smoothing needs a closed, oriented manifold");
  const SmoothingReport report = Smoother(ordered.mesh(), *rings, ordered.in_original_order(), options, progress).run();
  ordered.copy_points_to(mesh);
  return report;
}

}  // namespace smopt
