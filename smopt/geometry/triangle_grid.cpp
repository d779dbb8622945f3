#include "smopt/geometry/triangle_grid.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "smopt/parallel.h"

namespace smopt {
namespace {

/// Edge of the smallest cube relative to the mean extent of a triangle's box. Smaller means more cubes to walk, larger more triangles to test.
constexpr float kCubePerExtent = 1.5F;
/// Cube indices are 16-bit: the whole space is at most this many cubes across to either side of the origin.
constexpr float kMaxCubeIndex = 31000.0F;
/// The hash table starts with room for this many blocks.
constexpr std::size_t kInitialTable = 1024;
/// Eight-fold sizes: 2^15 smallest cubes span the space, 2^(3·6) are more.
constexpr std::size_t kTiers = 6;

float largest_extent(const Box& box) {
  return std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
}

template <class Visit>
void for_all_in_parallel(std::uint32_t count, const Visit& visit) {
  for_ranges_in_parallel(count, [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) visit(i);
  });
}

}  // namespace

TriangleGrid::TriangleGrid(const std::vector<Vec3>& points, const std::vector<std::array<std::uint32_t, 3>>& triangles)
    : places_(triangles.size()), tiers_(kTiers) {
  choose_frame(points);
  const auto count = static_cast<std::uint32_t>(triangles.size());
  for_all_in_parallel(count, [&](std::uint32_t f) {
    const auto& [a, b, c] = triangles[f];
    places_[f].set(box_of(points[a], points[b], points[c]));
  });
  choose_cube_size();
  for_all_in_parallel(count, [&](std::uint32_t f) { places_[f].home = home_for(halves_of(box(f))); });
  build_lists();
}

void TriangleGrid::choose_frame(const std::vector<Vec3>& points) {
  if (points.empty()) return;
  Vec3 low = points.front(), high = points.front();
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  origin_ = 0.5 * (low + high);
  half_extent_ = static_cast<float>((0.5 * (high - low)).maxCoeff());
}

void TriangleGrid::choose_cube_size() {
  double sum = 0;
  for (std::uint32_t f = 0; f < places_.size(); ++f) sum += largest_extent(box(f));
  const auto mean = static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(places_.size(), 1)));
  const float cube = std::max({kCubePerExtent * mean, half_extent_ / kMaxCubeIndex, std::numeric_limits<float>::min() * 16});
  halves_per_unit_ = 2 / cube;
}

void TriangleGrid::build_lists() {
  const auto count = static_cast<std::uint32_t>(places_.size());
  for (std::uint32_t f = 0; f < count; ++f) {
    Tier& tier = tiers_[static_cast<std::size_t>(tier_of(places_[f].home))];
    const std::uint32_t slot = slot_of(places_[f].home);
    tier.blocks[tier.find_or_add(block_key(places_[f].home))].occupied[slot >> 6] |= std::uint64_t{1} << (slot & 63);
    tier.largest_size = std::max(tier.largest_size, places_[f].home.size() % kSizes);
  }
  // Counted and filled by all threads at once; the order within a cube is any, and no decision depends on it.
  const auto slot_in_tier = [&](const Tier& tier, std::uint32_t f) {
    return std::size_t{tier.find(block_key(places_[f].home))} * kSlotsPerBlock + slot_of(places_[f].home);
  };
  std::vector<std::vector<std::uint32_t>> next(kTiers);
  for (std::size_t t = 0; t < kTiers; ++t) next[t].assign(tiers_[t].blocks.size() * kSlotsPerBlock, 0);
  const auto take_number = [&](std::size_t t, std::size_t slot) {
    return std::atomic_ref(next[t][slot]).fetch_add(1, std::memory_order_relaxed);
  };
  for_all_in_parallel(count, [&](std::uint32_t f) {
    const auto t = static_cast<std::size_t>(tier_of(places_[f].home));
    take_number(t, slot_in_tier(tiers_[t], f));
  });
  for (std::size_t t = 0; t < kTiers; ++t) {
    Tier& tier = tiers_[t];
    tier.begin.assign(next[t].size() + 1, 0);
    for (std::size_t i = 0; i < next[t].size(); ++i) tier.begin[i + 1] = tier.begin[i] + std::exchange(next[t][i], tier.begin[i]);
    tier.entries.resize(tier.begin.back());
    tier.added_head.assign(next[t].size(), kNone);
  }
  for_all_in_parallel(count, [&](std::uint32_t f) {
    const auto t = static_cast<std::size_t>(tier_of(places_[f].home));
    tiers_[t].entries[take_number(t, slot_in_tier(tiers_[t], f))] = f;
  });
}

