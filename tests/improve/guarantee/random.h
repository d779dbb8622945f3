#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "smopt/geometry/vec3.h"

namespace smopt::testing {

/// Random numbers of one seed, in the words of the mesh makers.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  /// 10 to an exponent that is uniform in [low, high].
  double power_of_ten(double low, double high) { return std::pow(10, uniform(low, high)); }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  bool coin() { return integer(0, 1) == 1; }
  std::uint32_t seed() { return static_cast<std::uint32_t>(engine_()); }

  /// Uniform in the ball around the origin.
  Vec3 in_ball(double radius) {
    for (;;) {
      const Vec3 p(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (p.squaredNorm() <= 1) return radius * p;
    }
  }
  /// Of length 1.
  Vec3 direction() {
    for (;;) {
      const Vec3 p = in_ball(1);
      if (p.squaredNorm() > 0.01) return p.normalized();
    }
  }

 private:
  std::mt19937 engine_;
};

}  // namespace smopt::testing
