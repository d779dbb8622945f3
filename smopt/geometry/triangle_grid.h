#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "smopt/geometry/box.h"
#include "smopt/geometry/vec3.h"

namespace smopt {

/// A spatial index of triangles that move: cubes of one size, each listing the triangles whose boxes reach into it.
///
/// Entries are only ever added, so that a cube may list a triangle that has left it, never miss one that is there; every query tests the
/// triangle's present box. Cubes are kept in blocks of 4×4×4, and blocks in a hash table, so that memory follows the surface and not the
/// size of the space: about 80 bytes a triangle. The box is kept in single precision relative to the centre of all points, so that
/// coordinates far from the origin stay sharp.
///
/// Threads may query and move triangles at the same time when each keeps to a region of its own made of whole blocks: every cube that its
/// queries cover, and every cube that lists or will list a triangle it moves, must lie in its region, and no move may need a new block.
class TriangleGrid {
 public:
  /// The cubes from `low` to `high`, both included, by 16-bit indices (the cubes are made large enough).
  struct CubeRange {
    std::int16_t low[3];
    std::int16_t high[3];

    [[nodiscard]] bool contains(const CubeRange& r) const {
      return static_cast<bool>((low[0] <= r.low[0]) & (low[1] <= r.low[1]) & (low[2] <= r.low[2]) & (r.high[0] <= high[0]) &
                               (r.high[1] <= high[1]) & (r.high[2] <= high[2]));
    }
  };
  /// Cubes along the edge of a block.
  static constexpr int kBlockEdge = 4;

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

  /// The cubes that a box covers.
  [[nodiscard]] CubeRange cubes_of(const Box& box) const {
    return {{cube_index(box.low[0]), cube_index(box.low[1]), cube_index(box.low[2])},
            {cube_index(box.high[0]), cube_index(box.high[1]), cube_index(box.high[2])}};
  }
  /// The cubes that list triangle f.
  [[nodiscard]] const CubeRange& listing(std::uint32_t f) const { return ranges_[f]; }

  /// Tells the grid where triangle f is now.
  void move(std::uint32_t f, const Box& box) {
    boxes_[f] = PackedBox(box);
    const CubeRange range = cubes_of(box);
    if (!ranges_[f].contains(range)) extend(f, range);
  }

  /// Whether moving triangle f to `box` would change more than blocks that exist: then no other thread may be at work.
  [[nodiscard]] bool needs_new_block(std::uint32_t f, const Box& box) const {
    const CubeRange range = cubes_of(box);
    return !ranges_[f].contains(range) && !has_blocks_for(united(ranges_[f], range));
  }

  /// Where triangle f is, as told last.
  [[nodiscard]] Box box(std::uint32_t f) const { return boxes_[f].unpacked(); }

  /// Takes triangle f out: no query finds it any more.
  void remove(std::uint32_t f) { boxes_[f] = PackedBox(Box{}); }

  /// Calls visit(f) once for every triangle whose box overlaps `box`.
  template <class Visit>
  void for_overlapping(const Box& box, const Visit& visit) const {
    const CubeRange range = cubes_of(box);
    const PackedQuery query(box);
    if (cube_count(range) > static_cast<std::int64_t>(boxes_.size())) return visit_all(query, visit);
    for (int x = range.low[0] >> 2; x <= range.high[0] >> 2; ++x)
      for (int y = range.low[1] >> 2; y <= range.high[1] >> 2; ++y)
        for (int z = range.low[2] >> 2; z <= range.high[2] >> 2; ++z) visit_block(x, y, z, range, query, visit);
    for (const std::uint32_t f : large_)
      if (query.overlaps(boxes_[f])) visit(f);
  }

 private:
  /// An entry that was added after the build, in a linked list by cube within its block.
  struct AddedEntry {
    std::uint32_t face;
    std::uint32_t next;
  };
  /// A box as eight floats (low, and high negated), so that an overlap is one comparison "all not larger" of two vectors.
  using Lanes = float __attribute__((vector_size(16)));
  struct PackedBox {
    PackedBox() : PackedBox(Box{}) {}
    [[nodiscard]] Box unpacked() const { return {{low[0], low[1], low[2]}, {-negated_high[0], -negated_high[1], -negated_high[2]}}; }
    explicit PackedBox(const Box& box)
        : low{box.low[0], box.low[1], box.low[2], 0.0F}, negated_high{-box.high[0], -box.high[1], -box.high[2], 0.0F} {}
    Lanes low, negated_high;
  };
  struct PackedQuery {
    explicit PackedQuery(const Box& box)
        : high{box.high[0], box.high[1], box.high[2], 0.0F}, negated_low{-box.low[0], -box.low[1], -box.low[2], 0.0F} {}
    [[nodiscard]] bool overlaps(const PackedBox& box) const {
      using Halves = std::int64_t __attribute__((vector_size(16)));
      const auto both = (box.low <= high) & (box.negated_high <= negated_low);
      const auto halves = reinterpret_cast<Halves>(both);
      return (halves[0] & halves[1]) == -1;
    }
    Lanes high, negated_low;
  };
  struct Block {
    std::uint64_t key;
    std::vector<AddedEntry> added;
  };
  struct TableEntry {
    std::uint64_t key;
    std::uint32_t block;  // kNone: free
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  static constexpr std::size_t kCubesPerBlock = 64;
  /// The lower end of the range of a triangle that is kept apart: below every cube.
  static constexpr std::int16_t kApart = -32768;

