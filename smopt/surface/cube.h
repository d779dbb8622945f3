#pragma once

#include <array>
#include <cstdint>

/// Numbering of a cube's corners, edges and faces, and which belongs to which.
///
/// Corner: bit a of its number is its place (0 low, 1 high) on axis a (x, y, z).
/// Edge: 4·axis + k, parallel to `axis`; with u and v the axes that follow it cyclically, bit 0 of k is its place on u, bit 1 on v.
/// Face: 2·axis + side, perpendicular to `axis`.
namespace smopt::cube {

inline constexpr int kCorners = 8;
inline constexpr int kEdges = 12;
inline constexpr int kFaces = 6;

/// One value for each corner.
using CornerValues = std::array<double, kCorners>;

inline constexpr int axis_of_edge(int edge) {
  return edge / 4;
}

/// The edge's end that is low on its axis.
inline constexpr int low_corner(int edge) {
  const int axis = axis_of_edge(edge);
  const int k = edge % 4;
  return ((k & 1) << ((axis + 1) % 3)) | ((k >> 1) << ((axis + 2) % 3));
}

inline constexpr int high_corner(int edge) {
  return low_corner(edge) | (1 << axis_of_edge(edge));
}

/// The edge between two corners that differ in one bit.
inline constexpr int edge_between(int corner, int neighbour) {
  const int difference = corner ^ neighbour;
  const int axis = difference == 1 ? 0 : difference == 2 ? 1 : 2;
  const int on_u = (corner >> ((axis + 1) % 3)) & 1;
  const int on_v = (corner >> ((axis + 2) % 3)) & 1;
  return 4 * axis + on_u + 2 * on_v;
}

/// The four corners of a face, anticlockwise seen from outside the cube.
inline constexpr std::array<int, 4> corners_of_face(int face) {
  const int axis = face / 2;
  const int side = face % 2;
  const int u = 1 << ((axis + 1) % 3);
  const int v = 1 << ((axis + 2) % 3);
  const int base = side << axis;
  if (side == 1) return {base, base | u, base | u | v, base | v};
  return {base, base | v, base | u | v, base | u};
}

/// The two faces that meet in an edge, as bits.
inline constexpr unsigned faces_of_edge(int edge) {
  const int axis = axis_of_edge(edge);
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  return (1U << (2 * u + (edge & 1))) | (1U << (2 * v + ((edge >> 1) & 1)));
}

/// All bits of `monotone_axes`.
inline constexpr unsigned kAllAxes = 0x3f;

/// The bit of an axis along which the trilinear interpolant of corner values grows in the whole cube (axis), or falls (axis + 3).
inline unsigned monotone_along(const CornerValues& values, int axis) {
  bool grows = true;
  bool falls = true;
  for (int corner = 0; corner < kCorners; ++corner) {
    if ((corner >> axis & 1) != 0) continue;
    grows = grows && values[corner | 1 << axis] > values[corner];
    falls = falls && values[corner | 1 << axis] < values[corner];
  }
  return (unsigned{grows} | unsigned{falls} << 3) << axis;
}

/// The bits of all axes.
inline unsigned monotone_axes(const CornerValues& values) {
  return monotone_along(values, 0) | monotone_along(values, 1) | monotone_along(values, 2);
}

/// Whether a straight line between two points on these edges lies in a face of the cube.
inline constexpr bool share_face(int edge, int other) {
  return (faces_of_edge(edge) & faces_of_edge(other)) != 0;
}

}  // namespace smopt::cube
