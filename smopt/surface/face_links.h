#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace smopt {

/// Whether a value relative to the level counts as inside: the level itself does.
inline bool is_inside(double value) {
  return value >= 0;
}

/// Whether corner values have both signs: then the level set crosses their cell.
template <class Values>
bool is_crossed(const Values& values) {
  return std::any_of(values.begin(), values.end(), [&](double v) { return is_inside(v) != is_inside(values[0]); });
}

/// How the level set of zero runs on a square with bilinear values, whose corners are numbered anticlockwise; side i runs from corner i to
/// corner i + 1.
struct FaceLinks {
  static constexpr std::int8_t kNone = -1;

  std::array<std::int8_t, 4> exit_of = {kNone, kNone, kNone, kNone};  ///< of the piece that starts on side i: the side on which it ends
  bool is_ambiguous = false;                                          ///< the corners alternate in sign
  bool is_joined = false;                                             ///< the square is ambiguous, and its two inside corners are joined
};

/// A piece starts on a side that enters the inside and ends on one that leaves it. Where the corners alternate in sign, the asymptotic
/// decider (Nielson & Hamann 1991) says which belong together: the inside ones when the saddle's value is not negative. The comparison is
/// exact, and the same seen from both sides of the square.
FaceLinks link_face(const std::array<double, 4>& values);

}  // namespace smopt
