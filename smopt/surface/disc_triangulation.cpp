#include "smopt/surface/disc_triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "smopt/geometry/predicates.h"
#include "smopt/geometry/triangle_shape.h"

namespace smopt {
namespace {

/// The projection of a loop along an axis, seen so that it runs anticlockwise.
class ProjectedLoop {
 public:
  ProjectedLoop(std::span<const Vec3> points, int axis, bool is_reversed) : points_(points), axis_(axis), sign_(is_reversed ? -1 : 1) {}

  [[nodiscard]] int orientation(std::size_t a, std::size_t b, std::size_t c) const {
    return sign_ * orient2d_along(axis_, points_[a], points_[b], points_[c]);
  }

  /// Whether sides that are not neighbours have no point in common, and neighbours no more than their corner.
  [[nodiscard]] bool is_simple(std::span<const std::uint8_t> loop) const {
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (doubles_back(loop[i], loop[(i + 1) % n], loop[(i + 2) % n])) return false;
      for (std::size_t j = i + 2; j < n; ++j) {
        if (i == 0 && j + 1 == n) continue;
        if (touch(loop[i], loop[(i + 1) % n], loop[j], loop[(j + 1) % n])) return false;
      }
    }
    return true;
  }

  /// Whether p is in the closed triangle abc, which runs anticlockwise.
  [[nodiscard]] bool holds(std::size_t a, std::size_t b, std::size_t c, std::size_t p) const {
    return orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0;
  }

 private:
  [[nodiscard]] double dot(std::size_t a, std::size_t b, std::size_t c) const {
    const Vec3 u = points_[b] - points_[a];
    const Vec3 v = points_[c] - points_[b];
    return u.dot(v) - u[axis_] * v[axis_];
  }

  [[nodiscard]] bool doubles_back(std::size_t a, std::size_t b, std::size_t c) const {
    return orientation(a, b, c) == 0 && !(dot(a, b, c) > 0);
  }

  [[nodiscard]] bool touch(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
    return orientation(a, b, c) * orientation(a, b, d) <= 0 && orientation(c, d, a) * orientation(c, d, b) <= 0;
  }

  std::span<const Vec3> points_;
  int axis_;
  int sign_;
};

/// Clips ears until a triangle is left.
class EarClipper {
 public:
  EarClipper(std::span<const std::uint8_t> loop, std::span<const Vec3> points, std::span<const unsigned> faces,
             const ProjectedLoop& projected)
      : rest_(loop.begin(), loop.end()), points_(points), faces_(faces), projected_(projected) {}

  std::optional<std::vector<PatchTriangle>> run() {
    while (rest_.size() > 3) {
      const std::optional<std::size_t> ear = best_ear();
      if (!ear) return std::nullopt;
      triangles_.push_back(triangle_at(*ear));
      rest_.erase(rest_.begin() + static_cast<std::ptrdiff_t>(*ear));
    }
    if (projected_.orientation(rest_[0], rest_[1], rest_[2]) <= 0) return std::nullopt;
    triangles_.push_back({rest_[0], rest_[1], rest_[2]});
    return std::move(triangles_);
  }

 private:
  [[nodiscard]] std::uint8_t at(std::size_t i) const { return rest_[i % rest_.size()]; }
  [[nodiscard]] PatchTriangle triangle_at(std::size_t i) const { return {at(i + rest_.size() - 1), at(i), at(i + 1)}; }

  [[nodiscard]] std::optional<std::size_t> best_ear() const {
    std::optional<std::size_t> best;
    double largest = -1;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      const PatchTriangle t = triangle_at(i);
      const double quality = squared_sine_of_smallest_angle(points_[t[0]], points_[t[1]], points_[t[2]]);
      if (quality > largest && is_ear(t)) {
        largest = quality;
        best = i;
      }
    }
    return best;
  }

  [[nodiscard]] bool is_ear(const PatchTriangle& t) const {
    if ((faces_[t[0]] & faces_[t[2]]) != 0 || projected_.orientation(t[0], t[1], t[2]) <= 0) return false;
    return std::none_of(rest_.begin(), rest_.end(),
                        [&](std::uint8_t p) { return p != t[0] && p != t[1] && p != t[2] && projected_.holds(t[0], t[1], t[2], p); });
  }

  std::vector<std::uint8_t> rest_;
  std::span<const Vec3> points_;
  std::span<const unsigned> faces_;
  const ProjectedLoop& projected_;
  std::vector<PatchTriangle> triangles_;
};

/// Half the sum of the cross products along the polygon: its area vector.
Vec3 area_vector(std::span<const std::uint8_t> loop, std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  const Vec3& origin = points[loop[0]];
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) sum += (points[loop[i]] - origin).cross(points[loop[i + 1]] - origin);
  return 0.5 * sum;
}

}  // namespace

std::optional<std::vector<PatchTriangle>> clip_ears(std::span<const std::uint8_t> loop, std::span<const Vec3> points,
                                                    std::span<const unsigned> faces) {
  const Vec3 area = area_vector(loop, points);
  std::array<int, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return std::abs(area[a]) > std::abs(area[b]); });
  for (const int axis : axes) {
    const ProjectedLoop projected(points, axis, area[axis] < 0);
    if (!projected.is_simple(loop)) continue;
    if (auto triangles = EarClipper(loop, points, faces, projected).run()) return triangles;
  }
  return std::nullopt;
}

}  // namespace smopt
