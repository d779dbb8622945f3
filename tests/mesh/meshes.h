#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::testing {

/// Two poles over a ring of `valence` vertices, closed and oriented outwards; the poles are the last two vertices.
inline TriangleMesh bipyramid(int valence) {
  TriangleMesh mesh;
  const auto n = static_cast<VertexId>(valence);
  for (VertexId i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    mesh.points.emplace_back(std::cos(angle), std::sin(angle), 0);
    mesh.triangles.push_back({i, (i + 1) % n, n});
    mesh.triangles.push_back({(i + 1) % n, i, n + 1});
  }
  mesh.points.emplace_back(0, 0, 1);
  mesh.points.emplace_back(0, 0, -1);
  return mesh;
}

/// An n × m lattice of squares, closed in both directions; with `is_twisted` the second direction is reversed on the way round the first: a
/// Klein bottle. The positions mean nothing.
inline TriangleMesh closed_lattice(VertexId n, VertexId m, bool is_twisted) {
  TriangleMesh mesh;
  const auto id = [&](VertexId i, VertexId j) { return i < n ? i * m + j % m : (is_twisted ? (2 * m - j) % m : j % m); };
  for (VertexId i = 0; i < n; ++i) {
    for (VertexId j = 0; j < m; ++j) {
      mesh.points.emplace_back(i, j, 0);
      mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return mesh;
}

/// Turns about half of the triangles, the same for the same seed.
inline TriangleMesh randomly_flipped(TriangleMesh mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  for (Triangle& t : mesh.triangles)
    if (random() % 2 == 0) std::swap(t[1], t[2]);
  return mesh;
}

}  // namespace smopt::testing
