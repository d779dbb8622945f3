#pragma once

#include <cstdint>

#include "smopt/mesh/triangle_mesh.h"

/// Small meshes with known properties, all oriented outwards.
namespace smopt::testing {

/// The regular tetrahedron with corners (±1, ±1, ±1) of even sign product; edge √8, volume 8/3.
TriangleMesh tetrahedron();

/// The cube [0, 1]³ as twelve triangles.
TriangleMesh cube();

/// An icosahedron whose faces are divided `subdivisions` times, with all vertices on the sphere: 10·4^s + 2 vertices.
TriangleMesh icosphere(int subdivisions, double radius = 1.0, const Vec3& center = Vec3::Zero());

/// A torus around the z axis with `n_major` × `n_minor` vertices.
TriangleMesh torus(double major_radius, double minor_radius, int n_major, int n_minor);

/// The two meshes side by side in one (no vertex is merged).
TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b);

/// Every triangle turned round: inwards.
TriangleMesh reversed(TriangleMesh mesh);

TriangleMesh translated(TriangleMesh mesh, const Vec3& by);
TriangleMesh scaled(TriangleMesh mesh, double factor);
TriangleMesh rotated(TriangleMesh mesh, const Vec3& axis, double angle_rad);

/// Every vertex moved by a random vector of length up to `amplitude`; the same for the same seed.
TriangleMesh noisy(TriangleMesh mesh, double amplitude, std::uint32_t seed);

/// Vertices and triangles in another, random order: the same surface.
TriangleMesh relabelled(const TriangleMesh& mesh, std::uint32_t seed);

}  // namespace smopt::testing
