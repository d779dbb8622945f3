#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "smopt/geometry/box.h"
#include "smopt/geometry/lanes.h"
#include "smopt/geometry/vec3.h"

namespace smopt {

/// A spatial index of triangles that move: cubes of sizes 1, 2, 4, …, each listing the triangles that are at home in it.
///
/// A triangle is at home in one cube, of a size not below its own, whose bounds loosened by half a cube on every side contain it. So it is listed
/// once, stays listed where it is while it moves a little, and is found wherever its box overlaps a query (loose octree: Ulrich, Game Programming
/// Gems, 2000). An entry that was left behind by a move stays, and is told by the triangle's present home. The cubes of three sizes make a block,
/// blocks of eight-fold size make the next tier; blocks are in a hash table, so that memory follows the surface and not the size of the space:
/// about 60 bytes a triangle. Boxes are kept in single precision relative to the centre of all points, so that coordinates far from the origin
/// stay sharp.
///
/// Threads may query and move triangles at the same time when each keeps to a region of its own made of whole blocks of the first tier: all that
/// its queries read (`reading`) and the homes of all triangles that it moves (`home`) must lie in its region, and no move may need more
/// (`needs_whole_grid`).
class TriangleGrid {
 public:
  /// The smallest cubes from `low` to `high`, both included, by 16-bit indices (the cubes are made large enough).
  struct CubeRange {
    std::int16_t low[3];
    std::int16_t high[3];

    [[nodiscard]] bool contains(const CubeRange& r) const {
      return static_cast<bool>((low[0] <= r.low[0]) & (low[1] <= r.low[1]) & (low[2] <= r.low[2]) & (r.high[0] <= high[0]) &
                               (r.high[1] <= high[1]) & (r.high[2] <= high[2]));
    }
  };
  /// Cubes along the edge of a block of the first tier.
  static constexpr int kBlockEdge = 4;

  /// Cost: O(n), whatever the sizes of the triangles.
  TriangleGrid(const std::vector<Vec3>& points, const std::vector<std::array<std::uint32_t, 3>>& triangles);

  /// The point that boxes are relative to.
  [[nodiscard]] const Vec3& origin() const { return origin_; }

  /// The box of three points (absolute coordinates) in the grid's own single-precision frame.
  [[nodiscard]] Box box_of(const Vec3& a, const Vec3& b, const Vec3& c) const {
    return triangle_box(a - origin_, b - origin_, c - origin_);
  }
  [[nodiscard]] Box box_of(const Vec3& p) const { return point_box(p - origin_); }
  [[nodiscard]] Box box_of(const Vec3& low, const Vec3& high) const { return make_box(low - origin_, high - origin_); }

  /// The cubes that a box covers.
  [[nodiscard]] CubeRange cubes_of(const Box& box) const {
    const Halves h = halves_of(box);
    CubeRange range;
    for (int i = 0; i < 3; ++i) {
      range.low[i] = static_cast<std::int16_t>(h.low[i] >> 1);
      range.high[i] = static_cast<std::int16_t>(h.high[i] >> 1);
    }
    return range;
  }
  /// What a query with this box reads in the first tier, in whole blocks.
  [[nodiscard]] CubeRange reading(const Box& box) const {
    const BlockRange blocks = blocks_for(halves_of(box), kSizes - 1);
    CubeRange range;
    for (int i = 0; i < 3; ++i) {
      range.low[i] = static_cast<std::int16_t>(blocks.low[i] * kBlockEdge);
      range.high[i] = static_cast<std::int16_t>(blocks.high[i] * kBlockEdge + kBlockEdge - 1);
    }
    return range;
  }
  /// The cubes that make up the home of triangle f; where it is not in the first tier, more than any region has.
  [[nodiscard]] CubeRange home(std::uint32_t f) const {
    const Home h = places_[f].home;
    if (h.size() >= kSizes) return {{-32768, -32768, -32768}, {32767, 32767, 32767}};
    CubeRange range;
    for (int i = 0; i < 3; ++i) {
      range.low[i] = static_cast<std::int16_t>(h.cube(i) << h.size());
      range.high[i] = static_cast<std::int16_t>(range.low[i] + (1 << h.size()) - 1);
    }
    return range;
  }

