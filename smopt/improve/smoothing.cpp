#include "smopt/improve/smoothing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "smopt/error.h"
#include "smopt/improve/move_guard.h"
#include "smopt/improve/screening.h"
#include "smopt/mesh/rings.h"

namespace smopt {
namespace {

/// A step shorter than this part of the longest spoke is none: its effect on any angle is below 1e-7 rad, and without a bound the fixed
/// point would be approached for ever.
constexpr double kNegligibleStepRel = 1e-7;
/// Vertices between two progress reports.
constexpr std::size_t kProgressStride = 16384;

class Smoother {
 public:
  Smoother(TriangleMesh& mesh, const VertexRings& rings, const SmoothingOptions& options, const ProgressCallback& progress)
      : mesh_(mesh),
        rings_(rings),
        options_(options),
        progress_(progress),
        guard_(mesh, rings),
        is_stuck_(mesh.vertex_count(), 0),
        bad_squared_sine_(std::pow(std::sin(options.thresholds.min_angle_deg * std::numbers::pi / 180), 2)) {}

  SmoothingReport run() {
    Screening screening(mesh_, rings_, options_.thresholds);
    sweep(vertices_with_star());
    ActiveSet active = screening.of_all();
    while (!is_finished(active)) {
      for (int i = 0; i < options_.rounds_per_screening && has_rounds_left(); ++i) sweep(active.vertices);
      active = screening.of_stars(active.vertices);
    }
    report_.low_quality = active.low_quality;
    report_.stuck = static_cast<std::size_t>(std::count(is_stuck_.begin(), is_stuck_.end(), 1));
    return std::move(report_);
  }

 private:
  [[nodiscard]] std::vector<VertexId> vertices_with_star() const {
    std::vector<VertexId> vertices;
    vertices.reserve(mesh_.vertex_count());
    for (VertexId v = 0; v < mesh_.vertex_count(); ++v)
      if (rings_.valence(v) > 0) vertices.push_back(v);
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

  void sweep(const std::vector<VertexId>& vertices) {
    RoundReport round;
    round.active = vertices.size();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (i % kProgressStride == 0)
        report_progress(progress_, "smoothing", done(static_cast<double>(i) / static_cast<double>(vertices.size())));
      if (is_stuck_[vertices[i]] == 0) move(vertices[i], round);
    }
    report_.moves.accepted += round.moves.accepted;
    report_.moves.shortened += round.moves.shortened;
    report_.moves.refused += round.moves.refused;
    report_.rounds.push_back(round);
  }

  /// The first sweep takes about half of the time, whatever follows.
  [[nodiscard]] double done(double fraction_of_round) const {
    const double rounds_done = static_cast<double>(report_.rounds.size());
    return rounds_done == 0 ? 0.5 * fraction_of_round : 0.5 + 0.5 * (rounds_done + fraction_of_round) / options_.rounds;
  }

  void move(VertexId v, RoundReport& round) {
    const Vec3 from = mesh_.points[v];
    const Vec3 step = proposed_step(options_.step, from, rings_.vertices(v), mesh_.points);
    if (is_negligible(v, step)) return;
    guard_.select(v, from + step);
    double beta = 1;
    for (int halving = 0; halving <= options_.halvings; ++halving, beta *= 0.5) {
      const Vec3 target = from + beta * step;
      if (options_.keeps_angles && makes_bad_angle_worse(v, target)) continue;
      if (!guard_.is_move_ok(target)) continue;
      guard_.apply();
      for (const VertexId w : rings_.vertices(v)) is_stuck_[w] = 0;
      ++round.moves.accepted;
      round.moves.shortened += halving > 0 ? 1 : 0;
      round.longest_move = std::max(round.longest_move, beta * step.norm());
      return;
    }
    is_stuck_[v] = 1;
    ++round.moves.refused;
  }

  [[nodiscard]] bool makes_bad_angle_worse(VertexId v, const Vec3& target) const {
    const double after = squared_sine_in_star(v, target);
    return after < bad_squared_sine_ && after < squared_sine_in_star(v, mesh_.points[v]);
  }

  /// Of the smallest angle in the star of v, if v were at `position`.
  [[nodiscard]] double squared_sine_in_star(VertexId v, const Vec3& position) const {
    const std::span<const VertexId> ring = rings_.vertices(v);
    double smallest = 1;
    VertexId before = ring.back();
    for (const VertexId w : ring) {
      smallest = std::min(smallest, squared_sine_of_smallest_angle(position, mesh_.points[before], mesh_.points[w]));
      before = w;
    }
    return smallest;
  }

  [[nodiscard]] bool is_negligible(VertexId v, const Vec3& step) const {
    double longest2 = 0;
    for (const VertexId w : rings_.vertices(v)) longest2 = std::max(longest2, (mesh_.points[w] - mesh_.points[v]).squaredNorm());
    return step.squaredNorm() <= kNegligibleStepRel * kNegligibleStepRel * longest2;
  }

  TriangleMesh& mesh_;
  const VertexRings& rings_;
  const SmoothingOptions& options_;
  const ProgressCallback& progress_;
  MoveGuard guard_;
  std::vector<char> is_stuck_;  // per vertex: refused, and nothing around it has moved since
  double bad_squared_sine_;     // of the threshold angle
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
