#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "smopt/geometry/vec3.h"

namespace smopt {

/// The Gaussian kernel of one atom.
struct Kernel {
  Vec3 center;       ///< ångström
  double amplitude;  ///< its value at the centre
  double reach;      ///< ångström; the distance at which it has fallen to the least term that counts
};

/// Kernels sorted into rows along x, each of a square of the largest reach in y and z, so that those near a place are found quickly.
/// Takes memory for kernels only, however large the box around them is. Immutable: any number of threads may ask at once.
class KernelRows {
 public:
  KernelRows() = default;
  /// Cost: O(n·log n).
  explicit KernelRows(const std::vector<Kernel>& kernels);

  /// In the order in which they are visited: row after row (z, then y), by x in a row, and at one x in the order of the constructor.
  [[nodiscard]] const std::vector<Kernel>& kernels() const { return kernels_; }
  [[nodiscard]] double largest_reach() const { return largest_reach_; }

  /// Visits all kernels that reach the box, taken as cylinders along x with their reach for radius and half length, and some others.
  /// `visit` returns whether to go on.
  template <class Visit>
  void visit_near_box(const Vec3& low, const Vec3& high, const Visit& visit) const {
    visit_rows(low, high, [&](const Row& row, double) { return visit_range(row, low.x() - around_, high.x() + around_, visit); });
  }

  /// Visits all kernels that reach the point, taken as balls, and some others. `visit` returns whether to go on.
  template <class Visit>
  void visit_near_point(const Vec3& x, const Visit& visit) const {
    visit_rows(x, x, [&](const Row& row, double squared_half_length) {
      const double half_length = std::sqrt(squared_half_length);
      return visit_range(row, x.x() - half_length, x.x() + half_length, visit);
    });
  }

 private:
  struct Row {
    std::array<double, 2> low;  ///< of the centres in y and z
    std::array<double, 2> high;
    std::uint64_t square;  ///< its number
    std::uint32_t begin;   ///< in kernels_
    std::uint32_t end;
  };
  using Squares = std::array<std::int64_t, 2>;  ///< places in y and z

  static constexpr int kPlaceBits = 21;
  static constexpr std::int64_t kMostPlaces = std::int64_t{1} << kPlaceBits;
  static constexpr std::uint32_t kNoRow = 0xffffffff;

  [[nodiscard]] Squares place_of(double y, double z) const;
  [[nodiscard]] static std::uint64_t number_of(std::int64_t y, std::int64_t z) { return static_cast<std::uint64_t>(z << kPlaceBits | y); }
  [[nodiscard]] std::size_t slot_of(std::uint64_t square) const {
    constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;  // Fibonacci hashing (Knuth 1973, section 6.4)
    return (square * kGolden) >> hash_shift_;
  }
  void sort_into_rows(const std::vector<Kernel>& kernels);
  void find_rows(const std::vector<std::uint64_t>& squares);
  void index_rows();

  [[nodiscard]] const Row* row_at(std::uint64_t square) const {
    for (std::size_t slot = slot_of(square);; slot = (slot + 1) & (slots_.size() - 1)) {
      if (slots_[slot] == kNoRow) return nullptr;
      if (rows_[slots_[slot]].square == square) return &rows_[slots_[slot]];
    }
  }

  /// Squared half length of what a cylinder or ball around the row leaves for x, negative when the box is out of reach.
  [[nodiscard]] double squared_rest(const Row& row, const Vec3& low, const Vec3& high) const {
    const double y = std::max({0.0, row.low[0] - high.y(), low.y() - row.high[0]});
    const double z = std::max({0.0, row.low[1] - high.z(), low.z() - row.high[1]});
    return around_ * around_ - y * y - z * z;
  }

  template <class VisitRow>
  void visit_rows(const Vec3& low, const Vec3& high, const VisitRow& visit_row) const {
    const Squares first = place_of(low.y() - around_, low.z() - around_);
    const Squares last = place_of(high.y() + around_, high.z() + around_);
    const auto enter = [&](const Row& row) {
      const double rest = squared_rest(row, low, high);
      return rest < 0 || visit_row(row, rest);
    };
    if (static_cast<std::size_t>((last[0] - first[0] + 1) * (last[1] - first[1] + 1)) > rows_.size()) {
      for (const Row& row : rows_)
        if (!enter(row)) return;
      return;
    }
    for (std::int64_t z = first[1]; z <= last[1]; ++z) {
      for (std::int64_t y = first[0]; y <= last[0]; ++y) {
        const Row* row = row_at(number_of(y, z));
        if (row && !enter(*row)) return;
      }
    }
  }

  template <class Visit>
  bool visit_range(const Row& row, double low, double high, const Visit& visit) const {
    const Kernel* const end = kernels_.data() + row.end;
    const Kernel* kernel = kernels_.data() + row.begin;
    for (std::size_t left = row.end - row.begin; left > 0;) {  // a binary search without branches to mispredict
      const std::size_t half = (left + 1) / 2;
      kernel += kernel[half - 1].center.x() < low ? half : 0;
      left -= half;
    }
    for (; kernel != end && kernel->center.x() <= high; ++kernel)
      if (!visit(*kernel)) return false;
    return true;
  }

  double largest_reach_ = 0;
  double around_ = 0;               // the largest reach and a little more
  double edge_ = 1;                 // of the squares
  std::array<double, 2> corner_{};  // where the squares begin
  int hash_shift_ = 63;
  std::vector<Kernel> kernels_;
  std::vector<Row> rows_;             // ascending by square
  std::vector<std::uint32_t> slots_;  // open addressing: row or kNoRow
};

}  // namespace smopt
