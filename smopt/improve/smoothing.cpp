#include "smopt/improve/smoothing.h"

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "smopt/error.h"
#include "smopt/improve/move_guard.h"
#include "smopt/improve/screening.h"
#include "smopt/improve/sweep_schedule.h"
#include "smopt/mesh/rings.h"

namespace smopt {
namespace {

/// A step shorter than this part of the longest spoke is none: its effect on any angle is below 1e-7 rad, and without a bound the fixed
/// point would be approached for ever.
constexpr double kNegligibleStepRel = 1e-7;
/// What became of a visit to a vertex.
enum class Visit { unmoved, moved, moved_shortened, refused, postponed };

/// Moves single vertices; each thread has one.
class VertexMover {
 public:
  VertexMover(GuardedSurface& surface, const SmoothingOptions& options)
      : surface_(surface),
        options_(options),
        guard_(surface),
        bad_squared_sine_(std::pow(std::sin(options.thresholds.min_angle_deg * std::numbers::pi / 180), 2)) {}

  /// Moves v as far as it may go; postpones when that needs more than `region` (null: the whole surface is this thread's).
  Visit visit(VertexId v, const TriangleGrid::CubeRange* region) {
    const Vec3 from = surface_.mesh.points[v];
    const Vec3 step = proposed_step(options_.step, from, surface_.rings.vertices(v), surface_.mesh.points);
    moved_by_ = 0;
    if (is_negligible(v, step)) return Visit::unmoved;
    guard_.select(v, from + step);
    if (region != nullptr && !guard_.is_within(*region)) return Visit::postponed;
    double beta = 1;
    for (int halving = 0; halving <= options_.halvings; ++halving, beta *= 0.5) {
      const Vec3 target = from + beta * step;
      if (options_.keeps_angles && makes_bad_angle_worse(v, target)) continue;
      if (!guard_.is_move_ok(target)) continue;
      if (region != nullptr && guard_.needs_new_block()) return Visit::postponed;
      guard_.apply();
      moved_by_ = beta * step.norm();
      return halving > 0 ? Visit::moved_shortened : Visit::moved;
    }
    return Visit::refused;
  }

  /// Length of the last move, Å.
  [[nodiscard]] double moved_by() const { return moved_by_; }

 private:
  [[nodiscard]] bool makes_bad_angle_worse(VertexId v, const Vec3& target) const {
    const double after = squared_sine_in_star(v, target);
    return after < bad_squared_sine_ && after < squared_sine_in_star(v, surface_.mesh.points[v]);
  }

  /// Of the smallest angle in the star of v, if v were at `position`.
  [[nodiscard]] double squared_sine_in_star(VertexId v, const Vec3& position) const {
    const std::span<const VertexId> ring = surface_.rings.vertices(v);
    double smallest = 1;
    VertexId before = ring.back();
    for (const VertexId w : ring) {
      smallest = std::min(smallest, squared_sine_of_smallest_angle(position, surface_.mesh.points[before], surface_.mesh.points[w]));
      before = w;
    }
    return smallest;
  }

  [[nodiscard]] bool is_negligible(VertexId v, const Vec3& step) const {
    double longest2 = 0;
    for (const VertexId w : surface_.rings.vertices(v))
      longest2 = std::max(longest2, (surface_.mesh.points[w] - surface_.mesh.points[v]).squaredNorm());
    return step.squaredNorm() <= kNegligibleStepRel * kNegligibleStepRel * longest2;
  }

  GuardedSurface& surface_;
  const SmoothingOptions& options_;
  MoveGuard guard_;
  double bad_squared_sine_;  // of the threshold angle
  double moved_by_ = 0;
};

class Smoother {
 public:
  Smoother(TriangleMesh& mesh, const VertexRings& rings, const SmoothingOptions& options, const ProgressCallback& progress)
      : options_(options),
        progress_(progress),
        surface_(mesh, rings),
        movers_([this] { return VertexMover(surface_, options_); }),
        is_stuck_(mesh.vertex_count(), 0) {}

