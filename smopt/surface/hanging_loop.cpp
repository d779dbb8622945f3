#include "smopt/surface/hanging_loop.h"

#include <array>

#include "smopt/surface/face_links.h"

namespace smopt {
namespace hanging {

FaceValues values_on_face(const cube::CornerValues& values, int face) {
  const std::array<int, 4> q = cube::corners_of_face(face);
  FaceValues on_face;
  for (std::size_t i = 0; i < 4; ++i) {
    on_face.corners[i] = values[static_cast<std::size_t>(q[i])];
    on_face.middles[i] = 0.5 * (values[static_cast<std::size_t>(q[i])] + values[static_cast<std::size_t>(q[(i + 1) % 4])]);
  }
  // The same order of sums from both sides of the face: along the first of its axes, then along the second.
  const int lowest = q[0] & q[1] & q[2] & q[3];
  const int u = face / 2 == 0 ? 2 : 1;
  const int v = face / 2 == 2 ? 2 : 4;
  const auto at = [&](int corner) { return values[static_cast<std::size_t>(corner)]; };
  on_face.centre = 0.25 * ((at(lowest) + at(lowest | u)) + (at(lowest | v) + at(lowest | u | v)));
  return on_face;
}

}  // namespace hanging

namespace {

/// One square on the cube's boundary: values at its corners, and the point on each side that may be crossed.
struct Square {
  std::array<double, 4> values;
  std::array<int, 4> points;
};

class HangingLoopTracer {
 public:
  explicit HangingLoopTracer(const cube::CornerValues& values) : values_(values) { next_.fill(kNone); }

  std::optional<std::vector<std::uint8_t>> run(unsigned split_faces) {
    for (int face = 0; face < cube::kFaces; ++face) {
      if ((split_faces >> face & 1U) != 0) {
        link_quarters(face);
      } else {
        link({hanging::values_on_face(values_, face).corners, edges_of(face)});
      }
    }
    if (is_ambiguous_) return std::nullopt;
    return the_only_loop();
  }

 private:
  static constexpr int kNone = -1;

  static std::array<int, 4> edges_of(int face) {
    const std::array<int, 4> q = cube::corners_of_face(face);
    return {cube::edge_between(q[0], q[1]), cube::edge_between(q[1], q[2]), cube::edge_between(q[2], q[3]), cube::edge_between(q[3], q[0])};
  }

  /// Quarter i has the corners: corner i, the middle of side i, the centre, the middle of the side before.
  void link_quarters(int face) {
    const hanging::FaceValues f = hanging::values_on_face(values_, face);
    const std::array<int, 4> edges = edges_of(face);
    for (int i = 0; i < 4; ++i) {
      const int before = (i + 3) % 4;
      link({{f.corners[i], f.middles[i], f.centre, f.middles[before]},
            {edges[i], hanging::inner_point(face, i), hanging::inner_point(face, before), edges[before]}});
    }
  }

  void link(const Square& square) {
    const FaceLinks links = link_face(square.values);
    is_ambiguous_ = is_ambiguous_ || links.is_ambiguous;
    for (std::size_t i = 0; i < 4; ++i) {
      if (links.exit_of[i] != FaceLinks::kNone)
        next_[static_cast<std::size_t>(square.points[i])] = square.points[static_cast<std::size_t>(links.exit_of[i])];
    }
  }

  std::optional<std::vector<std::uint8_t>> the_only_loop() {
    std::vector<std::uint8_t> loop;
    int point = first_linked();
    while (point != kNone && next_[static_cast<std::size_t>(point)] != kNone) {
      loop.push_back(static_cast<std::uint8_t>(point));
      const int following = next_[static_cast<std::size_t>(point)];
      next_[static_cast<std::size_t>(point)] = kNone;
      point = following;
    }
    if (loop.empty() || first_linked() != kNone) return std::nullopt;
    return loop;
  }

  [[nodiscard]] int first_linked() const {
    for (int point = 0; point < hanging::kPoints; ++point) {
      if (next_[static_cast<std::size_t>(point)] != kNone) return point;
    }
    return kNone;
  }

  const cube::CornerValues& values_;
  std::array<int, hanging::kPoints> next_{};
  bool is_ambiguous_ = false;
};

}  // namespace

std::optional<std::vector<std::uint8_t>> trace_hanging_loop(const cube::CornerValues& values, unsigned split_faces) {
  return HangingLoopTracer(values).run(split_faces);
}

}  // namespace smopt
