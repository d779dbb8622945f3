#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "smopt/geometry/box.h"
#include "smopt/improve/remesh/point_to_triangle.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// Below the square of the distance between two boxes, by more than single precision rounds; infinite where one is empty.
inline float squared_distance_below(const Box& a, const Box& b) {
  const Floats gap = larger_of(larger_of(a.low - b.high, b.low - a.high), Floats{});
  const Floats squares = gap * gap;
  return (squares[0] + squares[1] + squares[2]) * 0.999999F;
}

/// The triangle of a surface nearest to a point.
struct NearestTriangle {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  std::uint32_t place = kNone;  ///< where it is in what was searched
  double squared_distance = std::numeric_limits<double>::infinity();
};

/// The triangles of a surface that does not move, as a balanced binary tree of boxes (halved at the median of the longest extent) in an array.
///
/// Corners are copied next to each other, in double precision relative to the middle of the surface (`origin`); all points that are given and
/// returned are in that frame. Of node i, the children are 2i + 1 and 2i + 2.
class TriangleTree {
 public:
  /// Triangles of a leaf, at most.
  static constexpr std::uint32_t kMostInLeaf = 2;

  /// Cost: O(n log n), all cores: 40 ms for 130 000 triangles.
  explicit TriangleTree(const TriangleMesh& mesh);

  [[nodiscard]] const Vec3& origin() const { return origin_; }
  /// No coordinate is larger, Å.
  [[nodiscard]] double extent() const { return extent_; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(triangles_.size()); }
  /// The triangle at a place.
  [[nodiscard]] const Corners& operator[](std::uint32_t place) const { return triangles_[place]; }
  [[nodiscard]] PointToTriangle distance_to(std::uint32_t place) const { return PointToTriangle(triangles_[place]); }

  static constexpr std::uint32_t kRoot = 0;
  [[nodiscard]] const Box& box(std::uint32_t node) const { return boxes_[node]; }
  [[nodiscard]] bool is_leaf(std::uint32_t node) const { return node >= first_leaf_; }
  [[nodiscard]] std::span<const Corners> triangles_of(std::uint32_t leaf) const {
    const std::uint32_t begin = leaf_begin_[leaf - first_leaf_], end = leaf_begin_[leaf - first_leaf_ + 1];
    return {triangles_.data() + begin, end - begin};
  }

  /// The triangle nearest to p, or `known` where none is nearer.
  [[nodiscard]] NearestTriangle nearest(const Vec3& p, NearestTriangle known = {}) const;
  /// A triangle that is probably near p: none is known without a search.
  [[nodiscard]] std::uint32_t guess(const Vec3&) const { return NearestTriangle::kNone; }
  /// The same from the place of a triangle that is probably near, or kNone.
  [[nodiscard]] NearestTriangle nearest_from(const Vec3& p, std::uint32_t place) const;
  /// A distance that no triangle is nearer to p than, certified but for rounding: close to the distance, and the distance itself where the
  /// nearest triangles are not needles (see `PointToTriangle::distance_below`). Infinite where there is no triangle.
  /// \param known  what `nearest` gave for p
  [[nodiscard]] double distance_below(const Vec3& p, const NearestTriangle& known) const;

 private:
  /// Calls visit(place) for the triangles of all leaves that may be nearer to p than `bound` (squared), which visit may lower.
  template <class Visit>
  void search(const Vec3& p, const double& bound, const Visit& visit) const;

  Vec3 origin_ = Vec3::Zero();
  double extent_ = 0;
  std::uint32_t first_leaf_ = 0;
  std::vector<Box> boxes_;                 // of the nodes, outward-rounded
  std::vector<std::uint32_t> leaf_begin_;  // places
  std::vector<Corners> triangles_;
};

}  // namespace smopt
