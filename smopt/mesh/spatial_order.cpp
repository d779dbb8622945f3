#include "smopt/mesh/spatial_order.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace smopt {
namespace {

/// Steps along each axis: 2^10, so that a place on the curve has 30 bits.
constexpr int kAxisBits = 10;
/// The places are sorted by this many bits at a time.
constexpr int kDigitBits = 10;

struct PlacedVertex {
  std::uint32_t place;  // on the curve
  VertexId vertex;
};

/// Puts two zeros behind each of the ten lowest bits.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16) & 0x030000FFU;
  x = (x | x << 8) & 0x0300F00FU;
  x = (x | x << 4) & 0x030C30C3U;
  return (x | x << 2) & 0x09249249U;
}

std::vector<PlacedVertex> place_on_curve(const std::vector<Vec3>& points) {
  Vec3 low = Vec3::Constant(HUGE_VAL), high = Vec3::Constant(-HUGE_VAL);
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double extent = (high - low).maxCoeff();
  const double steps_per_unit = extent > 0 ? ((1 << kAxisBits) - 1) / extent : 0;
  std::vector<PlacedVertex> placed(points.size());
  for (VertexId v = 0; v < points.size(); ++v) {
    const auto step = [&](int axis) { return spread(static_cast<std::uint32_t>((points[v][axis] - low[axis]) * steps_per_unit)); };
    placed[v] = {step(0) << 2 | step(1) << 1 | step(2), v};
  }
  return placed;
}

/// By place; equal places keep their order.
void sort_by_place(std::vector<PlacedVertex>& vertices) {
  std::vector<PlacedVertex> sorted(vertices.size());
  for (int shift = 0; shift < 3 * kAxisBits; shift += kDigitBits) {
    std::array<std::uint32_t, (1 << kDigitBits) + 1> begin{};
    const auto digit = [shift](const PlacedVertex& v) { return v.place >> shift & ((1 << kDigitBits) - 1); };
    for (const PlacedVertex& v : vertices) ++begin[digit(v) + 1];
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    for (const PlacedVertex& v : vertices) sorted[begin[digit(v)]++] = v;
    vertices.swap(sorted);
  }
}

/// By smallest corner; equal ones keep their order.
std::vector<Triangle> sorted_by_smallest_corner(const std::vector<Triangle>& triangles, std::size_t vertices) {
  const auto smallest = [](const Triangle& t) { return std::min({t[0], t[1], t[2]}); };
  std::vector<std::uint32_t> begin(vertices + 1, 0);
  for (const Triangle& t : triangles) ++begin[smallest(t) + 1];
  for (std::size_t v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
  std::vector<Triangle> sorted(triangles.size());
  for (const Triangle& t : triangles) sorted[begin[smallest(t)]++] = t;
  return sorted;
}

}  // namespace

SpatiallyOrderedMesh::SpatiallyOrderedMesh(const TriangleMesh& original) {
  std::vector<PlacedVertex> order = place_on_curve(original.points);
  sort_by_place(order);
  number_.resize(order.size());
  mesh_.points.resize(order.size());
  for (VertexId v = 0; v < order.size(); ++v) {
    number_[order[v].vertex] = v;
    mesh_.points[v] = original.points[order[v].vertex];
  }
  std::vector<Triangle> renumbered(original.triangle_count());
  for (FaceId f = 0; f < renumbered.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) renumbered[f][i] = number_[original.triangles[f][i]];
  mesh_.triangles = sorted_by_smallest_corner(renumbered, order.size());
}

void SpatiallyOrderedMesh::copy_points_to(TriangleMesh& original) const {
  for (VertexId v = 0; v < number_.size(); ++v) original.points[v] = mesh_.points[number_[v]];
}

}  // namespace smopt
