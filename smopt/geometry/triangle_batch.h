#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "smopt/geometry/box.h"
#include "smopt/geometry/lanes.h"
#include "smopt/geometry/triangle_grid.h"
#include "smopt/geometry/vec3.h"

namespace smopt {

/// The triangles in a small part of space, copied close together: a group of neighbouring vertices asks it instead of the grid.
///
/// Boxes are the grid's, four to a group so that a query tests four at once; corners are in single precision relative to a centre nearby.
/// The copy is complete for its space as long as every triangle that moves is updated here and stays within the space.
class TriangleBatch {
 public:
  /// A triangle, its corners in lanes 0 to 2 (lane 3 repeats lane 2).
  struct Entry {
    Floats x, y, z;  ///< Å, relative to center()
    std::uint32_t face;
    std::array<std::uint32_t, 3> corners;  ///< vertex numbers
  };

  /// Copies every triangle whose box overlaps `space` (in the grid's frame). Cost: as the grid's query.
  void gather(const TriangleGrid& grid, const std::vector<Vec3>& points, const std::vector<std::array<std::uint32_t, 3>>& triangles,
              const Box& space, const Vec3& center);
  /// Forgets all.
  void clear() {
    space_ = Box{};
    entries_.clear();
  }

  /// Whether the copy is complete for this box.
  [[nodiscard]] bool covers(const Box& box) const { return space_.contains(box); }
  [[nodiscard]] const Vec3& center() const { return center_; }
  /// No coordinate of an entry is larger, Å.
  [[nodiscard]] float radius() const { return radius_; }
  [[nodiscard]] const Entry& operator[](std::size_t i) const { return entries_[i]; }

  /// Calls visit(i) for the entries whose boxes overlap `box`, until it returns false; returns whether it never did. \pre covers(box).
  template <class Visit>
  bool all_overlapping(const Box& box, const Visit& visit) const {
    const BoxLanes query(box);
    for (std::size_t group = 0; group < boxes_.size(); ++group) {
      for (unsigned hits = boxes_[group].overlaps(query); hits != 0; hits &= hits - 1)
        if (!visit(group * kLanes + static_cast<std::size_t>(__builtin_ctz(hits)))) return false;
    }
    return true;
  }

  /// Moves one corner of an entry to `point` (absolute); `box` is the triangle's new one, within the space.
  void move_corner(std::size_t i, std::uint32_t corner, const Vec3& point, const Box& box);

 private:
  /// Four boxes, or one in all lanes.
  struct BoxLanes {
    BoxLanes() : BoxLanes(Box{}) {}
    explicit BoxLanes(const Box& box)
        : low{in_all_lanes(box.low[0]), in_all_lanes(box.low[1]), in_all_lanes(box.low[2])},
          high{in_all_lanes(box.high[0]), in_all_lanes(box.high[1]), in_all_lanes(box.high[2])} {}
    [[nodiscard]] unsigned overlaps(const BoxLanes& q) const {
      return lanes_set((low[0] <= q.high[0]) & (low[1] <= q.high[1]) & (low[2] <= q.high[2]) & (q.low[0] <= high[0]) &
                       (q.low[1] <= high[1]) & (q.low[2] <= high[2]));
    }
    void set(std::size_t lane, const Box& box) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis][lane] = box.low[axis];
        high[axis][lane] = box.high[axis];
      }
    }
    Floats low[3], high[3];
  };

  Box space_;
  Vec3 center_ = Vec3::Zero();
  float radius_ = 0;
  std::vector<Entry> entries_;
  std::vector<BoxLanes> boxes_;  // of entry i: lane i % 4 of group i / 4; empty boxes behind the last
};

}  // namespace smopt
