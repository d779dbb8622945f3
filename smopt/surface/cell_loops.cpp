#include "smopt/surface/cell_loops.h"

namespace smopt {
namespace {

constexpr std::uint8_t kNone = 0xff;

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
  void link_crossings(int face) {
    static constexpr auto kCorners = [] {
      std::array<std::array<int, 4>, cube::kFaces> corners{};
      for (int f = 0; f < cube::kFaces; ++f) corners[f] = cube::corners_of_face(f);
      return corners;
    }();
    const std::array<int, 4>& q = kCorners[face];
    const FaceLinks links = link_face({values_[q[0]], values_[q[1]], values_[q[2]], values_[q[3]]});
    loops_.ambiguous_faces |= unsigned{links.is_ambiguous} << face;
    loops_.joined_faces |= unsigned{links.is_joined} << face;
    for (int i = 0; i < 4; ++i) {
      if (links.exit_of[i] != FaceLinks::kNone) next_[edge_of_side(q, i)] = edge_of_side(q, links.exit_of[i]);
    }
  }

  static std::uint8_t edge_of_side(const std::array<int, 4>& q, int side) {
    return static_cast<std::uint8_t>(cube::edge_between(q[side], q[(side + 1) % 4]));
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
