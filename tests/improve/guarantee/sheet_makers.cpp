#include "tests/improve/guarantee/sheet_makers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "metrics/topology.h"
#include "tests/improve/hard_shapes.h"

namespace smopt::testing {
namespace {

/// Where point v of `plate(n, …)` is on its grid.
struct PlatePoint {
  PlatePoint(std::size_t v, int n) {
    const int side = (n + 1) * (n + 1), k = static_cast<int>(v);
    is_top = k < side;
    i = k % side / (n + 1);
    j = k % side % (n + 1);
  }
  int i, j;
  bool is_top;
};

std::vector<double> random_values(Random& random, int count, double amplitude) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(random.uniform(-amplitude, amplitude));
  return values;
}

/// Lines at growing places, the gaps between them of random orders of magnitude.
std::vector<double> graded_lines(Random& random, int count) {
  std::vector<double> lines = {0};
  while (static_cast<int>(lines.size()) < count) lines.push_back(lines.back() + random.power_of_ten(-4, 1));
  return lines;
}

double smallest_gap_at(const std::vector<double>& lines, int i) {
  double gap = HUGE_VAL;
  if (i > 0) gap = std::min(gap, lines[i] - lines[i - 1]);
  if (i + 1 < static_cast<int>(lines.size())) gap = std::min(gap, lines[i + 1] - lines[i]);
  return gap;
}

using Cell = std::array<int, 3>;

Cell neighbour(Cell cell, int axis, int by) {
  cell[axis] += by;
  return cell;
}

/// The boundary of a set of unit cubes; points are shared by their coordinates.
TriangleMesh boundary_of(const std::set<Cell>& cells) {
  TriangleMesh mesh;
  std::map<Cell, VertexId> ids;
  const auto id_of = [&](const Cell& corner) {
    const auto [place, is_new] = ids.emplace(corner, static_cast<VertexId>(mesh.points.size()));
    if (is_new) mesh.points.emplace_back(corner[0], corner[1], corner[2]);
    return place->second;
  };
  for (const Cell& cell : cells)
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        if (cells.count(neighbour(cell, axis, 2 * side - 1)) > 0) continue;
        const int u = (axis + (side == 1 ? 1 : 2)) % 3, v = 3 - axis - u;
        const Cell a = neighbour(cell, axis, side), b = neighbour(a, u, 1), c = neighbour(b, v, 1), d = neighbour(a, v, 1);
        mesh.triangles.push_back({id_of(a), id_of(b), id_of(c)});
        mesh.triangles.push_back({id_of(a), id_of(c), id_of(d)});
      }
  return mesh;
}

bool is_closed_manifold(const TriangleMesh& mesh) {
  std::vector<std::string> notes;
  const metrics::Topology topology = metrics::measure_topology(mesh, notes);
  return topology.closed && topology.edge_manifold && topology.vertex_manifold;
}

}  // namespace

TriangleMesh sheets_that_nearly_touch(Random& random, double roughness) {
  return plates_on_a_noisy_sheet(random.power_of_ten(-12, -3) / roughness, random.seed());
}

TriangleMesh thin_plate(Random& random, double roughness) {
  const int n = random.integer(6, 16);
  TriangleMesh mesh = plate(n, random.power_of_ten(-9, -3));
  const auto side = static_cast<std::size_t>((n + 1) * (n + 1));
  const double waviness = roughness * random.power_of_ten(-3, 0);
  for (std::size_t v = 0; v < side; ++v) {
    const Vec3 bend(roughness * random.uniform(-0.3, 0.3), roughness * random.uniform(-0.3, 0.3), random.uniform(-waviness, waviness));
    mesh.points[v] += bend;
    mesh.points[v + side] += bend;
  }
  return mesh;
}

TriangleMesh accordion(Random& random, double roughness) {
  const int n = random.integer(6, 14);
  const double gap = random.power_of_ten(-8, -1), thickness = random.power_of_ten(-9, -1), depth = random.uniform(0.5, 5);
  TriangleMesh mesh = plate(n, thickness);
  const std::vector<double> folds = random_values(random, n + 1, 0.3 * roughness), columns = random_values(random, n + 1, 0.3 * roughness);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const PlatePoint at(v, n);
    const Vec3 p = mesh.points[v];
    mesh.points[v] = Vec3((p.x() + folds[at.i]) * gap, p.y() + columns[at.j], p.z() + depth * (at.i % 2));
  }
  return mesh;
}

TriangleMesh swiss_roll(Random& random, double roughness) {
  const int n = random.integer(18, 24), steps_per_turn = random.integer(6, 10);
  const double thickness = random.power_of_ten(-6, -1), pitch = thickness * (1 + random.power_of_ten(-4, 0)) / roughness;
  TriangleMesh mesh = plate(n, thickness);
  const std::vector<double> columns = random_values(random, n + 1, 0.3 * roughness);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const PlatePoint at(v, n);
    const double turns = static_cast<double>(at.i) / steps_per_turn, angle = 2 * std::numbers::pi * turns;
    const double radius = 1 + pitch * turns - mesh.points[v].z();
    mesh.points[v] = Vec3(radius * std::cos(angle), 0.3 * (at.j + columns[at.j]), radius * std::sin(angle));
  }
  return mesh;
}

TriangleMesh badly_graded_plate(Random& random, double roughness) {
  const int n = random.integer(6, 16);
  const std::vector<double> xs = graded_lines(random, n + 1), ys = graded_lines(random, n + 1);
  TriangleMesh mesh = plate(n, random.power_of_ten(-4, 1));
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const PlatePoint at(v, n);
    const double thickness = std::abs(2 * mesh.points[v].z());
    const double room = std::min({smallest_gap_at(xs, at.i), smallest_gap_at(ys, at.j), thickness});
    mesh.points[v] = Vec3(xs[at.i], ys[at.j], mesh.points[v].z()) + random.in_ball(0.3 * roughness * room);
  }
  return mesh;
}

TriangleMesh coplanar_box(Random& random, double roughness) {
  constexpr double kSteps = 1024;  // places are multiples of 1/1024, so that moving the box by whole numbers is exact
  const int n = random.integer(4, 14);
  TriangleMesh mesh = plate(n, random.integer(1, n));
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const PlatePoint at(v, n);
    const bool is_inner = at.i > 0 && at.j > 0 && at.i < n && at.j < n;
    const Vec3 step = kSteps * random.in_ball(0.33 * roughness);
    if (is_inner) mesh.points[v] += Vec3(std::round(step.x()), std::round(step.y()), 0) / kSteps;
  }
  return mesh;
}

TriangleMesh polycube(Random& random, double /*roughness*/) {
  const auto wanted = static_cast<std::size_t>(random.integer(30, 120));
  std::set<Cell> cells = {{0, 0, 0}};
  for (int trial = 0; cells.size() < wanted && trial < 500; ++trial) {
    const auto from = std::next(cells.begin(), random.integer(0, static_cast<int>(cells.size()) - 1));
    const auto [place, is_new] = cells.insert(neighbour(*from, random.integer(0, 2), random.coin() ? 1 : -1));
    if (is_new && !is_closed_manifold(boundary_of(cells))) cells.erase(place);
  }
  return boundary_of(cells);
}

}  // namespace smopt::testing
