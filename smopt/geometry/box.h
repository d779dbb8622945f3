#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "smopt/geometry/lanes.h"
#include "smopt/geometry/vec3.h"

namespace smopt {

/// An axis-aligned box in single precision whose bounds are rounded outwards, so that it contains what it was made from. The fourth lane of both
/// bounds is about 0 and says nothing.
struct Box {
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  Floats low = {kInfinity, kInfinity, kInfinity, 0};
  Floats high = {-kInfinity, -kInfinity, -kInfinity, 0};

  [[nodiscard]] bool overlaps(const Box& other) const { return is_set_in_all((low <= other.high) & (other.low <= high)); }
  [[nodiscard]] bool contains(const Box& other) const { return is_set_in_all((low <= other.low) & (other.high <= high)); }
  /// Grows to contain another box too.
  void unite(const Box& other) {
    low = smaller_of(low, other.low);
    high = larger_of(high, other.high);
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

/// The outward-rounded box of a point.
inline Box point_box(const Vec3& p) {
  const Floats converted{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), 0};
  return {rounded_down(converted), rounded_up(converted)};
}

/// The outward-rounded box of the double-precision bounds.
inline Box make_box(const Vec3& low, const Vec3& high) {
  return {point_box(low).low, point_box(high).high};
}

inline Box united(Box a, const Box& b) {
  a.unite(b);
  return a;
}

inline Box triangle_box(const Vec3& a, const Vec3& b, const Vec3& c) {
  return united(united(point_box(a), point_box(b)), point_box(c));
}

}  // namespace smopt
