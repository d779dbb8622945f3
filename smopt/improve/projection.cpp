#include "smopt/improve/projection.h"

#include <fmt/format.h>

#include <vector>

#include "smopt/error.h"
#include "smopt/improve/guarded_sweeper.h"
#include "smopt/mesh/rings.h"
#include "smopt/mesh/spatial_order.h"
#include "smopt/parallel.h"

namespace smopt {
namespace {

class Projector {
 public:
  Projector(TriangleMesh& mesh, const VertexRings& rings, const GaussianField& field, double isovalue, const ProjectionOptions& options)
      : mesh_(mesh),
        rings_(rings),
        field_(field),
        isovalue_(isovalue),
        options_(options),
        surface_(mesh, rings),
        sweeper_(surface_, rules_of(options)) {}

  /// \param order  all vertices, in the order in which they are visited.
  ProjectionReport run(const std::vector<VertexId>& order, const ProgressCallback& progress) {
    steps_.resize(mesh_.vertex_count());
    std::vector<VertexId> on_the_way = still_away(order);
    while (!is_finished(on_the_way)) {
      sweep(on_the_way, progress);
      on_the_way = still_away(on_the_way);
    }
    report_.arrived = order.size() - on_the_way.size();
    return std::move(report_);
  }

 private:
  static MoveRules rules_of(const ProjectionOptions& options) {
    MoveRules rules;
    rules.halvings = options.halvings;
    rules.keeps_angles = options.keeps_angles;
    rules.min_angle_deg = options.min_angle_deg;
    return rules;
  }

  /// Of the given vertices, those that have a foot farther off than the tolerance or none; their steps are remembered.
  std::vector<VertexId> still_away(const std::vector<VertexId>& vertices) {
    std::vector<char> is_away(vertices.size());
    for_ranges_in_parallel(vertices.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Vec3& x = mesh_.points[vertices[i]];
        const std::optional<Vec3> foot = foot_on_level_set(field_, isovalue_, x);
        steps_[vertices[i]] = foot && rings_.valence(vertices[i]) > 0 ? Vec3(*foot - x) : Vec3::Zero();
        is_away[i] = !foot || (*foot - x).norm() > options_.tolerance ? 1 : 0;
      }
    });
    std::vector<VertexId> away;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (is_away[i] != 0) away.push_back(vertices[i]);
    }
    return away;
  }

  bool is_finished(const std::vector<VertexId>& on_the_way) {
    if (on_the_way.empty())
      report_.stopped_because = "all arrived";
    else if (!has_moved_)
      report_.stopped_because = "nothing moved";
    else if (report_.rounds >= options_.rounds)
      report_.stopped_because = "rounds";
    return !report_.stopped_because.empty();
  }

  void sweep(const std::vector<VertexId>& vertices, const ProgressCallback& progress) {
    const auto report = [&](double fraction) { report_progress(progress, "projection", (report_.rounds + fraction) / options_.rounds); };
    const RoundReport round = sweeper_.sweep(
        sweeper_.schedule(vertices), [this](VertexId v) { return steps_[v]; }, report);
    ++report_.rounds;
    report_.moves += round.moves;
    has_moved_ = round.moves.accepted > 0;
  }

  const TriangleMesh& mesh_;
  const VertexRings& rings_;
  const GaussianField& field_;
  double isovalue_;
  const ProjectionOptions& options_;
  GuardedSurface surface_;
  GuardedSweeper sweeper_;
  std::vector<Vec3> steps_;  // per vertex: to its foot from where it is
  bool has_moved_ = true;
  ProjectionReport report_;
};

void require_valid(const ProjectionOptions& options) {
  if (options.rounds < 0) throw InvalidOption(fmt::format("rounds: expected at least 0, got {}", options.rounds));
  if (options.halvings < 0) throw InvalidOption(fmt::format("halvings: expected at least 0, got {}", options.halvings));
  if (!(options.tolerance > 0)) throw InvalidOption(fmt::format("tolerance: expected a positive length, got {}", options.tolerance));
  if (!(options.min_angle_deg >= 0 && options.min_angle_deg < 60))
    throw InvalidOption(fmt::format("min-angle: expected a number in [0, 60), got {}", options.min_angle_deg));
}

}  // namespace

ProjectionReport project_onto_level_set(TriangleMesh& mesh, const GaussianField& field, double isovalue, const ProjectionOptions& options,
                                        const ProgressCallback& progress) {
  require_valid(options);
  const LevelSetDistance before = distance_to_level_set(field, isovalue, mesh.points);
  SpatiallyOrderedMesh ordered(mesh);
  const std::optional<VertexRings> rings = build_rings(ordered.mesh());
  if (!rings) throw InvalidMesh("projection needs a closed, oriented manifold");
  ProjectionReport report = Projector(ordered.mesh(), *rings, field, isovalue, options).run(ordered.in_original_order(), progress);
  ordered.copy_points_to(mesh);
  report.before = before;
  report.after = distance_to_level_set(field, isovalue, mesh.points);
  return report;
}

}  // namespace smopt
