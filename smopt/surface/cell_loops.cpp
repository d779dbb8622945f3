#include "smopt/surface/cell_loops.h"

#include <cmath>

namespace smopt {
namespace {

constexpr std::uint8_t kNone = 0xff;

/// Whether a·b >= c·d, exactly: a rounded product is monotonic, so only equal rounded products need their errors (short of
/// underflow).
bool product_not_less(double a, double b, double c, double d) {
  const double ab = a * b;
  const double cd = c * d;
  if (ab != cd) return ab > cd;
  return std::fma(a, b, -ab) >= std::fma(c, d, -cd);
}

/// Sorts the pieces of the level set on the cube's faces into loops.
class LoopTracer {
 public:
  explicit LoopTracer(const cube::CornerValues& values) : values_(values) { next_.fill(kNone); }

  CellLoops run() {
    for (int face = 0; face < cube::kFaces; ++face) link_crossings(face);
    for (int edge = 0; edge < cube::kEdges; ++edge) {
      if (next_[edge] != kNone) follow_loop(edge);
    }
    return loops_;
  }

 private:
  [[nodiscard]] bool inside(int corner) const { return is_inside(values_[corner]); }

  [[nodiscard]] bool is_ambiguous(const std::array<int, 4>& q) const {
    return inside(q[0]) != inside(q[1]) && inside(q[0]) == inside(q[2]) && inside(q[1]) == inside(q[3]);
  }

  /// The saddle's value is (v0·v2 − v1·v3) / (v0 + v2 − v1 − v3); the denominator is positive when corners 0 and 2 are inside.
  [[nodiscard]] bool inside_is_joined(const std::array<int, 4>& q) const {
    const int first = inside(q[0]) ? 0 : 1;
    return product_not_less(values_[q[first]], values_[q[first + 2]], values_[q[1 - first]], values_[q[3 - first]]);
  }

  void link_crossings(int face) {
    static constexpr auto kCorners = [] {
      std::array<std::array<int, 4>, cube::kFaces> corners{};
      for (int f = 0; f < cube::kFaces; ++f) corners[f] = cube::corners_of_face(f);
      return corners;
    }();
    const std::array<int, 4>& q = kCorners[face];
    bool joined = false;
    if (is_ambiguous(q)) {
      joined = inside_is_joined(q);
      loops_.ambiguous_faces |= 1U << face;
      if (joined) loops_.joined_faces |= 1U << face;
    }
    for (int i = 0; i < 4; ++i) {
      if (!inside(q[i]) && inside(q[(i + 1) % 4])) link_entry(q, i, joined);
    }
  }

  /// Side i of the face enters the inside: the piece that starts there ends where the inside is left again, or, around an outside
  /// corner, at the side before.
  void link_entry(const std::array<int, 4>& q, int i, bool joined) {
    int j = (i + 1) % 4;
    while (inside(q[(j + 1) % 4])) j = (j + 1) % 4;
    if (joined) j = (i + 3) % 4;
    next_[cube::edge_between(q[i], q[(i + 1) % 4])] = static_cast<std::uint8_t>(cube::edge_between(q[j], q[(j + 1) % 4]));
  }

  void follow_loop(int edge) {
    std::uint8_t at = loops_.begin[loops_.count];
    while (next_[edge] != kNone) {
      loops_.edges[at++] = static_cast<std::uint8_t>(edge);
      const int following = next_[edge];
      next_[edge] = kNone;
      edge = following;
    }
    loops_.begin[++loops_.count] = at;
  }

  const cube::CornerValues& values_;
  std::array<std::uint8_t, cube::kEdges> next_;
  CellLoops loops_;
};

}  // namespace

CellLoops trace_cell_loops(const cube::CornerValues& values) {
  return LoopTracer(values).run();
}

}  // namespace smopt