bool TriangleGrid::has_block_for(Home home) const {
  return home.size() < kSizes && home.size() <= tiers_.front().largest_size && tiers_.front().find(block_key(home)) != kNone;
}

void TriangleGrid::settle(std::uint32_t f, const Halves& halves) {
  places_[f].home = home_for(halves);
  list(f, places_[f].home);
}

void TriangleGrid::list(std::uint32_t f, Home home) {
  Tier& tier = tiers_[static_cast<std::size_t>(tier_of(home))];
  if (home.size() % kSizes > tier.largest_size) tier.largest_size = home.size() % kSizes;
  const std::uint32_t block = tier.find_or_add(block_key(home));
  const std::uint32_t slot = slot_of(home);
  const std::size_t i = std::size_t{block} * kSlotsPerBlock + slot;
  if (i >= tier.added_head.size()) {
    tier.added_head.resize(tier.blocks.size() * kSlotsPerBlock, kNone);
    tier.begin.resize(tier.blocks.size() * kSlotsPerBlock + 1, static_cast<std::uint32_t>(tier.entries.size()));
  }
  // It may have been at home here before: then its old entry is good again.
  std::vector<AddedEntry>& added = tier.blocks[block].added;
  const auto first = tier.entries.begin() + tier.begin[i], last = tier.entries.begin() + tier.begin[i + 1];
  if (std::find(first, last, f) != last) return;
  for (std::uint32_t k = tier.added_head[i]; k != kNone; k = added[k].next)
    if (added[k].face == f) return;
  added.push_back({f, tier.added_head[i]});
  tier.added_head[i] = static_cast<std::uint32_t>(added.size() - 1);
  tier.blocks[block].occupied[slot >> 6] |= std::uint64_t{1} << (slot & 63);
}

std::uint32_t TriangleGrid::Tier::find(std::uint64_t key) const {
  if (table.empty()) return kNone;
  for (std::size_t slot = table_slot(key);; slot = slot + 1 < table.size() ? slot + 1 : 0) {
    if (table[slot].block == kNone) return kNone;
    if (table[slot].key == key) return table[slot].block;
  }
}

std::uint32_t TriangleGrid::Tier::find_or_add(std::uint64_t key) {
  if (!blocks.empty() && blocks.back().key == key) return static_cast<std::uint32_t>(blocks.size() - 1);
  const std::uint32_t known = find(key);
  if (known != kNone) return known;
  const auto block = static_cast<std::uint32_t>(blocks.size());
  blocks.push_back({key, {}, {}});
  if (2 * blocks.size() > table.size())
    grow_table();
  else
    put_into_table(key, block);
  return block;
}

void TriangleGrid::Tier::put_into_table(std::uint64_t key, std::uint32_t block) {
  std::size_t slot = table_slot(key);
  while (table[slot].block != kNone) slot = slot + 1 < table.size() ? slot + 1 : 0;
  table[slot] = {key, block};
}

void TriangleGrid::Tier::grow_table() {
  table.assign(2 * std::max(table.size(), kInitialTable / 2), {0, kNone});
  table_shift = 64 - std::countr_zero(table.size());
  for (std::uint32_t block = 0; block < blocks.size(); ++block) put_into_table(blocks[block].key, block);
}

}  // namespace smopt
