#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "smopt/geometry/vec3.h"

namespace smopt::testing {

/// The sanitizers make rational arithmetic, which allocates all the time, ten times slower: they get one case of this many.
#ifdef __SANITIZE_ADDRESS__
inline constexpr int kThinning = 6;
#else
inline constexpr int kThinning = 1;
#endif

/// Points among which degenerate and nearly degenerate positions are frequent: the nodes of a small lattice, which may be fine or coarse,
/// far from the origin, turned out of the axes (then coplanar only up to rounding) or shaken by single roundings.
class LatticePoints {
 public:
  struct Kind {
    const char* name;
    int nodes;       ///< per axis
    double spacing;  ///< Å
    double offset;   ///< of all coordinates, Å
    bool is_turned;
    bool is_shaken;
  };

  LatticePoints(const Kind& kind, std::uint32_t seed) : kind_(kind), random_(seed) {
    if (kind.is_turned) rotation_ = Eigen::AngleAxisd(0.7, Vec3(1, 2, -3).normalized()).toRotationMatrix();
  }

  Vec3 operator()() {
    Vec3 p;
    for (double& x : p) x = kind_.spacing * static_cast<double>(random_() % static_cast<unsigned>(kind_.nodes));
    p = rotation_ * p + Vec3::Constant(kind_.offset);
    if (kind_.is_shaken)
      for (double& x : p) x = shaken(x);
    return p;
  }

  std::mt19937& random() { return random_; }

 private:
  double shaken(double x) {
    const unsigned which = random_() % 4;
    return which == 0 ? std::nextafter(x, HUGE_VAL) : (which == 1 ? std::nextafter(x, -HUGE_VAL) : x);
  }

  Kind kind_;
  std::mt19937 random_;
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
};

inline const std::vector<LatticePoints::Kind>& lattice_kinds() {
  static const std::vector<LatticePoints::Kind> kinds = {
      {"small", 3, 1.0, 0.0, false, false},      {"wide", 6, 1.0, 0.0, false, false},
      {"millionth", 4, 1e-6, 0.0, false, false}, {"million", 4, 1e6, -2e6, false, false},
      {"far", 4, 0.1, 1e6, false, false},        {"far and fine", 4, 1e-6, 1e6, false, false},
      {"turned", 4, 0.3, 0.0, true, false},      {"turned and far", 4, 0.3, 1e6, true, false},
      {"shaken", 3, 1.0, 0.0, false, true},      {"shaken and turned", 4, 0.7, 12.0, true, true},
  };
  return kinds;
}

}  // namespace smopt::testing
