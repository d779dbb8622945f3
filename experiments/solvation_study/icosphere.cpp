#include "experiments/solvation_study/icosphere.h"

#include <map>
#include <numbers>
#include <utility>

namespace smopt::experiments {
namespace {

/// Corners (0, ±1, ±φ) and their cyclic permutations.
TriangleMesh icosahedron() {
  constexpr double p = std::numbers::phi;
  TriangleMesh mesh;
  mesh.points = {{-1, p, 0},  {1, p, 0},  {-1, -p, 0}, {1, -p, 0}, {0, -1, p},  {0, 1, p},
                 {0, -1, -p}, {0, 1, -p}, {p, 0, -1},  {p, 0, 1},  {-p, 0, -1}, {-p, 0, 1}};
  mesh.triangles = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2}, {3, 2, 6}, {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  return mesh;
}

/// The number of the vertex in the middle of an edge, made when it is first asked for.
class Middles {
 public:
  explicit Middles(std::vector<Vec3>& points) : points_(points) {}

  VertexId between(VertexId a, VertexId b) {
    const auto [found, is_new] = numbers_.try_emplace(std::minmax(a, b), static_cast<VertexId>(points_.size()));
    if (is_new) points_.emplace_back((points_[a] + points_[b]) / 2);
    return found->second;
  }

 private:
  std::vector<Vec3>& points_;
  std::map<std::pair<VertexId, VertexId>, VertexId> numbers_;
};

void divide(TriangleMesh& mesh) {
  Middles middles(mesh.points);
  std::vector<Triangle> quarters;
  for (const Triangle& t : mesh.triangles) {
    const VertexId ab = middles.between(t[0], t[1]), bc = middles.between(t[1], t[2]), ca = middles.between(t[2], t[0]);
    quarters.insert(quarters.end(), {{t[0], ab, ca}, {t[1], bc, ab}, {t[2], ca, bc}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(quarters);
}

void put_on_sphere(std::vector<Vec3>& points, double radius) {
  for (Vec3& point : points) point *= radius / point.norm();
}

}  // namespace

TriangleMesh icosphere(int divisions, double radius) {
  TriangleMesh mesh = icosahedron();
  put_on_sphere(mesh.points, radius);
  for (int i = 0; i < divisions; ++i) {
    divide(mesh);
    put_on_sphere(mesh.points, radius);
  }
  return mesh;
}

}  // namespace smopt::experiments
