#include "metrics/shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "metrics/finite.h"

namespace smopt::metrics {
namespace {

constexpr std::size_t kRatioBins = 50;  ///< bins of 0.02, those of the paper's figure 6
constexpr std::size_t kAngleBins = 90;  ///< bins of 2°, those of the paper's figure 7

using Corners = std::array<Vec3, 3>;

double edge_ratio(const Corners& p) {
  const std::array<double, 3> lengths = {(p[1] - p[0]).norm(), (p[2] - p[1]).norm(), (p[0] - p[2]).norm()};
  const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
  return *longest > 0 ? *shortest / *longest : 0.0;
}

/// atan2 of sine and cosine: accurate for needles and caps, where acos and asin are not.
double angle_deg(const Vec3& at, const Vec3& a, const Vec3& b) {
  const Vec3 u = a - at;
  const Vec3 v = b - at;
  return std::atan2(u.cross(v).norm(), u.dot(v)) * 180.0 / std::numbers::pi;
}

std::optional<double> share(const std::vector<double>& values, auto&& predicate) {
  if (values.empty()) return std::nullopt;
  return static_cast<double>(std::count_if(values.begin(), values.end(), predicate)) / static_cast<double>(values.size());
}

std::optional<double> share_below(const std::vector<double>& values, double limit) {
  return share(values, [limit](double x) { return x < limit; });
}

std::optional<double> share_above(const std::vector<double>& values, double limit) {
  return share(values, [limit](double x) { return x > limit; });
}

std::optional<double> mean(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The middle value, or the mean of the two middle ones.
std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

std::optional<double> smallest(const std::vector<double>& values) {
  return values.empty() ? std::nullopt : std::optional(*std::min_element(values.begin(), values.end()));
}

std::optional<double> largest(const std::vector<double>& values) {
  return values.empty() ? std::nullopt : std::optional(*std::max_element(values.begin(), values.end()));
}

EdgeRatios measure_edge_ratios(const std::vector<Corners>& triangles) {
  EdgeRatios result;
  result.histogram = Histogram(0.0, 1.0, kRatioBins);
  std::vector<double> ratios;
  ratios.reserve(triangles.size());
  for (const Corners& p : triangles) {
    ratios.push_back(edge_ratio(p));
    result.histogram.add(ratios.back());
  }
  result.min = smallest(ratios);
  result.mean = mean(ratios);
  result.share_below_01 = share_below(ratios, 0.1);
  result.median = median(std::move(ratios));
  return result;
}

Angles measure_angles(const std::vector<Corners>& triangles) {
  Angles result;
  result.histogram = Histogram(0.0, 180.0, kAngleBins);
  std::vector<double> minima;
  std::vector<double> maxima;
  for (const Corners& p : triangles) {
    const std::array<double, 3> angles = {angle_deg(p[0], p[1], p[2]), angle_deg(p[1], p[2], p[0]), angle_deg(p[2], p[0], p[1])};
    for (const double angle : angles) result.histogram.add(angle);
    minima.push_back(*std::min_element(angles.begin(), angles.end()));
    maxima.push_back(*std::max_element(angles.begin(), angles.end()));
  }
  result.min = smallest(minima);
  result.max = largest(maxima);
  result.mean_min = mean(minima);
  result.smallest_below_5 = share_below(minima, 5);
  result.smallest_below_10 = share_below(minima, 10);
  result.smallest_below_20 = share_below(minima, 20);
  result.smallest_below_30 = share_below(minima, 30);
  result.largest_above_120 = share_above(maxima, 120);
  result.largest_above_150 = share_above(maxima, 150);
  return result;
}

}  // namespace

Shape measure_shape(const TriangleMesh& mesh, std::vector<std::string>& notes) {
  std::vector<Corners> triangles;
  triangles.reserve(mesh.triangle_count());
  for (const Triangle& t : mesh.triangles)
    if (has_finite_corners(mesh, t)) triangles.push_back({mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]});

  if (triangles.empty())
    notes.push_back("edge_ratio, angle_deg and their shares: there is no triangle to measure");
  else if (const std::size_t left_out = mesh.triangle_count() - triangles.size(); left_out > 0)
    notes.push_back(
        fmt::format("edge_ratio, angle_deg and their shares: {} triangles with a corner that is not finite are left out", left_out));
  return {measure_edge_ratios(triangles), measure_angles(triangles)};
}

}  // namespace smopt::metrics
