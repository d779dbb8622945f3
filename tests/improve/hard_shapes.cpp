#include "tests/improve/hard_shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "smopt/surface/gaussian_surface.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using Edge = std::pair<VertexId, VertexId>;

/// Splits edges while it knows the triangle on the left of each directed edge.
class EdgeSplitter {
 public:
  explicit EdgeSplitter(const TriangleMesh& mesh) : mesh_(mesh) {
    for (FaceId f = 0; f < mesh_.triangle_count(); ++f) list(f);
  }

  void split(VertexId a, VertexId b, double t) {
    const auto m = static_cast<VertexId>(mesh_.points.size());
    mesh_.points.emplace_back((1 - t) * mesh_.points[a] + t * mesh_.points[b]);
    split_left(a, b, m);
    split_left(b, a, m);
  }

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }

 private:
  void list(FaceId f) {
    const Triangle& t = mesh_.triangles[f];
    for (int i = 0; i < 3; ++i) left_[{t[i], t[(i + 1) % 3]}] = f;
  }

  void split_left(VertexId a, VertexId b, VertexId m) {
    const FaceId f = left_.at({a, b});
    const Triangle t = mesh_.triangles[f];
    const VertexId opposite = t[0] != a && t[0] != b ? t[0] : (t[1] != a && t[1] != b ? t[1] : t[2]);
    mesh_.triangles[f] = {a, m, opposite};
    mesh_.triangles.push_back({m, b, opposite});
    list(f);
    list(static_cast<FaceId>(mesh_.triangles.size() - 1));
  }

  TriangleMesh mesh_;
  std::map<Edge, FaceId> left_;
};

}  // namespace

TriangleMesh octahedron() {
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

TriangleMesh plate(int n, double thickness) {
  TriangleMesh mesh;
  const auto side_points = static_cast<VertexId>((n + 1) * (n + 1));
  const auto top = [n](int i, int j) { return static_cast<VertexId>(i * (n + 1) + j); };
  for (const double z : {0.5 * thickness, -0.5 * thickness})
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) mesh.points.emplace_back(i, j, z);
  const auto wall = [&](VertexId a, VertexId b) {  // below the top's edge from a to b
    mesh.triangles.push_back({b, a, a + side_points});
    mesh.triangles.push_back({b, a + side_points, b + side_points});
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const VertexId a = top(i, j), b = top(i + 1, j), c = top(i + 1, j + 1), d = top(i, j + 1);
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      mesh.triangles.push_back({a + side_points, c + side_points, b + side_points});
      mesh.triangles.push_back({a + side_points, d + side_points, c + side_points});
    }
    wall(top(i, 0), top(i + 1, 0));
    wall(top(n, i), top(n, i + 1));
    wall(top(i + 1, n), top(i, n));
    wall(top(0, i + 1), top(0, i));
  }
  return mesh;
}

TriangleMesh spiky(TriangleMesh mesh, std::size_t every, double factor) {
  for (std::size_t v = 0; v < mesh.points.size(); v += every) mesh.points[v] *= factor;
  return mesh;
}

TriangleMesh linked_rings() {
  const TriangleMesh ring = torus(1, 0.25, 24, 10);
  return joined(ring, translated(rotated(ring, {1, 0, 0}, 1.5), {1, 0, 0}));
}

TriangleMesh knotted_tube() {
  constexpr int kAlong = 100, kAround = 6;
  TriangleMesh mesh = torus(1, 0.3, kAlong, kAround);
  const auto knot = [](double u) {
    return Vec3(std::sin(u) + 2 * std::sin(2 * u), std::cos(u) - 2 * std::cos(2 * u), -1.5 * std::sin(3 * u));
  };
  for (int i = 0; i < kAlong; ++i) {
    const double u = 2 * std::numbers::pi * i / kAlong;
    const Vec3 tangent = (knot(u + 1e-4) - knot(u - 1e-4)).normalized(), side = tangent.cross(knot(u)).normalized();
    for (int j = 0; j < kAround; ++j) {
      const double v = 2 * std::numbers::pi * j / kAround;
      mesh.points[static_cast<std::size_t>(i * kAround + j)] = knot(u) + 0.2 * (std::cos(v) * side + std::sin(v) * side.cross(tangent));
    }
  }
  return mesh;
}

TriangleMesh needles_with_a_speck_in_one() {
  const TriangleMesh sphere = spiky(icosphere(2), 40, 5);
  return joined(sphere, icosphere(0, 0.01, 0.6 * sphere.points[0]));
}

TriangleMesh dents_with_things_in_one() {
  const TriangleMesh sphere = spiky(icosphere(2), 40, 0.1);
  const Vec3 dent = sphere.points[0].normalized();
  const TriangleMesh sheet = translated(scaled(translated(plate(2, 0.001), {-1, -1, 0}), 0.02), 0.7 * dent);
  return joined(joined(sphere, icosphere(0, 0.01, 0.6 * dent)), sheet);
}

TriangleMesh plates_on_a_noisy_sheet(double gap, std::uint32_t seed) {
  constexpr int kSquares = 8;
  const TriangleMesh lower = noisy(plate(kSquares, 0.6), 0.2, seed);
  TriangleMesh upper = lower;
  const std::size_t side_points = lower.points.size() / 2;
  for (std::size_t i = 0; i < side_points; ++i) {
    upper.points[i] = lower.points[i] + Vec3(0, 0, 1);
    upper.points[side_points + i] = lower.points[i] + Vec3(0, 0, gap);
  }
  return joined(lower, upper);
}

TriangleMesh random_molecule_surface(std::size_t atoms, std::uint32_t seed) {
  constexpr double kAtomsPerVolume = 0.025;  // per Å³: sparser, it falls apart into balls; denser, it has no handles
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(0, std::cbrt(static_cast<double>(atoms) / kAtomsPerVolume)), radius(1.2, 2);
  Molecule molecule;
  for (std::size_t i = 0; i < atoms; ++i) {
    molecule.centers.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    molecule.charges.push_back(0);
    molecule.radii.push_back(radius(random));
  }
  return gaussian_surface(molecule, {});
}

TriangleMesh with_points_in_faces(const TriangleMesh& mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.2, 1);
  TriangleMesh result{mesh.points, {}};
  for (const auto& [a, b, c] : mesh.triangles) {
    const double u = uniform(random), v = uniform(random), w = uniform(random);
    const auto m = static_cast<VertexId>(result.points.size());
    result.points.emplace_back((u * mesh.points[a] + v * mesh.points[b] + w * mesh.points[c]) / (u + v + w));
    result.triangles.insert(result.triangles.end(), {{a, b, m}, {b, c, m}, {c, a, m}});
  }
  return result;
}

TriangleMesh with_points_on_edges(const TriangleMesh& mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.2, 0.8);
  std::vector<Edge> edges;
  for (const Triangle& t : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      if (t[i] < t[(i + 1) % 3]) edges.emplace_back(t[i], t[(i + 1) % 3]);
  std::shuffle(edges.begin(), edges.end(), random);
  EdgeSplitter splitter(mesh);
  for (const auto& [a, b] : edges) splitter.split(a, b, uniform(random));
  return splitter.mesh();
}

}  // namespace smopt::testing
