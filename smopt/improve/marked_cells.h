#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "smopt/geometry/vec3.h"

namespace smopt {

/// An axis-aligned box in ångström, bounds included.
struct Extent {
  Vec3 low, high;
};

/// A region of space as a set of cubic cells of one size, from which it can be told quickly that a box lies outside.
///
/// Cells are hashed to bits and share them (a Bloom filter with one hash function): the region may be somewhat larger than what was
/// marked, and is never smaller. For any two boxes that overlap: if the region covers one of them, it reaches the other. Memory: 512 KB.
class MarkedCells {
 public:
  /// \param cell_size  Å. All that is more than 2⁴⁰ cells from the origin counts as one cell along that axis.
  explicit MarkedCells(double cell_size);

  void mark(const Extent& box);
  /// Whether the region reaches into the box.
  [[nodiscard]] bool reaches(const Extent& box) const {
    const Range range = cells_of(box);
    return is_everything_ || is_large(range) || !is_true_for_all(range, [&](std::uint64_t bit) { return !is_marked(bit); });
  }
  /// Whether all of the box is in the region.
  [[nodiscard]] bool covers(const Extent& box) const {
    const Range range = cells_of(box);
    return is_everything_ || (!is_large(range) && is_true_for_all(range, [&](std::uint64_t bit) { return is_marked(bit); }));
  }

 private:
  /// The cells from `low` to `high`, both included.
  struct Range {
    std::array<std::int64_t, 3> low, high;
  };
  /// As many bits as stay in a processor's second-level cache.
  static constexpr int kLogBits = 22;
  /// A box of more cells, or of more along an axis, is not looked at cell by cell: it is taken to be reached, and not to be covered, by any
  /// region but everything.
  static constexpr std::int64_t kMaxCells = 1 << 15, kMaxCellsAlong = 1 << 8;
  /// Cell indices along an axis lie between this and its negative.
  static constexpr double kMaxIndex = 0x1p40;

  [[nodiscard]] std::int64_t cell(double x) const {
    // Shifted to be positive, so that cutting off is rounding down; what counts is only that a larger x has no smaller index.
    return static_cast<std::int64_t>(std::min(std::max(x * cells_per_unit_, -kMaxIndex), kMaxIndex) + 2 * kMaxIndex);
  }
  [[nodiscard]] Range cells_of(const Extent& box) const {
    return {{cell(box.low[0]), cell(box.low[1]), cell(box.low[2])}, {cell(box.high[0]), cell(box.high[1]), cell(box.high[2])}};
  }
  static bool is_large(const Range& r) {
    const std::int64_t x = r.high[0] - r.low[0], y = r.high[1] - r.low[1], z = r.high[2] - r.low[2];
    return (x | y | z) >= kMaxCellsAlong || (x + 1) * (y + 1) * (z + 1) > kMaxCells;
  }
  /// Calls visit(bit of cell) until it returns false; whether it never did.
  template <class Visit>
  static bool is_true_for_all(const Range& range, const Visit& visit) {
    // Multiplicative hashing with large odd numbers (the primes of xxHash): the upper bits of the sum spread over the table.
    constexpr std::uint64_t kX = 0x9E3779B185EBCA87, kY = 0xC2B2AE3D27D4EB4F, kZ = 0x165667B19E3779F9;
    for (std::int64_t x = range.low[0]; x <= range.high[0]; ++x)
      for (std::int64_t y = range.low[1]; y <= range.high[1]; ++y)
        for (std::int64_t z = range.low[2]; z <= range.high[2]; ++z) {
          const std::uint64_t hash =
              static_cast<std::uint64_t>(x) * kX + static_cast<std::uint64_t>(y) * kY + static_cast<std::uint64_t>(z) * kZ;
          if (!visit(hash >> (64 - kLogBits))) return false;
        }
    return true;
  }
  [[nodiscard]] bool is_marked(std::uint64_t bit) const { return (bits_[bit / 64] >> (bit % 64) & 1) != 0; }

  double cells_per_unit_;
  bool is_everything_ = false;  // a large box was marked
  std::vector<std::uint64_t> bits_;
};

}  // namespace smopt
