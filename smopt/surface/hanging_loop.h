#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "smopt/surface/cube.h"

namespace smopt {

/// Points at which the level set crosses the edges on the boundary of a cube some of whose faces are cut in four: 0 to 11 are those on the
/// cube's edges; 12 + 4·face + side is the one on the line from the middle of a face's side to the centre of the face, sides as in
/// `cube::corners_of_face`.
namespace hanging {

inline constexpr int kPoints = cube::kEdges + 4 * cube::kFaces;

inline constexpr int inner_point(int face, int side) {
  return cube::kEdges + 4 * face + side;
}

/// The faces of the cube on which a point lies, as bits.
inline constexpr unsigned faces_of_point(int point) {
  return point < cube::kEdges ? cube::faces_of_edge(point) : 1U << ((point - cube::kEdges) / 4);
}

/// The values at the middle of a face's sides, and at its centre: bilinear.
struct FaceValues {
  std::array<double, 4> corners;
  std::array<double, 4> middles;  ///< of the side from corner i to corner i + 1
  double centre = 0;
};

FaceValues values_on_face(const cube::CornerValues& values, int face);

}  // namespace hanging

/// Traces the level set of zero around a cube whose faces in `split_faces` (bits) are cut in four, as smaller neighbours have them.
/// \return the points of its one loop, anticlockwise seen from the side of smaller values; nothing when there are several loops, or a face or
/// a quarter of one is ambiguous: then what is inside the cube is not told by the loop alone.
std::optional<std::vector<std::uint8_t>> trace_hanging_loop(const cube::CornerValues& values, unsigned split_faces);

}  // namespace smopt