  /// Whether triangle f stays listed where it is when it moves to `box`.
  [[nodiscard]] bool stays_at_home(std::uint32_t f, const Box& box) const { return fits(places_[f].home, halves_of(box)); }
  /// Tells the grid where triangle f is now. \pre stays_at_home(f, box).
  void move_at_home(std::uint32_t f, const Box& box) { places_[f].set(box); }
  /// The same without the precondition.
  void move(std::uint32_t f, const Box& box) {
    places_[f].set(box);
    if (!stays_at_home(f, box)) settle(f, halves_of(box));
  }

  /// Whether moving triangle f to `box`, away from home, would change more than blocks that exist in the first tier: then no other thread may be
  /// at work.
  [[nodiscard]] bool needs_whole_grid(const Box& box) const { return !has_block_for(home_for(halves_of(box))); }

  /// Where triangle f is, as told last.
  [[nodiscard]] Box box(std::uint32_t f) const { return places_[f].box(); }

  /// Makes room for triangles up to this number; those that are new are nowhere until they are added.
  void grow(std::size_t triangles) { places_.resize(std::max(triangles, places_.size())); }
  /// Puts in a triangle that was never in or was taken out. Changes more than existing blocks of the first tier if `needs_whole_grid(box)`.
  void add(std::uint32_t f, const Box& box) {
    places_[f].set(box);
    settle(f, halves_of(box));
  }
  /// Takes triangle f out: no query finds it any more.
  void remove(std::uint32_t f) { places_[f].set(Box{}); }

  /// Calls visit(f) once for every triangle whose box overlaps `box`.
  template <class Visit>
  void for_overlapping(const Box& box, const Visit& visit) const {
    const Halves halves = halves_of(box);
    const Query query(box);
    if (blocks_for(halves, kSizes - 1).count() > static_cast<std::int64_t>(places_.size())) return visit_all(query, visit);
    for (std::size_t t = 0; t < tiers_.size(); ++t)
      if (!tiers_[t].blocks.empty()) visit_tier(static_cast<int>(t), halves.at_tier(static_cast<int>(t)), query, visit);
  }

 private:
  /// Sizes of cubes in a block: 4 × 4 × 4 of the smallest, 2 × 2 × 2 of twice that, and one.
  static constexpr int kSizes = 3;
  static constexpr std::uint32_t kSlotsPerBlock = 64 + 8 + 1;
  static constexpr std::array<std::uint32_t, kSizes> kFirstSlot = {0, 64, 72};
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  /// A box in halves of the smallest cube: a monotone function of its coordinates, on which all decisions about homes rest, so that rounding
  /// cannot make a query and a home disagree.
  struct Halves {
    Masks low, high;  // three coordinates
    [[nodiscard]] Halves at_tier(int tier) const { return {low >> kSizes * tier, high >> kSizes * tier}; }
  };
  /// A cube by its index and size (2^size smallest cubes), in one word.
  struct Home {
    std::uint64_t bits = 0;

    Home() = default;
    Home(int x, int y, int z, int size)
        : bits(std::uint64_t{static_cast<std::uint16_t>(x)} | std::uint64_t{static_cast<std::uint16_t>(y)} << 16 |
               std::uint64_t{static_cast<std::uint16_t>(z)} << 32 | static_cast<std::uint64_t>(size) << 48) {}
    [[nodiscard]] int cube(int axis) const { return static_cast<std::int16_t>(bits >> 16 * axis); }
    [[nodiscard]] int size() const { return static_cast<int>(bits >> 48); }
    bool operator==(const Home&) const = default;
  };
  struct BlockRange {
    int low[3], high[3];
    [[nodiscard]] std::int64_t count() const {
      return std::int64_t{high[0] - low[0] + 1} * (high[1] - low[1] + 1) * (high[2] - low[2] + 1);
    }
  };
  /// An entry that was added after the build, in a linked list by slot within its block.
  struct AddedEntry {
    std::uint32_t face;
    std::uint32_t next;
  };
  struct Block {
    std::uint64_t key = 0;
    std::array<std::uint64_t, 2> occupied{};  // a bit a slot
    std::vector<AddedEntry> added;
  };
  struct TableEntry {
    std::uint64_t key;
    std::uint32_t block;  // kNone: free
  };
  /// The blocks of one size.
  struct Tier {
    std::vector<Block> blocks;
    std::vector<TableEntry> table;  // open addressing, at most half full
    int table_shift = 0;
    int largest_size = 0;                   // of the cubes in use, 0 to kSizes − 1
    std::vector<std::uint32_t> begin;       // per slot of each block, into entries
    std::vector<std::uint32_t> entries;     // triangles, as built
    std::vector<std::uint32_t> added_head;  // per slot of each block, into the block's added entries

