#include "tests/improve/guarantee/random_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>

#include "metrics/topology.h"
#include "tests/improve/guarantee/ball_makers.h"
#include "tests/improve/guarantee/sheet_makers.h"
#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

TriangleMesh two_families(Random& random, double roughness);

constexpr std::array<MeshFamily, 26> kFamilies = {{
    {"noisy_sphere", noisy_sphere},
    {"noisy_torus", noisy_torus},
    {"needles", needles},
    {"spikes_with_specks", spikes_with_specks},
    {"dents_with_specks", dents_with_specks},
    {"sheets_that_nearly_touch", sheets_that_nearly_touch},
    {"shells_that_nearly_touch", shells_that_nearly_touch},
    {"nested_components", nested_components},
    {"linked_tori", linked_tori},
    {"thin_plate", thin_plate},
    {"accordion", accordion},
    {"swiss_roll", swiss_roll},
    {"badly_graded_plate", badly_graded_plate},
    {"badly_graded_sphere", badly_graded_sphere},
    {"flattened", flattened},
    {"coplanar_box", coplanar_box},
    {"polycube", polycube},
    {"redundant_points", redundant_points},
    {"lattice", lattice},
    {"fans", fans},
    {"pleats", pleats},
    {"crumpled", crumpled},
    {"hovering_specks", hovering_specks},
    {"tetrahedra", tetrahedra},
    {"knot", knot},
    {"two_families", two_families},
}};

double lowest_x(const TriangleMesh& mesh) {
  return std::min_element(mesh.points.begin(), mesh.points.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); })->x();
}

double highest_x(const TriangleMesh& mesh) {
  return std::max_element(mesh.points.begin(), mesh.points.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); })->x();
}

/// Meshes of two of the families before this one, of very different size, side by side and nearly touching.
TriangleMesh two_families(Random& random, double roughness) {
  const auto some = [&] { return kFamilies[random.integer(0, kFamilies.size() - 2)].make(random, roughness); };
  const TriangleMesh a = some(), b = scaled(some(), random.power_of_ten(-4, 0));
  return joined(a, translated(b, {highest_x(a) - lowest_x(b) + random.power_of_ten(-9, -3), 0, 0}));
}

/// What may be done to the coordinates in the end.
struct Change {
  std::string_view name;
  TriangleMesh (*apply)(const TriangleMesh& mesh, Random& random);
};

constexpr std::array<Change, 8> kChanges = {{
    {"as made", [](const TriangleMesh& mesh, Random&) { return mesh; }},
    {"turned", [](const TriangleMesh& mesh, Random& random) { return rotated(mesh, random.direction(), random.uniform(0, 6)); }},
    {"scaled by 1e-6", [](const TriangleMesh& mesh, Random&) { return scaled(mesh, 1e-6); }},
    {"relabelled", [](const TriangleMesh& mesh, Random& random) { return relabelled(mesh, random.seed()); }},
    {"moved by 1e6",
     [](const TriangleMesh& mesh, Random&) {
       return translated(mesh, {1e6, -1e6, 1e6});
     }},
    {"scaled by 1e6", [](const TriangleMesh& mesh, Random&) { return scaled(mesh, 1e6); }},
    {"turned, scaled by 30, moved by 1e6, relabelled",
     [](const TriangleMesh& mesh, Random& random) {
       const TriangleMesh turned = rotated(scaled(mesh, 30), random.direction(), random.uniform(0, 6));
       return relabelled(translated(turned, {-1e6, 1e6, 0}), random.seed());
     }},
    {"moved by 1e-6",
     [](const TriangleMesh& mesh, Random&) {
       return translated(mesh, {1e-6, 0, 0});
     }},
}};

bool is_usable(const TriangleMesh& mesh) {
  std::vector<std::string> notes;
  const metrics::Topology topology = metrics::measure_topology(mesh, notes);
  return topology.closed && topology.edge_manifold && topology.vertex_manifold && topology.oriented && topology.nonfinite_vertices == 0;
}

/// A different stream of random numbers for each family, so that equal seeds do not mean equal noise.
Random random_of(const MeshFamily& family, std::uint32_t seed) {
  return Random(1000 * seed + static_cast<std::uint32_t>(&family - kFamilies.data()));
}

/// Presses some vertices onto others, or onto edges, of their triangles: exactly degenerate faces.
TriangleMesh crushed(TriangleMesh mesh, Random& random) {
  for (int i = 0; i < 3; ++i) {
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(random.integer(0, static_cast<int>(mesh.triangle_count()) - 1))];
    const double share = 0.5 * random.integer(0, 2);
    mesh.points[t[0]] = (1 - share) * mesh.points[t[1]] + share * mesh.points[t[2]];
  }
  return mesh;
}

}  // namespace

std::span<const MeshFamily> mesh_families() {
  return kFamilies;
}

RandomMesh random_mesh_without_pairs(const MeshFamily& family, std::uint32_t seed) {
  constexpr int kTrials = 8;
  Random random = random_of(family, seed);
  const Change& change = kChanges[seed % kChanges.size()];
  double roughness = 1;
  for (int trial = 0; trial < kTrials; ++trial, roughness *= 0.6) {
    const TriangleMesh mesh = family.make(random, roughness);
    if (!is_usable(mesh) || !intersecting_pairs(mesh).empty()) continue;
    const auto description = [&](const Change& c) {
      return fmt::format("{}, seed {}, roughness {:.3g}, {}", family.name, seed, roughness, c.name);
    };
    const TriangleMesh changed = change.apply(mesh, random);
    if (intersecting_pairs(changed).empty()) return {changed, description(change)};
    return {mesh, description(kChanges[0])};
  }
  throw std::runtime_error(fmt::format("{}, seed {}: no mesh without intersections", family.name, seed));
}

RandomMesh random_mesh_with_faults(const MeshFamily& family, std::uint32_t seed) {
  Random random = random_of(family, seed);
  const bool is_crushed = seed % 2 == 0;
  TriangleMesh mesh = family.make(random, 1);
  double edge = 0;  // half the mean length of a side
  for (const Triangle& t : mesh.triangles) edge += (mesh.points[t[0]] - mesh.points[t[1]]).norm();
  edge *= 0.5 / static_cast<double>(mesh.triangle_count());
  mesh = is_crushed ? crushed(mesh, random) : noisy(mesh, edge, random.seed());
  const Change& change = kChanges[seed % kChanges.size()];
  return {change.apply(mesh, random), fmt::format("{}, seed {}, {}, {}", family.name, seed, is_crushed ? "crushed" : "rough", change.name)};
}

}  // namespace smopt::testing
