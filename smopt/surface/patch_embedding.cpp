#include "smopt/surface/patch_embedding.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <vector>

namespace smopt {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle3 = Kernel::Triangle_3;
using Segment3 = Kernel::Segment_3;

/// Exact contact tests between triangles that know which corners they share.
class PatchContacts {
 public:
  explicit PatchContacts(std::span<const Vec3> points) {
    points_.reserve(points.size());
    for (const Vec3& p : points) points_.emplace_back(p.x(), p.y(), p.z());
  }

  /// Whether the triangles meet elsewhere than in what they share.
  [[nodiscard]] bool intersect(const PatchTriangle& s, const PatchTriangle& t) const {
    const PatchTriangle a = shared_first(s, t);
    const PatchTriangle b = shared_first(t, s);
    switch (shared_count(s, t)) {
      case 0:
        return CGAL::do_intersect(solid(s), solid(t));
      case 1:
        return CGAL::do_intersect(opposite_side(a), solid(t)) || CGAL::do_intersect(opposite_side(b), solid(s));
      case 2:
        return leads(s, a[0], a[1]) == leads(t, a[0], a[1]) || fold_onto_each_other(a, b);
      default:
        return true;
    }
  }

 private:
  static bool has(const PatchTriangle& t, std::uint8_t corner) { return std::find(t.begin(), t.end(), corner) != t.end(); }

  static std::ptrdiff_t shared_count(const PatchTriangle& s, const PatchTriangle& t) {
    return std::count_if(s.begin(), s.end(), [&](std::uint8_t corner) { return has(t, corner); });
  }

  /// The corners of `s`, those that `t` has too in front.
  static PatchTriangle shared_first(PatchTriangle s, const PatchTriangle& t) {
    std::stable_partition(s.begin(), s.end(), [&](std::uint8_t corner) { return has(t, corner); });
    return s;
  }

  /// Whether the triangle runs along its edge from `from` to `to`, not the other way.
  static bool leads(const PatchTriangle& t, std::uint8_t from, std::uint8_t to) {
    return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) || (t[2] == from && t[0] == to);
  }

  [[nodiscard]] Triangle3 solid(const PatchTriangle& t) const { return {points_[t[0]], points_[t[1]], points_[t[2]]}; }
  [[nodiscard]] Segment3 opposite_side(const PatchTriangle& t) const { return {points_[t[1]], points_[t[2]]}; }

  /// Two triangles on one edge (the first two corners of each) overlap when they are in one plane and on one side of the edge.
  [[nodiscard]] bool fold_onto_each_other(const PatchTriangle& a, const PatchTriangle& b) const {
    const Point& p = points_[a[0]];
    const Point& q = points_[a[1]];
    return CGAL::orientation(p, q, points_[a[2]], points_[b[2]]) == CGAL::COPLANAR &&
           CGAL::coplanar_orientation(p, q, points_[a[2]], points_[b[2]]) == CGAL::POSITIVE;
  }

  std::vector<Point> points_;
};

}  // namespace

bool is_embedded(std::span<const Vec3> points, std::span<const PatchTriangle> triangles) {
  const PatchContacts contacts(points);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = i + 1; j < triangles.size(); ++j) {
      if (contacts.intersect(triangles[i], triangles[j])) return false;
    }
  }
  return true;
}

}  // namespace smopt