    [[nodiscard]] std::uint32_t find(std::uint64_t key) const;
    std::uint32_t find_or_add(std::uint64_t key);
    void put_into_table(std::uint64_t key, std::uint32_t block);
    void grow_table();
    /// Where in the table the search for a key begins: the upper bits of a product with 2⁶⁴/φ (Knuth's multiplicative hashing).
    [[nodiscard]] std::size_t table_slot(std::uint64_t key) const { return (key * 0x9E3779B97F4A7C15U) >> table_shift; }
  };
  /// Where a triangle is, and where it is listed: half a cache line.
  struct alignas(32) Place {
    float bounds[6] = {};  // the box's lower end, then its upper end negated, so that "overlaps" is "not larger" for all six
    Home home;

    Place() { set(Box{}); }
    void set(const Box& box) {
      for (int i = 0; i < 3; ++i) {
        bounds[i] = box.low[i];
        bounds[3 + i] = -box.high[i];
      }
    }
    [[nodiscard]] Box box() const { return {Floats{bounds[0], bounds[1], bounds[2], 0}, Floats{-bounds[3], -bounds[4], -bounds[5], 0}}; }
  };
  struct Query {
    explicit Query(const Box& box)
        : first{box.high[0], box.high[1], box.high[2], -box.low[0]}, last{box.high[2], -box.low[0], -box.low[1], -box.low[2]} {}
    /// The six numbers as two overlapping vectors of four.
    [[nodiscard]] bool overlaps(const Place& place) const {
      Floats first_four, last_four;
      std::memcpy(&first_four, &place.bounds[0], sizeof first_four);
      std::memcpy(&last_four, &place.bounds[2], sizeof last_four);
      return is_set_in_all((first_four <= first) & (last_four <= last));
    }
    Floats first, last;
  };

  /// Rounds down, nearly: by a shift to positive numbers, where the sum rounds first.
  [[nodiscard]] Masks half_indices(Floats x) const {
    const Floats clamped = smaller_of(larger_of(x * halves_per_unit_, in_all_lanes(-64000.0F)), in_all_lanes(64000.0F));
    return __builtin_convertvector(clamped + 65536.0F, Masks) - 65536;
  }
  [[nodiscard]] Halves halves_of(const Box& box) const { return {half_indices(box.low), half_indices(box.high)}; }

  // A box is in the loosened bounds of cube c of size 2^s when 2c − 1 ≤ low >> s and high >> s ≤ 2c + 2 (in halves, for each coordinate); so
  // the homes of what may overlap a box are the cubes from ((low >> s) − 1) >> 1 to ((high >> s) + 1) >> 1.
  static int first_cube(int low, int size) { return ((low >> size) - 1) >> 1; }
  static int last_cube(int high, int size) { return ((high >> size) + 1) >> 1; }
  static bool fits(Home home, const Halves& h) {
    const Masks twice = 2 * Masks{home.cube(0), home.cube(1), home.cube(2), 0};
    return is_set_in_all((twice - 1 <= h.low >> home.size()) & (h.high >> home.size() <= twice + 2));
  }
  /// The home that a box is given: the smallest cube that it fits around its middle.
  static Home home_for(const Halves& h) {
    const Masks middle = (h.low + h.high) >> 1;
    for (int size = 0;; ++size) {
      const Home home(middle[0] >> (size + 1), middle[1] >> (size + 1), middle[2] >> (size + 1), size);
      if (fits(home, h)) return home;
    }
  }
  static std::uint64_t key_of(int x, int y, int z) {
    return static_cast<std::uint64_t>(static_cast<std::uint16_t>(x)) << 32 |
           static_cast<std::uint64_t>(static_cast<std::uint16_t>(y)) << 16 | static_cast<std::uint64_t>(static_cast<std::uint16_t>(z));
  }
  static int tier_of(Home home) { return home.size() / kSizes; }
  static std::uint64_t block_key(Home home) {
    const int shift = kSizes - 1 - home.size() % kSizes;
    return key_of(home.cube(0) >> shift, home.cube(1) >> shift, home.cube(2) >> shift);
  }
  static std::uint32_t slot_of(Home home) {
    const int size = home.size() % kSizes, bits = kSizes - 1 - size, mask = (1 << bits) - 1;
    return kFirstSlot[static_cast<std::size_t>(size)] +
           static_cast<std::uint32_t>((home.cube(0) & mask) << 2 * bits | (home.cube(1) & mask) << bits | (home.cube(2) & mask));
  }
  /// The blocks with homes of what may overlap a box, for cubes of up to 2^size (in the tier's own halves).
  static BlockRange blocks_for(const Halves& h, int size) {
    BlockRange range{};
    for (int i = 0; i < 3; ++i) {
      range.low[i] = first_cube(h.low[i], size) >> (kSizes - 1 - size);
      range.high[i] = last_cube(h.high[i], size) >> (kSizes - 1 - size);
    }
    return range;
  }

