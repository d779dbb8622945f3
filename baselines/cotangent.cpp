#include "baselines/cotangent.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "baselines/divergence_watch.h"
#include "baselines/meshlab.h"
#include "baselines/smoothing_run.h"
#include "smopt/error.h"
#include "smopt/mesh/rings.h"
#include "smopt/parallel.h"

namespace smopt::baselines {
namespace {

/// cot 3°: beyond this a cotangent says more about rounding than about the surface (pmp-library's bound).
constexpr double kLargestCotangent = 19.1;

/// Cotangents at the three corners.
using Cotangents = std::array<double, 3>;

Cotangents clamped_cotangents(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const double doubled_area = ab.cross(-ca).norm();
  const auto cotangent = [doubled_area](const Vec3& p, const Vec3& q) {
    const double dot = p.dot(q);
    if (!(doubled_area > 0)) return 0.0;
    return std::clamp(dot / doubled_area, -kLargestCotangent, kLargestCotangent);
  };
  return {cotangent(ab, -ca), cotangent(-ab, bc), cotangent(ca, -bc)};
}

class Smoother {
 public:
  Smoother(const TriangleMesh& mesh, double beta) : mesh_(mesh), beta_(beta), cotangents_(mesh.triangle_count()) {
    std::optional<VertexRings> rings = build_rings(mesh);
    if (!rings) throw InvalidMesh("cotangent weights need a closed, oriented manifold");
    rings_ = std::move(*rings);
  }

  void step(const std::vector<Vec3>& from, std::vector<Vec3>& to) {
    for_ranges_in_parallel(mesh_.triangle_count(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const Triangle& t = mesh_.triangles[f];
        cotangents_[f] = clamped_cotangents(from[t[0]], from[t[1]], from[t[2]]);
      }
    });
    for_ranges_in_parallel(from.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) to[v] = moved(static_cast<VertexId>(v), from);
    });
  }

 private:
  /// In a triangle of v with the corners v, a, b: the cotangents that face the edges va and vb.
  struct Facing {
    double first;
    double second;
  };

  [[nodiscard]] Facing facing(FaceId f, VertexId v) const {
    const auto corner = static_cast<std::size_t>(corner_of(mesh_.triangles[f], v));
    return {cotangents_[f][(corner + 2) % 3], cotangents_[f][(corner + 1) % 3]};
  }

  [[nodiscard]] Vec3 moved(VertexId v, const std::vector<Vec3>& points) const {
    const auto ring = rings_.vertices(v);
    const auto faces = rings_.faces(v);
    if (ring.empty()) return points[v];
    Vec3 sum = Vec3::Zero();
    double weights = 0;
    double from_last = facing(faces.back(), v).second;  // of the edge to ring[i], by the triangle before it
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Facing here = facing(faces[i], v);
      const double weight = std::max(0.0, from_last + here.first);
      from_last = here.second;
      sum += weight * points[ring[i]];
      weights += weight;
    }
    return weights > 0 ? Vec3(points[v] + beta_ * (sum / weights - points[v])) : points[v];
  }

  const TriangleMesh& mesh_;
  VertexRings rings_;
  double beta_;
  std::vector<Cotangents> cotangents_;
};

MethodReport run_cotangent(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const CotangentOptions options{values.integer("rounds", 0), values.number("beta", 0)};
  MethodReport report;
  const auto diverged = timed(report.seconds, "smoothing", [&] {
    return values.text("precision") == "float32" ? smooth_meshlab(mesh, {options.rounds, MeshlabWeights::cotangent}, progress)
                                                 : smooth_cotangent(mesh, options, progress);
  });
  report_rounds(report, mesh, options.rounds, diverged);
  return report;
}

}  // namespace

std::optional<int> smooth_cotangent(TriangleMesh& mesh, const CotangentOptions& options, const ProgressCallback& progress) {
  DivergenceWatch watch(mesh.points);
  Smoother smoother(mesh, options.beta);
  std::vector<Vec3> next(mesh.points.size());
  for (int round = 1; round <= options.rounds; ++round) {
    report_progress(progress, "smoothing", static_cast<double>(round - 1) / options.rounds);
    smoother.step(mesh.points, next);
    mesh.points.swap(next);
    watch.look(mesh.points, round);
  }
  return watch.first_bad_step();
}

Method cotangent_method() {
  using Kind = MethodOption::Kind;
  const CotangentOptions defaults;
  return {"cotangent",
          "Laplacian smoothing with cotangent weights",
          "Desbrun, Meyer, Schröder, Barr, SIGGRAPH 1999; clamped as in pmp-library (Sieger, Botsch, 2020)",
          CavityPolicy::keep,
          {{"rounds", Kind::integer, fmt::format("{}", defaults.rounds), "", "sweeps over all vertices", {}},
           {"beta", Kind::number, fmt::format("{}", defaults.beta), "", "part of the way to the weighted mean; unused with float32", {}},
           {"precision",
            Kind::choice,
            "double",
            "",
            "double: weights clamped, never negative; float32: signed and unbounded, as MeshLab",
            {"double", "float32"}}},
          run_cotangent,
          "pmp-library weighs the edges once at the start; here they are weighed anew each round"};
}

}  // namespace smopt::baselines
