#include "smopt/mesh/orientation.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include <oneapi/tbb/parallel_reduce.h>

#include "smopt/error.h"
#include "smopt/geometry/triangle_shape.h"
#include "smopt/mesh/edge_sides.h"
#include "smopt/parallel.h"

namespace smopt {
namespace {

/// A triangle across an edge, and whether it must be turned when this one is not (and the other way round).
struct Neighbour {
  FaceId face;
  bool disagrees;
  VertexId low, high;
};

std::vector<std::array<Neighbour, 3>> face_neighbours(const TriangleMesh& mesh) {
  const std::vector<EdgeSide> sides = sorted_edge_sides(mesh);
  std::vector<std::array<Neighbour, 3>> neighbours(mesh.triangle_count());
  std::vector<unsigned char> count(mesh.triangle_count(), 0);
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    const EdgeSide &s = sides[i], &t = sides[i + 1];
    const bool disagrees = s.is_ascending == t.is_ascending;
    neighbours[s.face][count[s.face]++] = {t.face, disagrees, s.low, s.high};
    neighbours[t.face][count[t.face]++] = {s.face, disagrees, s.low, s.high};
  }
  return neighbours;
}

/// The first corner of each component's first triangle: volumes are taken from there, so that they do not depend on where the mesh is.
std::vector<Vec3> first_points(const TriangleMesh& mesh, const Components& components) {
  std::vector<Vec3> points;
  for (FaceId f = 0; points.size() < components.count; ++f)
    if (components.of_triangle[f] == points.size()) points.push_back(mesh.points[mesh.triangles[f][0]]);
  return points;
}

}  // namespace

std::size_t orient_consistently(TriangleMesh& mesh) {
  const std::vector<std::array<Neighbour, 3>> neighbours = face_neighbours(mesh);
  enum class State : unsigned char { unseen, as_it_is, to_turn };
  std::vector<State> states(mesh.triangle_count(), State::unseen);
  std::vector<FaceId> stack;
  for (FaceId seed = 0; seed < mesh.triangle_count(); ++seed) {
    if (states[seed] != State::unseen) continue;
    states[seed] = State::as_it_is;
    stack.push_back(seed);
    while (!stack.empty()) {
      const FaceId f = stack.back();
      stack.pop_back();
      for (const Neighbour& n : neighbours[f]) {
        const bool is_turned = (states[f] == State::to_turn) != n.disagrees;
        const State wanted = is_turned ? State::to_turn : State::as_it_is;
        if (states[n.face] == State::unseen) {
          states[n.face] = wanted;
          stack.push_back(n.face);
        } else if (states[n.face] != wanted) {
          throw InvalidMesh(
              fmt::format("the surface is one-sided: it cannot be oriented across edge {}-{} (faces {} and {})", n.low, n.high, f, n.face));
        }
      }
    }
  }
  std::size_t turned = 0;
  for (FaceId f = 0; f < mesh.triangle_count(); ++f) {
    if (states[f] != State::to_turn) continue;
    std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
    ++turned;
  }
  return turned;
}

std::vector<double> component_volumes(const TriangleMesh& mesh, const Components& components) {
  const std::vector<Vec3> origins = first_points(mesh, components);
  // Split by the sizes alone, so that the sums are the same for any number of threads; at most a fourth of the work is adding them up.
  const tbb::blocked_range<std::size_t> all(0, mesh.triangle_count(), std::max(kGrain, 4 * components.count));
  const auto add_volumes = [&](const tbb::blocked_range<std::size_t>& range, std::vector<double> volumes) {
    for (std::size_t f = range.begin(); f < range.end(); ++f) {
      const auto& [a, b, c] = mesh.triangles[f];
      const Vec3& origin = origins[components.of_triangle[f]];
      volumes[components.of_triangle[f]] += sextuple_volume(mesh.points[a] - origin, mesh.points[b] - origin, mesh.points[c] - origin) / 6;
    }
    return volumes;
  };
  const auto sum = [](std::vector<double> a, const std::vector<double>& b) {
    std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus<>());
    return a;
  };
  return tbb::parallel_deterministic_reduce(all, std::vector<double>(components.count, 0), add_volumes, sum);
}

double signed_volume(const TriangleMesh& mesh) {
  double sextuple = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3& origin = mesh.points[mesh.triangles.front()[0]];
    sextuple += sextuple_volume(mesh.points[a] - origin, mesh.points[b] - origin, mesh.points[c] - origin);
  }
  return sextuple / 6;
}

void reverse_orientation(TriangleMesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

}  // namespace smopt
