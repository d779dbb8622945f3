#include "smopt/improve/smoothing.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "smopt/error.h"
#include "smopt/improve/guarded_sweeper.h"
#include "smopt/improve/screening.h"
#include "smopt/mesh/rings.h"
#include "smopt/mesh/spatial_order.h"

namespace smopt {
namespace {

MoveRules rules_of(const SmoothingOptions& options) {
  return {options.guard, options.vicinity, options.halvings, options.keeps_angles, options.thresholds.min_angle_deg};
}

class Smoother {
 public:
  /// \param order  all vertices, in the order in which each block of the schedule visits its own.
  Smoother(TriangleMesh& mesh, const VertexRings& rings, const std::vector<VertexId>& order, const SmoothingOptions& options,
           const ProgressCallback& progress)
      : options_(options),
        progress_(progress),
        order_(order),
        mesh_(mesh),
        rings_(rings),
        surface_(mesh, rings),
        sweeper_(surface_, rules_of(options)) {}

  SmoothingReport run() {
    Screening screening(mesh_, rings_, options_.thresholds);
    sweep(sweeper_.schedule(vertices_with_star()));
    ActiveSet active = screening.of_all();
    while (!is_finished(active)) {
      sweep_until_screening(sweeper_.schedule(active.vertices));
      active = screening.of_stars(active.vertices);
    }
    report_.low_quality = active.low_quality;
    report_.stuck = sweeper_.stuck();
    return std::move(report_);
  }

 private:
  [[nodiscard]] std::vector<VertexId> vertices_with_star() const {
    std::vector<VertexId> vertices;
    vertices.reserve(order_.size());
    for (const VertexId v : order_)
      if (rings_.valence(v) > 0) vertices.push_back(v);
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

  /// Returns whether anything moved.
  bool sweep(const SweepSchedule& schedule) {
    const auto proposed = [this](VertexId v) { return proposed_step(options_.step, mesh_.points[v], rings_.vertices(v), mesh_.points); };
    const auto report = [this](double fraction) { report_progress(progress_, "smoothing", done(fraction)); };
    if (options_.order == SweepOrder::jacobi) {
      remember_steps(schedule.vertices(), proposed);
      report_.rounds.push_back(sweeper_.sweep(
          schedule, [this](VertexId v) { return steps_[v]; }, report));
    } else {
      report_.rounds.push_back(sweeper_.sweep(schedule, proposed, report));
    }
    const MoveCounts& moves = report_.rounds.back().moves;
    report_.moves += moves;
    return moves.accepted > 0;
  }

  template <class StepOf>
  void remember_steps(const std::vector<VertexId>& vertices, const StepOf& step_of) {
    steps_.resize(mesh_.vertex_count());
    tbb::parallel_for(std::size_t{0}, vertices.size(), [&](std::size_t i) { steps_[vertices[i]] = step_of(vertices[i]); });
  }

  /// The first sweep takes about half of the time, whatever follows.
  [[nodiscard]] double done(double fraction_of_round) const {
    const double rounds_done = static_cast<double>(report_.rounds.size());
    return rounds_done == 0 ? 0.5 * fraction_of_round : 0.5 + 0.5 * (rounds_done + fraction_of_round) / options_.rounds;
  }

  const SmoothingOptions& options_;
  const ProgressCallback& progress_;
  const std::vector<VertexId>& order_;
  const TriangleMesh& mesh_;
  const VertexRings& rings_;
  GuardedSurface surface_;
  GuardedSweeper sweeper_;
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