  [[nodiscard]] std::int16_t cube_index(float x) const {
    const float scaled = x * cubes_per_unit_;
    const float clamped = scaled < -32000.0F ? -32000.0F : (scaled > 32000.0F ? 32000.0F : scaled);
    return static_cast<std::int16_t>(static_cast<int>(clamped + 32768.0F) - 32768);  // floor, by a shift to positive numbers
  }
  static int cube_in_block(int x, int y, int z) { return (x & 3) << 4 | (y & 3) << 2 | (z & 3); }
  static std::uint64_t block_key(int x, int y, int z) {
    return static_cast<std::uint64_t>(static_cast<std::uint16_t>(x)) << 32 |
           static_cast<std::uint64_t>(static_cast<std::uint16_t>(y)) << 16 | static_cast<std::uint64_t>(static_cast<std::uint16_t>(z));
  }
  /// Where in the table the search for a key begins: the upper bits of a product with 2⁶⁴/φ (Knuth's multiplicative hashing).
  [[nodiscard]] std::size_t table_slot(std::uint64_t key) const { return (key * 0x9E3779B97F4A7C15U) >> table_shift_; }
  /// The number of a block, or kNone when nothing is there. Block coordinates are cube coordinates divided by 4.
  [[nodiscard]] std::uint32_t find_block(int x, int y, int z) const {
    const std::uint64_t key = block_key(x, y, z);
    for (std::size_t slot = table_slot(key);; slot = slot + 1 < table_.size() ? slot + 1 : 0) {
      if (table_[slot].block == kNone) return kNone;
      if (table_[slot].key == key) return table_[slot].block;
    }
  }
  static CubeRange united(const CubeRange& a, const CubeRange& b) {
    return {{std::min(a.low[0], b.low[0]), std::min(a.low[1], b.low[1]), std::min(a.low[2], b.low[2])},
            {std::max(a.high[0], b.high[0]), std::max(a.high[1], b.high[1]), std::max(a.high[2], b.high[2])}};
  }
  static std::int64_t cube_count(const CubeRange& r) {
    return std::int64_t{r.high[0] - r.low[0] + 1} * (r.high[1] - r.low[1] + 1) * (r.high[2] - r.low[2] + 1);
  }
  template <class Visit>
  void visit_all(const PackedQuery& query, const Visit& visit) const {
    for (std::uint32_t f = 0; f < boxes_.size(); ++f)
      if (query.overlaps(boxes_[f])) visit(f);
  }
  template <class Visit>
  void visit_block(int bx, int by, int bz, const CubeRange& cubes, const PackedQuery& query, const Visit& visit) const {
    const std::uint32_t block = find_block(bx, by, bz);
    if (block == kNone) return;
    const int x_end = std::min<int>(cubes.high[0], bx * 4 + 3), y_end = std::min<int>(cubes.high[1], by * 4 + 3),
              z_end = std::min<int>(cubes.high[2], bz * 4 + 3);
    for (int x = std::max<int>(cubes.low[0], bx * 4); x <= x_end; ++x)
      for (int y = std::max<int>(cubes.low[1], by * 4); y <= y_end; ++y)
        for (int z = std::max<int>(cubes.low[2], bz * 4); z <= z_end; ++z) visit_cube(block, x, y, z, cubes, query, visit);
  }
  template <class Visit>
  void visit_cube(std::uint32_t block, int x, int y, int z, const CubeRange& cubes, const PackedQuery& query, const Visit& visit) const {
    const std::size_t cube = std::size_t{block} * kCubesPerBlock + static_cast<std::size_t>(cube_in_block(x, y, z));
    // A triangle listed by several cubes of the query is visited in the first of them; one that was set apart since, not here.
    const auto is_first = [&](const CubeRange& listed) {
      return static_cast<bool>((x == std::max(listed.low[0], cubes.low[0])) & (y == std::max(listed.low[1], cubes.low[1])) &
                               (z == std::max(listed.low[2], cubes.low[2])) & (listed.low[0] != kApart));
    };
    const auto try_face = [&](std::uint32_t f) {
      if (query.overlaps(boxes_[f]) && is_first(ranges_[f])) visit(f);
    };
    for (std::uint32_t i = cube_begin_[cube]; i < cube_begin_[cube + 1]; ++i) try_face(entries_[i]);
    const std::vector<AddedEntry>& added = blocks_[block].added;
    for (std::uint32_t i = added_head_[cube]; i != kNone; i = added[i].next) try_face(added[i].face);
  }

  void choose_frame(const std::vector<Vec3>& points);
  void choose_cube_size(const std::vector<Box>& boxes);
  void sort_into_cubes();
  std::uint32_t find_or_add_block(int x, int y, int z);
  void put_into_table(std::uint64_t key, std::uint32_t block);
  void grow_table();
  [[nodiscard]] bool has_blocks_for(const CubeRange& range) const;
  void add_blocks_for(const CubeRange& range);
  void list(std::uint32_t f, int x, int y, int z);
  void extend(std::uint32_t f, const CubeRange& range);
  void set_apart(std::uint32_t f);

  Vec3 origin_ = Vec3::Zero();
  float cubes_per_unit_ = 1;
  float half_extent_ = 0;
  int table_shift_ = 0;
  std::vector<PackedBox> boxes_;   // per triangle
  std::vector<CubeRange> ranges_;  // per triangle: the cubes that list it
  std::vector<TableEntry> table_;  // open addressing, at most half full
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> cube_begin_;  // per cube of each block, into entries_
  std::vector<std::uint32_t> entries_;
  std::vector<std::uint32_t> added_head_;  // per cube of each block, into the block's added entries
  std::vector<std::uint32_t> large_;       // triangles that cover too many cubes: tested by every query
};

}  // namespace smopt
