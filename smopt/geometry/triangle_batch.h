#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "smopt/geometry/box.h"
#include "smopt/geometry/lanes.h"
#include "smopt/geometry/triangle_grid.h"
#include "smopt/geometry/vec3.h"

namespace smopt {

/// The triangles in a small part of space, copied close together: a group of neighbouring vertices asks it instead of the grid.
///
/// Boxes are the grid's, in steps of a 64000th of the space, so that a query tests eight at once; corners are in single precision relative to a
/// centre nearby. The copy is complete for its space as long as every triangle that moves is updated here and stays within the space.
class TriangleBatch {
 public:
  /// A triangle, its corners in lanes 0 to 2 (lane 3 repeats lane 2).
  struct Entry {
    Floats x, y, z;  ///< Å, relative to center()
    std::uint32_t face;
    std::array<std::uint32_t, 3> corners;  ///< vertex numbers

    /// Of triangle f, whose corners are t.
    static Entry of(std::uint32_t f, const std::array<std::uint32_t, 3>& t, const std::vector<Vec3>& points, const Vec3& center) {
      const Eigen::Vector3f a = (points[t[0]] - center).cast<float>(), b = (points[t[1]] - center).cast<float>(),
                            c = (points[t[2]] - center).cast<float>();
      return Entry{Floats{a[0], b[0], c[0], c[0]}, Floats{a[1], b[1], c[1], c[1]}, Floats{a[2], b[2], c[2], c[2]}, f, t};
    }
    /// The largest coordinate, whatever its sign, Å.
    [[nodiscard]] float radius() const {
      const Floats largest = larger_of(larger_of(absolute(x), absolute(y)), absolute(z));
      return std::max({largest[0], largest[1], largest[2]});
    }
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

  /// Numbers of entries, ascending: all whose boxes overlap `box`, and perhaps some that miss it by less than a step. \pre covers(box). Valid
  /// until the next call. Cost: about a nanosecond an entry.
  [[nodiscard]] std::span<const std::uint32_t> near(const Box& box);

  /// Moves one corner of an entry to `point` (absolute); `box` is the triangle's new one, within the space.
  void move_corner(std::size_t i, std::uint32_t corner, const Vec3& point, const Box& box);

 private:
  /// Eight coordinates in steps of the space.
  using Steps = std::int16_t __attribute__((vector_size(16)));
  static constexpr std::size_t kBoxesPerGroup = 8;
  struct BoxGroup {
    Steps low[3], high[3];
  };

  void set_space(const Box& space);
  void add(std::uint32_t f, const Box& box, const std::vector<Vec3>& points, const std::array<std::uint32_t, 3>& t);
  /// A monotone function of the coordinates, so that boxes that overlap do so in steps too.
  [[nodiscard]] Masks steps_of(Floats point) const {
    const Floats steps = (point - space_.low) * steps_per_unit_ - 32000.0F;
    return __builtin_convertvector(smaller_of(larger_of(steps, in_all_lanes(-32000.0F)), in_all_lanes(32000.0F)), Masks);
  }
  void put_box(std::size_t i, const Box& box);

  Box space_;
  Floats steps_per_unit_{};
  Vec3 center_ = Vec3::Zero();
  float radius_ = 0;
  std::vector<std::uint32_t> faces_;  // to be copied
  std::vector<Entry> entries_;
  std::vector<BoxGroup> boxes_;      // of entry i: lane i % 8 of group i / 8; behind the last, boxes that nothing overlaps
  std::vector<std::uint32_t> near_;  // what was found last
};

}  // namespace smopt
