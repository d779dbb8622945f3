#include "baselines/meshlab.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "baselines/divergence_watch.h"
#include "baselines/smoothing_run.h"
#include "smopt/mesh/stars.h"
#include "smopt/parallel.h"

namespace smopt::baselines {
namespace {

using Point = Eigen::Vector3f;
using Points = std::vector<Point>;
/// Of the edges (0, 1), (1, 2) and (2, 0) of a triangle.
using EdgeWeights = std::array<float, 3>;

/// Summed from left to right, as VCG does; Eigen sums the last two first.
float dot(const Point& a, const Point& b) {
  return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

/// The angle between two directions, as VCG computes it: −1 where one of them has no length.
float angle_between(const Point& a, const Point& b) {
  const float lengths = std::sqrt(dot(a, a)) * std::sqrt(dot(b, b));
  if (lengths == 0) return -1;
  return std::acos(std::clamp(dot(a, b) / lengths, -1.0F, 1.0F));
}

/// Its cotangent: a tangent in double of an angle that was rounded to float32.
float cotangent_of(float angle) {
  return static_cast<float>(std::tan(std::numbers::pi * 0.5 - angle));
}

EdgeWeights cotangents(const Triangle& t, const Points& points) {
  EdgeWeights weights{};
  for (std::size_t j = 0; j < 3; ++j) {
    const Point& opposite = points[t[(j + 2) % 3]];
    weights[j] = cotangent_of(angle_between(points[t[(j + 1) % 3]] - opposite, points[t[j]] - opposite));
  }
  return weights;
}

/// A vertex's weighted sum and the sum of the weights.
struct Sum {
  Point points = Point::Zero();
  float weights = 0;

  void add(const Point& p, float weight) {
    points += p * weight;
    weights += weight;
  }
};

/// The two edges of a triangle at each corner, in the order in which MeshLab's loop over edges meets them: (edge, its other end).
struct EdgeAtCorner {
  std::size_t edge;
  std::size_t other_end;
};
constexpr std::array<std::array<EdgeAtCorner, 2>, 3> kEdgesAtCorner = {{{{{0, 1}, {2, 2}}}, {{{0, 0}, {1, 2}}}, {{{1, 1}, {2, 0}}}}};

class Smoother {
 public:
  Smoother(const TriangleMesh& mesh, MeshlabWeights kind)
      : mesh_(mesh), stars_(build_stars(mesh)), kind_(kind), weights_(mesh.triangle_count(), {1, 1, 1}) {}

  void step(const Points& from, Points& to) {
    if (kind_ == MeshlabWeights::cotangent) weigh(from);
    for_ranges_in_parallel(from.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) to[v] = moved(static_cast<VertexId>(v), from);
    });
  }

 private:
  void weigh(const Points& points) {
    for_ranges_in_parallel(mesh_.triangle_count(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) weights_[f] = cotangents(mesh_.triangles[f], points);
    });
  }

  [[nodiscard]] Point moved(VertexId v, const Points& points) const {
    Sum sum;
    for (const FaceId f : stars_[v]) {
      const Triangle& t = mesh_.triangles[f];
      for (const EdgeAtCorner& at : kEdgesAtCorner[static_cast<std::size_t>(corner_of(t, v))])
        sum.add(points[t[at.other_end]], weights_[f][at.edge]);
    }
    if (!(sum.weights > 0)) return points[v];
    return (points[v] + sum.points) / (sum.weights + 1);
  }

  const TriangleMesh& mesh_;
  VertexStars stars_;
  MeshlabWeights kind_;
  std::vector<EdgeWeights> weights_;
};

MethodReport run_meshlab(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const MeshlabOptions options{values.integer("rounds", 0),
                               values.text("weights") == "uniform" ? MeshlabWeights::uniform : MeshlabWeights::cotangent};
  MethodReport report;
  const auto diverged = timed(report.seconds, "smoothing", [&] { return smooth_meshlab(mesh, options, progress); });
  report_rounds(report, mesh, options.rounds, diverged);
  return report;
}

}  // namespace

std::optional<int> smooth_meshlab(TriangleMesh& mesh, const MeshlabOptions& options, const ProgressCallback& progress) {
  Points points(mesh.vertex_count());
  for (std::size_t v = 0; v < points.size(); ++v) points[v] = mesh.points[v].cast<float>();
  Points next(points.size());
  DivergenceWatch watch(points);
  Smoother smoother(mesh, options.weights);
  for (int step = 1; step <= options.rounds; ++step) {
    report_progress(progress, "smoothing", static_cast<double>(step - 1) / options.rounds);
    smoother.step(points, next);
    points.swap(next);
    watch.look(points, step);
  }
  for (std::size_t v = 0; v < points.size(); ++v) mesh.points[v] = points[v].cast<double>();
  return watch.first_bad_step();
}

Method meshlab_method() {
  using Kind = MethodOption::Kind;
  return {"meshlab",
          "MeshLab's Laplacian Smooth, in float32 as MeshLab computes",
          "MeshLab 2020.09, filter Laplacian Smooth (Cignoni et al., Eurographics Italian Chapter 2008)",
          CavityPolicy::keep,
          {{"rounds", Kind::integer, fmt::format("{}", MeshlabOptions().rounds), "", "MeshLab's smoothing steps", {}},
           {"weights",
            Kind::choice,
            "cotangent",
            "",
            "cotangent: MeshLab's default, signed and unbounded; uniform: every neighbour the same",
            {"cotangent", "uniform"}}},
          run_meshlab,
          "slivers throw vertices far away with cotangent weights, in MeshLab too: the report says at which step (diverged_at_step)"};
}

}  // namespace smopt::baselines
