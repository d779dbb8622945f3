#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace smopt {

/// Numbers for keys of a few 32-bit integers (places, grid edges), by open addressing: what a general map does, without its allocations.
/// Keys are never removed; numbers are not negative.
template <std::size_t kIntegers>
class PlaceMap {
 public:
  using Key = std::array<std::int32_t, kIntegers>;
  static constexpr std::int32_t kNone = -1;

  [[nodiscard]] std::size_t size() const { return size_; }

  [[nodiscard]] std::int32_t find(const Key& key) const {
    if (entries_.empty()) return kNone;
    return entries_[slot_of(key)].number;
  }

  /// The number that the key has already, or `number`, which it has from now on.
  std::int32_t find_or_add(const Key& key, std::int32_t number) {
    if (2 * (size_ + 1) > entries_.size()) grow();
    Entry& entry = entries_[slot_of(key)];
    if (entry.number == kNone) {
      entry = {key, number};
      ++size_;
    }
    return entry.number;
  }

  /// Visits (key, number) in an order that depends on the keys alone as long as they are added in one order.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Entry& entry : entries_) {
      if (entry.number != kNone) visit(entry.key, entry.number);
    }
  }

 private:
  struct Entry {
    Key key{};
    std::int32_t number = kNone;
  };
  static constexpr std::size_t kFewestSlots = 64;

  /// Where the key is, or the free slot where it belongs.
  [[nodiscard]] std::size_t slot_of(const Key& key) const {
    const std::size_t mask = entries_.size() - 1;
    std::size_t slot = hash(key) & mask;
    while (entries_[slot].number != kNone && !are_equal(entries_[slot].key, key)) slot = (slot + 1) & mask;
    return slot;
  }

  /// Without a call for a dozen bytes.
  static bool are_equal(const Key& a, const Key& b) {
    std::int32_t difference = 0;
    for (std::size_t i = 0; i < kIntegers; ++i) difference |= a[i] ^ b[i];
    return difference == 0;
  }

  /// Multiplies by 2⁶⁴ over the golden ratio, which spreads neighbours.
  static std::size_t hash(const Key& key) {
    std::uint64_t h = 0;
    for (const std::int32_t part : key) {
      h = (h ^ static_cast<std::uint32_t>(part)) * 0x9E3779B97F4A7C15U;
      h ^= h >> 32U;
    }
    return h;
  }

  void grow() {
    std::vector<Entry> old = std::move(entries_);
    entries_.assign(old.empty() ? kFewestSlots : 2 * old.size(), Entry{});
    for (const Entry& entry : old) {
      if (entry.number != kNone) entries_[slot_of(entry.key)] = entry;
    }
  }

  std::vector<Entry> entries_;
  std::size_t size_ = 0;
};

}  // namespace smopt
