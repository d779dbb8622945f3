#include "baselines/laplacian.h"

#include <fmt/format.h>

#include "smopt/error.h"
#include "smopt/mesh/rings.h"

namespace smopt::baselines {
namespace {

Vec3 mean_of(std::span<const VertexId> ring, const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const VertexId w : ring) sum += points[w];
  return sum / static_cast<double>(ring.size());
}

/// One round from `from` to `to`; the same array for Gauss–Seidel.
void sweep(const VertexRings& rings, double beta, const std::vector<Vec3>& from, std::vector<Vec3>& to) {
  for (VertexId v = 0; v < rings.vertex_count(); ++v)
    if (rings.valence(v) > 0) to[v] = from[v] + beta * (mean_of(rings.vertices(v), from) - from[v]);
}

MethodReport run_laplacian(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const LaplacianOptions options{values.integer("rounds", 0), values.number("beta", 0),
                                 values.text("order") == "jacobi" ? SweepOrder::jacobi : SweepOrder::gauss_seidel};
  MethodReport report;
  timed(report.seconds, "smoothing", [&] { smooth_laplacian(mesh, options, progress); });
  report.rounds.assign(static_cast<std::size_t>(options.rounds), {mesh.vertex_count(), {mesh.vertex_count(), 0, 0}, 0});
  report.moves.accepted = mesh.vertex_count() * static_cast<std::size_t>(options.rounds);
  report.stopped_because = "rounds";
  return report;
}

}  // namespace

void smooth_laplacian(TriangleMesh& mesh, const LaplacianOptions& options, const ProgressCallback& progress) {
  const std::optional<VertexRings> rings = build_rings(mesh);
  if (!rings) throw InvalidMesh("Laplacian smoothing needs a closed, oriented manifold");
  std::vector<Vec3> next = options.order == SweepOrder::jacobi ? mesh.points : std::vector<Vec3>();
  for (int round = 0; round < options.rounds; ++round) {
    report_progress(progress, "smoothing", static_cast<double>(round) / options.rounds);
    if (options.order == SweepOrder::gauss_seidel) {
      sweep(*rings, options.beta, mesh.points, mesh.points);
    } else {
      sweep(*rings, options.beta, mesh.points, next);
      mesh.points.swap(next);
    }
  }
}

Method laplacian_method() {
  using Kind = MethodOption::Kind;
  const LaplacianOptions defaults;
  return {"laplacian",
          "plain Laplacian smoothing of every vertex, without any test",
          "Liu et al. 2017, equations 3 and 4; Field, Commun. Appl. Numer. Methods 4:709, 1988",
          CavityPolicy::keep,
          {{"rounds", Kind::integer, fmt::format("{}", defaults.rounds), "", "sweeps over all vertices", {}},
           {"beta", Kind::number, fmt::format("{}", defaults.beta), "", "part of the way to the mean of the neighbours", {}},
           {"order",
            Kind::choice,
            "jacobi",
            "",
            "jacobi: from the last round's positions; gauss-seidel: moved at once",
            {"jacobi", "gauss-seidel"}}},
          run_laplacian};
}

}  // namespace smopt::baselines
