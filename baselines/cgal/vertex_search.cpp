#include "baselines/cgal/vertex_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace smopt::baselines {
namespace {

/// The exponent of the number of vertices over the edge length: −2 on a smooth surface, and kept near that where rounding or a surface
/// finer than the edges would send the secant astray.
constexpr double kExponent = -2, kLowestExponent = -4, kHighestExponent = -1;

/// An edge length and the vertices it gave, both as logarithms.
struct Sample {
  double length, vertices;
};

double exponent(const std::optional<Sample>& previous, const Sample& last) {
  if (!previous || previous->length == last.length) return kExponent;
  return std::clamp((last.vertices - previous->vertices) / (last.length - previous->length), kLowestExponent, kHighestExponent);
}

}  // namespace

VertexSearchResult search_vertex_count(std::size_t target, double first_length, const std::function<TriangleMesh(double)>& remesh) {
  const double wanted = std::log(static_cast<double>(target));
  const auto miss = [&](std::size_t vertices) { return std::abs(static_cast<double>(vertices) / static_cast<double>(target) - 1); };
  VertexSearchResult best;
  std::optional<Sample> previous;
  double length = first_length;
  while (best.runs < kMostRuns && !best.is_near) {
    TriangleMesh mesh = remesh(length);
    const Sample last{std::log(length), std::log(static_cast<double>(mesh.vertex_count()))};
    if (best.runs++ == 0 || miss(mesh.vertex_count()) < miss(best.mesh.vertex_count())) {
      best.mesh = std::move(mesh);
      best.edge_length = length;
      best.is_near = miss(best.mesh.vertex_count()) <= kVertexTolerance;
    }
    length = std::exp(last.length + (wanted - last.vertices) / exponent(previous, last));
    previous = last;
  }
  return best;
}

}  // namespace smopt::baselines
