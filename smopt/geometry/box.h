#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "smopt/geometry/lanes.h"
#include "smopt/geometry/vec3.h"

namespace smopt {

/// An axis-aligned box in single precision whose bounds are rounded outwards, so that it contains what it was made from.
struct Box {
  float low[3] = {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity()};
  float high[3] = {-std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                   -std::numeric_limits<float>::infinity()};

  [[nodiscard]] bool overlaps(const Box& other) const {
    // Bitwise and: six comparisons without a branch.
    return static_cast<bool>((low[0] <= other.high[0]) & (low[1] <= other.high[1]) & (low[2] <= other.high[2]) & (other.low[0] <= high[0]) &
                             (other.low[1] <= high[1]) & (other.low[2] <= high[2]));
  }
  [[nodiscard]] bool contains(const Box& other) const {
    return static_cast<bool>((low[0] <= other.low[0]) & (low[1] <= other.low[1]) & (low[2] <= other.low[2]) & (other.high[0] <= high[0]) &
                             (other.high[1] <= high[1]) & (other.high[2] <= high[2]));
  }
  /// Grows to contain another box too.
  void unite(const Box& other) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], other.low[i]);
      high[i] = std::max(high[i], other.high[i]);
    }
  }
};

/// Below (above) the double that was converted: converting rounds to nearest, so one relative step of 2⁻²³ outwards is enough.
inline Floats rounded_down(Floats converted) {
  return converted - absolute(converted) * 1.2e-7F - std::numeric_limits<float>::min();
}
inline Floats rounded_up(Floats converted) {
  return converted + absolute(converted) * 1.2e-7F + std::numeric_limits<float>::min();
}
inline float rounded_down(double x) {
  return rounded_down(in_all_lanes(static_cast<float>(x)))[0];
}
inline float rounded_up(double x) {
  return rounded_up(in_all_lanes(static_cast<float>(x)))[0];
}

/// The outward-rounded box of the double-precision bounds.
inline Box make_box(const Vec3& low, const Vec3& high) {
  const Floats down = rounded_down(Floats{static_cast<float>(low[0]), static_cast<float>(low[1]), static_cast<float>(low[2]), 0.0F});
  const Floats up = rounded_up(Floats{static_cast<float>(high[0]), static_cast<float>(high[1]), static_cast<float>(high[2]), 0.0F});
  return {{down[0], down[1], down[2]}, {up[0], up[1], up[2]}};
}

inline Box triangle_box(const Vec3& a, const Vec3& b, const Vec3& c) {
  return make_box(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c));
}

}  // namespace smopt
