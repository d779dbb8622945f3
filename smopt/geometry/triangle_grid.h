#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "smopt/geometry/box.h"
#include "smopt/geometry/vec3.h"

namespace smopt {

/// A spatial index of triangles that move: hashed cubes of one size, each listing the triangles whose boxes reach into it.
///
/// Entries are only ever added, so that a cube may list a triangle that has left it, never miss one that is there; every query tests the
/// triangle's present box. Two cubes may share a bucket, which costs time and nothing else. Memory follows the number of triangles, not the
/// size of the space: about 70 bytes a triangle.
/// The box is kept in single precision relative to the centre of all points, so that coordinates far from the origin stay sharp.
class TriangleGrid {
 public:
  /// Cost: O(n), for triangles of similar size; a triangle much larger than the cubes costs as many entries as cubes it covers, up to a
  /// bound.
  TriangleGrid(const std::vector<Vec3>& points, const std::vector<std::array<std::uint32_t, 3>>& triangles);

  /// The point that boxes are relative to.
  [[nodiscard]] const Vec3& origin() const { return origin_; }

  /// The box of three points (absolute coordinates) in the grid's own single-precision frame.
  [[nodiscard]] Box box_of(const Vec3& a, const Vec3& b, const Vec3& c) const {
    return triangle_box(a - origin_, b - origin_, c - origin_);
  }
  [[nodiscard]] Box box_of(const Vec3& low, const Vec3& high) const { return make_box(low - origin_, high - origin_); }

  /// Tells the grid where triangle f is now.
  void move(std::uint32_t f, const Box& box) {
    boxes_[f] = box;
    if (!ranges_[f].contains(cell_range(box))) extend(f, cell_range(box));
  }

  /// Takes triangle f out: no query finds it any more.
  void remove(std::uint32_t f) { boxes_[f] = Box{}; }

  /// Calls visit(f) for every triangle whose box overlaps `box`; one that covers several cubes may be visited several times.
  template <class Visit>
  void for_overlapping(const Box& box, const Visit& visit) const {
    const Range range = cell_range(box);
    if (cell_count(range) > static_cast<std::int64_t>(boxes_.size())) return visit_all(box, visit);
    for (int x = range.low[0]; x <= range.high[0]; ++x)
      for (int y = range.low[1]; y <= range.high[1]; ++y)
        for (int z = range.low[2]; z <= range.high[2]; ++z) visit_bucket(bucket_of(x, y, z), box, visit);
    for (const std::uint32_t f : large_)
      if (boxes_[f].overlaps(box)) visit(f);
  }

  [[nodiscard]] const Box& box(std::uint32_t f) const { return boxes_[f]; }

 private:
  /// The cubes from `low` to `high`, both included. Indices are 16 bits (the cubes are made large enough).
  struct Range {
    std::int16_t low[3];
    std::int16_t high[3];

    [[nodiscard]] bool contains(const Range& r) const {
      return static_cast<bool>((low[0] <= r.low[0]) & (low[1] <= r.low[1]) & (low[2] <= r.low[2]) & (r.high[0] <= high[0]) &
                               (r.high[1] <= high[1]) & (r.high[2] <= high[2]));
    }
  };
  /// An entry that was added after the build, in a linked list by bucket.
  struct AddedEntry {
    std::uint32_t face;
    std::uint32_t next;
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  [[nodiscard]] std::int16_t cell_index(float x) const {
    const float scaled = x * cells_per_unit_;
    const float clamped = scaled < -32000.0F ? -32000.0F : (scaled > 32000.0F ? 32000.0F : scaled);
    return static_cast<std::int16_t>(static_cast<int>(clamped + 32768.0F) - 32768);  // floor, by a shift to positive numbers
  }
  [[nodiscard]] Range cell_range(const Box& box) const {
    return {{cell_index(box.low[0]), cell_index(box.low[1]), cell_index(box.low[2])},
            {cell_index(box.high[0]), cell_index(box.high[1]), cell_index(box.high[2])}};
  }
  /// Cubes of one 4×4×4 block lie side by side in memory; blocks are hashed.
  [[nodiscard]] std::uint32_t bucket_of(int x, int y, int z) const {
    const std::uint32_t block = static_cast<std::uint32_t>(x >> 2) * 73856093U ^ static_cast<std::uint32_t>(y >> 2) * 19349663U ^
                                static_cast<std::uint32_t>(z >> 2) * 83492791U;
    const auto inner = static_cast<std::uint32_t>((x & 3) << 4 | (y & 3) << 2 | (z & 3));
    return ((block << 6) | inner) & bucket_mask_;
  }
  static std::int64_t cell_count(const Range& r) {
    return std::int64_t{r.high[0] - r.low[0] + 1} * (r.high[1] - r.low[1] + 1) * (r.high[2] - r.low[2] + 1);
  }
  template <class Visit>
  void visit_all(const Box& box, const Visit& visit) const {
    for (std::uint32_t f = 0; f < boxes_.size(); ++f)
      if (boxes_[f].overlaps(box)) visit(f);
  }
  template <class Visit>
  void visit_bucket(std::uint32_t bucket, const Box& box, const Visit& visit) const {
    for (std::uint32_t i = bucket_begin_[bucket]; i < bucket_begin_[bucket + 1]; ++i)
      if (boxes_[entries_[i]].overlaps(box)) visit(entries_[i]);
    for (std::uint32_t i = added_head_[bucket]; i != kNone; i = added_[i].next)
      if (boxes_[added_[i].face].overlaps(box)) visit(added_[i].face);
  }

  void choose_frame(const std::vector<Vec3>& points);
  void choose_cell_size();
  void sort_into_buckets();
  void extend(std::uint32_t f, const Range& range);
  void set_apart(std::uint32_t f);

  Vec3 origin_ = Vec3::Zero();
  float cells_per_unit_ = 1;
  float half_extent_ = 0;
  std::uint32_t bucket_mask_ = 0;
  std::vector<Box> boxes_;                   // per triangle
  std::vector<Range> ranges_;                // per triangle: the cubes that list it
  std::vector<std::uint32_t> bucket_begin_;  // per bucket, into entries_
  std::vector<std::uint32_t> entries_;
  std::vector<std::uint32_t> added_head_;  // per bucket, into added_
  std::vector<AddedEntry> added_;
  std::vector<std::uint32_t> large_;  // triangles that cover too many cubes: tested by every query
};

}  // namespace smopt