  template <class Visit>
  void visit_all(const Query& query, const Visit& visit) const {
    for (std::uint32_t f = 0; f < places_.size(); ++f)
      if (query.overlaps(places_[f])) visit(f);
  }
  template <class Visit>
  void visit_tier(int t, const Halves& halves, const Query& query, const Visit& visit) const {
    const Tier& tier = tiers_[static_cast<std::size_t>(t)];
    const BlockRange range = blocks_for(halves, tier.largest_size);
    for (int x = range.low[0]; x <= range.high[0]; ++x) {
      for (int y = range.low[1]; y <= range.high[1]; ++y) {
        for (int z = range.low[2]; z <= range.high[2]; ++z) {
          const std::uint32_t block = tier.find(key_of(x, y, z));
          if (block != kNone) visit_block(t, block, {x, y, z}, halves, query, visit);
        }
      }
    }
  }
  template <class Visit>
  void visit_block(int t, std::uint32_t block, const std::array<int, 3>& place, const Halves& halves, const Query& query,
                   const Visit& visit) const {
    const Tier& tier = tiers_[static_cast<std::size_t>(t)];
    const std::array<std::uint64_t, 2>& occupied = tier.blocks[block].occupied;
    for (int size = 0; size <= tier.largest_size; ++size) {
      const int bits = kSizes - 1 - size, last = (1 << bits) - 1;
      int low[3], high[3];
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::max(first_cube(halves.low[i], size) - (place[i] << bits), 0);
        high[i] = std::min(last_cube(halves.high[i], size) - (place[i] << bits), last);
      }
      for (int x = low[0]; x <= high[0]; ++x) {
        for (int y = low[1]; y <= high[1]; ++y) {
          for (int z = low[2]; z <= high[2]; ++z) {
            const std::uint32_t slot =
                kFirstSlot[static_cast<std::size_t>(size)] + static_cast<std::uint32_t>(x << 2 * bits | y << bits | z);
            if ((occupied[slot >> 6] >> (slot & 63) & 1) == 0) continue;
            const Home home((place[0] << bits) + x, (place[1] << bits) + y, (place[2] << bits) + z, kSizes * t + size);
            visit_slot(tier, block, slot, home, query, visit);
          }
        }
      }
    }
  }
  template <class Visit>
  void visit_slot(const Tier& tier, std::uint32_t block, std::uint32_t slot, Home home, const Query& query, const Visit& visit) const {
    const auto try_face = [&](std::uint32_t f) {
      if (query.overlaps(places_[f]) && places_[f].home == home) visit(f);
    };
    const std::size_t i = std::size_t{block} * kSlotsPerBlock + slot;
    for (std::uint32_t k = tier.begin[i]; k < tier.begin[i + 1]; ++k) try_face(tier.entries[k]);
    const std::vector<AddedEntry>& added = tier.blocks[block].added;
    for (std::uint32_t k = tier.added_head[i]; k != kNone; k = added[k].next) try_face(added[k].face);
  }

  void choose_frame(const std::vector<Vec3>& points);
  void choose_cube_size();
  void build_lists();
  [[nodiscard]] bool has_block_for(Home home) const;
  void settle(std::uint32_t f, const Halves& halves);
  void list(std::uint32_t f, Home home);

  Vec3 origin_ = Vec3::Zero();
  float halves_per_unit_ = 1;
  float half_extent_ = 0;
  std::vector<Place> places_;  // per triangle
  std::vector<Tier> tiers_;
};

}  // namespace smopt
