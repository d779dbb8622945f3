#pragma once

#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "smopt/mesh/triangle_mesh.h"
#include "tests/improve/guarantee/random.h"

namespace smopt::testing {

/// One kind of random closed mesh.
struct MeshFamily {
  std::string_view name;
  TriangleMesh (*make)(Random& random, double roughness);
};

/// Its name, for the messages of tests.
inline std::ostream& operator<<(std::ostream& out, const MeshFamily& family) {
  return out << family.name;
}

/// All kinds; tests take each of them with many seeds.
std::span<const MeshFamily> mesh_families();

struct RandomMesh {
  TriangleMesh mesh;
  std::string description;  ///< family, seed, roughness, what was done to its coordinates
};

/// The family's mesh of that seed, closed, manifold and free of intersections by `metrics`: roughness is lowered until it is. The seed also
/// chooses what is done to the coordinates in the end (turned, scaled by 1e-6 or 1e6, moved by 1e6, relabelled), unless rounding would then
/// make triangles intersect. \throws std::runtime_error when there is none.
RandomMesh random_mesh_without_pairs(const MeshFamily& family, std::uint32_t seed);

/// The family's mesh of that seed with so much noise, or triangles so crushed, that it may well have intersecting or degenerate triangles.
RandomMesh random_mesh_with_faults(const MeshFamily& family, std::uint32_t seed);

}  // namespace smopt::testing
