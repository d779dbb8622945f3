#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>

namespace smopt::testing {
namespace {

TriangleMesh icosahedron() {
  const double g = std::numbers::phi;
  TriangleMesh mesh;
  mesh.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2}, {3, 2, 6}, {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  return mesh;
}

TriangleMesh subdivided(const TriangleMesh& mesh) {
  TriangleMesh finer{mesh.points, {}};
  std::map<std::pair<VertexId, VertexId>, VertexId> midpoints;
  const auto midpoint = [&](VertexId a, VertexId b) {
    const auto [it, is_new] = midpoints.try_emplace(std::minmax(a, b), static_cast<VertexId>(finer.points.size()));
    if (is_new) finer.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
    return it->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const VertexId ab = midpoint(a, b);
    const VertexId bc = midpoint(b, c);
    const VertexId ca = midpoint(c, a);
    finer.triangles.insert(finer.triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return finer;
}

}  // namespace

TriangleMesh tetrahedron() {
  return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

TriangleMesh cube() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.points.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh icosphere(int subdivisions, double radius, const Vec3& center) {
  TriangleMesh mesh = icosahedron();
  for (int i = 0; i < subdivisions; ++i) mesh = subdivided(mesh);
  for (Vec3& p : mesh.points) p = center + radius * p.normalized();
  return mesh;
}

TriangleMesh torus(double major_radius, double minor_radius, int n_major, int n_minor) {
  TriangleMesh mesh;
  const auto id = [&](int i, int j) { return static_cast<VertexId>((i % n_major) * n_minor + j % n_minor); };
  for (int i = 0; i < n_major; ++i) {
    for (int j = 0; j < n_minor; ++j) {
      const double u = 2 * std::numbers::pi * i / n_major;
      const double v = 2 * std::numbers::pi * j / n_minor;
      const double r = major_radius + minor_radius * std::cos(v);
      mesh.points.emplace_back(r * std::cos(u), r * std::sin(u), minor_radius * std::sin(v));
      mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return mesh;
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh both = a;
  const auto shift = static_cast<VertexId>(a.points.size());
  both.points.insert(both.points.end(), b.points.begin(), b.points.end());
  for (const auto& [i, j, k] : b.triangles) both.triangles.push_back({i + shift, j + shift, k + shift});
  return both;
}

TriangleMesh reversed(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TriangleMesh translated(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& p : mesh.points) p += by;
  return mesh;
}

TriangleMesh scaled(TriangleMesh mesh, double factor) {
  for (Vec3& p : mesh.points) p *= factor;
  return mesh;
}

TriangleMesh rotated(TriangleMesh mesh, const Vec3& axis, double angle_rad) {
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
  for (Vec3& p : mesh.points) p = rotation * p;
  return mesh;
}

TriangleMesh noisy(TriangleMesh mesh, double amplitude, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (Vec3& p : mesh.points) {
    Vec3 d;
    do d = Vec3(uniform(random), uniform(random), uniform(random));
    while (d.norm() > 1);
    p += amplitude * d;
  }
  return mesh;
}

TriangleMesh relabelled(const TriangleMesh& mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<VertexId> new_id(mesh.points.size());
  std::iota(new_id.begin(), new_id.end(), 0U);
  std::shuffle(new_id.begin(), new_id.end(), random);
  TriangleMesh result{mesh.points, mesh.triangles};
  for (std::size_t i = 0; i < mesh.points.size(); ++i) result.points[new_id[i]] = mesh.points[i];
  for (Triangle& t : result.triangles) t = {new_id[t[0]], new_id[t[1]], new_id[t[2]]};
  std::shuffle(result.triangles.begin(), result.triangles.end(), random);
  return result;
}

}  // namespace smopt::testing