  SmoothingReport run() {
    Screening screening(surface_.mesh, surface_.rings, options_.thresholds);
    sweep(SweepSchedule(surface_.grid, surface_.mesh, vertices_with_star()));
    ActiveSet active = screening.of_all();
    while (!is_finished(active)) {
      const SweepSchedule schedule(surface_.grid, surface_.mesh, active.vertices);
      for (int i = 0; i < options_.rounds_per_screening && has_rounds_left(); ++i) sweep(schedule);
      active = screening.of_stars(active.vertices);
    }
    report_.low_quality = active.low_quality;
    report_.stuck = static_cast<std::size_t>(std::count(is_stuck_.begin(), is_stuck_.end(), 1));
    return std::move(report_);
  }

 private:
  [[nodiscard]] std::vector<VertexId> vertices_with_star() const {
    std::vector<VertexId> vertices;
    vertices.reserve(surface_.mesh.vertex_count());
    for (VertexId v = 0; v < surface_.mesh.vertex_count(); ++v)
      if (surface_.rings.valence(v) > 0) vertices.push_back(v);
    return vertices;
  }

  [[nodiscard]] bool has_rounds_left() const { return static_cast<int>(report_.rounds.size()) < options_.rounds; }

  bool is_finished(const ActiveSet& active) {
    if (active.low_quality == 0)
      report_.stopped_because = "quality reached";
    else if (report_.rounds.back().moves.accepted == 0)
      report_.stopped_because = "nothing moved";
    else if (!has_rounds_left())
      report_.stopped_because = "rounds";
    return !report_.stopped_because.empty();
  }

  /// The tiles of one colour after the other, then what had to wait.
  void sweep(const SweepSchedule& schedule) {
    std::vector<RoundReport> of_tiles(schedule.tile_count());
    std::vector<std::vector<VertexId>> postponed(schedule.tile_count());
    for (int color = 0; color < SweepSchedule::kColors; ++color) {
      report_progress(progress_, "smoothing", done(static_cast<double>(color) / SweepSchedule::kColors));
      const std::span<const SweepSchedule::Tile> tiles = schedule.tiles(color);
      tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
        const std::size_t index = schedule.index_of(tiles[i]);
        visit_all(schedule.vertices(tiles[i]), &tiles[i].region, of_tiles[index], postponed[index]);
      });
    }
    RoundReport round;
    round.active = schedule.vertex_count();
    std::vector<VertexId> none;
    for (const std::vector<VertexId>& vertices : postponed) visit_all(vertices, nullptr, round, none);
    for (const RoundReport& tile : of_tiles) add(round, tile);
    report_.moves.accepted += round.moves.accepted;
    report_.moves.shortened += round.moves.shortened;
    report_.moves.refused += round.moves.refused;
    report_.rounds.push_back(round);
  }

  static void add(RoundReport& round, const RoundReport& part) {
    round.moves.accepted += part.moves.accepted;
    round.moves.shortened += part.moves.shortened;
    round.moves.refused += part.moves.refused;
    round.longest_move = std::max(round.longest_move, part.longest_move);
  }

  void visit_all(std::span<const VertexId> vertices, const TriangleGrid::CubeRange* region, RoundReport& round,
                 std::vector<VertexId>& postponed) {
    VertexMover& mover = movers_.local();
    for (const VertexId v : vertices) {
      if (is_stuck_[v] != 0) continue;
      const Visit outcome = mover.visit(v, region);
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
  GuardedSurface surface_;
  tbb::enumerable_thread_specific<VertexMover> movers_;
  std::vector<char> is_stuck_;  // per vertex: refused, and nothing around it has moved since
  SmoothingReport report_;
};

void require_valid(const SmoothingOptions& options) {
  const auto& [edge_ratio, min_angle_deg] = options.thresholds;
  if (options.rounds < 0) throw InvalidOption(fmt::format("rounds: expected at least 0, got {}", options.rounds));
  if (options.rounds_per_screening < 1)
    throw InvalidOption(fmt::format("rounds-per-screening: expected at least 1, got {}", options.rounds_per_screening));
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
  const std::optional<VertexRings> rings = build_rings(mesh);
  if (!rings) throw InvalidMesh("smoothing needs a closed, oriented manifold");
  return Smoother(mesh, *rings, options, progress).run();
}

}  // namespace smopt
