#include "smopt/surface/face_links.h"

#include <cmath>

namespace smopt {
namespace {

/// Whether a·b >= c·d, exactly: a rounded product is monotonic, so only equal rounded products need their errors (short of
/// underflow).
bool product_not_less(double a, double b, double c, double d) {
  const double ab = a * b;
  const double cd = c * d;
  if (ab != cd) return ab > cd;
  return std::fma(a, b, -ab) >= std::fma(c, d, -cd);
}

using Signs = std::array<bool, 4>;

bool alternate(const Signs& inside) {
  return inside[0] != inside[1] && inside[0] == inside[2] && inside[1] == inside[3];
}

/// The saddle's value is (v0·v2 − v1·v3) / (v0 + v2 − v1 − v3); the denominator is positive when corners 0 and 2 are inside.
bool inside_is_joined(const std::array<double, 4>& v, const Signs& inside) {
  const int first = inside[0] ? 0 : 1;
  return product_not_less(v[first], v[first + 2], v[1 - first], v[3 - first]);
}

/// Side i enters the inside: the piece that starts there ends where the inside is left again, or, around an outside corner, at the side
/// before.
int exit_of(const Signs& inside, int i, bool is_joined) {
  if (is_joined) return (i + 3) % 4;
  int j = (i + 1) % 4;
  while (inside[(j + 1) % 4]) j = (j + 1) % 4;
  return j;
}

}  // namespace

FaceLinks link_face(const std::array<double, 4>& values) {
  FaceLinks links;
  Signs inside;
  for (int i = 0; i < 4; ++i) inside[i] = is_inside(values[i]);
  links.is_ambiguous = alternate(inside);
  links.is_joined = links.is_ambiguous && inside_is_joined(values, inside);
  for (int i = 0; i < 4; ++i) {
    if (!inside[i] && inside[(i + 1) % 4]) links.exit_of[i] = static_cast<std::int8_t>(exit_of(inside, i, links.is_joined));
  }
  return links;
}

}  // namespace smopt
