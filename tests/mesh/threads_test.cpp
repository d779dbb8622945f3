#include <gtest/gtest.h>

#include <algorithm>

#include "smopt/mesh/compact.h"
#include "smopt/mesh/components.h"
#include "smopt/mesh/nesting.h"
#include "smopt/mesh/orientation.h"
#include "smopt/mesh/rings.h"
#include "smopt/mesh/validity.h"
#include "tests/support/shapes.h"
#include "tests/support/threads.h"

namespace smopt {
namespace {

using namespace testing;

/// A torus of 80 000 triangles with a hundred shells in and around it, in random order: several tasks for every stage.
TriangleMesh large_mesh() {
  TriangleMesh mesh = torus(100, 30, 400, 100);
  for (int i = 0; i < 100; ++i) mesh = joined(mesh, icosphere(1, 1 + 0.01 * i, {i % 10 * 25.0 - 110, i / 10 * 25.0 - 110, 0}));
  return relabelled(mesh, 3);
}

TEST(Threads, GiveTheSameRings) {
  expect_same_for_any_threads([mesh = large_mesh()] {
    const VertexRings rings = build_rings(mesh).value();
    return std::tuple(rings.rows, rings.ring_vertices, rings.ring_faces);
  });
}

TEST(Threads, GiveTheSameComponentsVolumesAndNesting) {
  expect_same_for_any_threads([mesh = large_mesh()] {
    const Components components = connected_components(mesh);
    EXPECT_EQ(components.count, 101U);
    const Nesting nesting = component_nesting(mesh, components);
    EXPECT_GT(std::ranges::count(nesting.depth, 1U), 0);
    return std::tuple(components.of_triangle, components.of_vertex, component_volumes(mesh, components), nesting.depth, nesting.enclosing);
  });
}

TEST(Threads, GiveTheSameCompactedMesh) {
  expect_same_for_any_threads([mesh = large_mesh()] {
    TriangleMesh compacted = mesh;
    std::vector<char> is_kept(mesh.triangle_count());
    for (std::size_t f = 0; f < is_kept.size(); ++f) is_kept[f] = f % 5 < 2 ? 1 : 0;
    keep_triangles(compacted, is_kept);
    EXPECT_GT(remove_isolated_vertices(compacted), 0U);
    return std::tuple(compacted.points, compacted.triangles);
  });
}

TEST(Threads, GiveTheSameFaultsInTheSameOrder) {
  TriangleMesh mesh = large_mesh();
  for (std::size_t i = 0; i < mesh.vertex_count(); i += 997) mesh.points[i][1] = HUGE_VAL;
  for (std::size_t f = 0; f < mesh.triangle_count(); f += 1009) std::swap(mesh.triangles[f][0], mesh.triangles[f][1]);
  for (std::size_t f = 500; f < mesh.triangle_count(); f += 5003) mesh.triangles[f] = mesh.triangles[f + 1];
  for (std::size_t f = 700; f < mesh.triangle_count(); f += 5003) mesh.triangles[f][0] = mesh.triangles[f][1];
  const ValidityReport one_example = check_validity(mesh);
  ASSERT_GT(one_example.nonfinite_vertices.count, kMaxFaultExamples);
  ASSERT_GT(one_example.duplicate_faces.count, kMaxFaultExamples);
  EXPECT_TRUE(one_example.nonfinite_vertices.examples[0].starts_with("vertex 0 ")) << "the first place comes first";
  EXPECT_TRUE(one_example.nonfinite_vertices.examples[2].starts_with("vertex 1994 "));
  expect_same_for_any_threads([&] { return check_validity(mesh).describe(); });
}

}  // namespace
}  // namespace smopt
