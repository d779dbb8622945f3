#include "tests/improve/remesh/shape_judge.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "metrics/union_find.h"
#include "smopt/mesh/compact.h"
#include "tests/improve/judge.h"

namespace smopt::testing {
namespace {

/// Far above what arc functions round, degrees or ratios; far below what matters.
constexpr double kRounding = 1e-7;
constexpr double kDegrees = 180 / std::numbers::pi;

using Edge = std::pair<VertexId, VertexId>;

/// Collects values of which none should be below a goal.
class AtLeast {
 public:
  AtLeast(std::string name, double goal, double best) : measure_{std::move(name), best, 0, 0}, goal_(goal) {}
  void add(double value) {
    measure_.worst = std::min(measure_.worst, value);
    measure_.surely_missing += value < goal_ - kRounding ? 1 : 0;
    measure_.perhaps_missing += value < goal_ + kRounding ? 1 : 0;
  }
  [[nodiscard]] GoalMeasure measure() const { return measure_; }
  /// Of the negative values.
  [[nodiscard]] GoalMeasure negated() const {
    GoalMeasure result = measure_;
    result.worst = -result.worst;
    return result;
  }

 private:
  GoalMeasure measure_;
  double goal_;
};

double angle(const Vec3& at, const Vec3& p, const Vec3& q) {
  return kDegrees * std::atan2((p - at).cross(q - at).norm(), (p - at).dot(q - at));
}

double largest_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::max({angle(a, b, c), angle(b, c, a), angle(c, a, b)});
}

Vec3 normal(const TriangleMesh& mesh, const Triangle& t) {
  return (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
}

/// The triangle on the left of each directed edge.
std::map<Edge, FaceId> left_triangles(const TriangleMesh& mesh) {
  std::map<Edge, FaceId> left;
  for (FaceId f = 0; f < mesh.triangle_count(); ++f)
    for (int i = 0; i < 3; ++i) left[{mesh.triangles[f][i], mesh.triangles[f][(i + 1) % 3]}] = f;
  return left;
}

}  // namespace

std::array<GoalMeasure, 5> measure_goals(const TriangleMesh& mesh, const RemeshGoals& goals) {
  AtLeast smallest("min-angle", goals.min_angle_deg, 60), largest("max-angle", -goals.max_angle_deg, -60);
  AtLeast ratio("edge-ratio", goals.edge_ratio, 1), dihedral("min-dihedral", goals.min_dihedral_deg, 180);
  AtLeast valence("valence", -goals.valence_spread, 0);
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 &a = mesh.points[i], &b = mesh.points[j], &c = mesh.points[k];
    smallest.add(smallest_angle_deg(a, b, c));
    largest.add(-largest_angle(a, b, c));
    ratio.add(edge_ratio(a, b, c));
  }
  const std::map<Edge, FaceId> left = left_triangles(mesh);
  for (const auto& [edge, f] : left) {
    if (edge.first > edge.second) continue;
    const Vec3 n = normal(mesh, mesh.triangles[f]), m = normal(mesh, mesh.triangles[left.at({edge.second, edge.first})]);
    dihedral.add(180 - kDegrees * std::atan2(n.cross(m).norm(), n.dot(m)));
  }
  for (const std::size_t count : valences(mesh))
    if (count > 0) valence.add(-std::abs(static_cast<double>(count) - 6));
  return {smallest.measure(), largest.negated(), ratio.measure(), dihedral.measure(), valence.negated()};
}

double smallest_angle(const TriangleMesh& mesh) {
  return smallest_angle_deg(mesh);
}

double largest_angle(const TriangleMesh& mesh) {
  double largest = 0;
  for (const auto& [a, b, c] : mesh.triangles) largest = std::max(largest, largest_angle(mesh.points[a], mesh.points[b], mesh.points[c]));
  return largest;
}

std::vector<double> edge_lengths(const TriangleMesh& mesh) {
  std::vector<double> lengths;
  for (const auto& [edge, f] : left_triangles(mesh))
    if (edge.first < edge.second) lengths.push_back((mesh.points[edge.first] - mesh.points[edge.second]).norm());
  return lengths;
}

double mean_edge_length(const TriangleMesh& mesh) {
  const std::vector<double> lengths = edge_lengths(mesh);
  return std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
}

std::size_t used_vertices(const TriangleMesh& mesh) {
  const std::vector<std::size_t> valence = valences(mesh);
  return valence.size() - static_cast<std::size_t>(std::count(valence.begin(), valence.end(), 0U));
}

std::vector<TriangleMesh> components_of(const TriangleMesh& mesh) {
  metrics::UnionFind sets(mesh.vertex_count());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.unite(a, b);
    sets.unite(b, c);
  }
  std::map<std::size_t, TriangleMesh> parts;
  for (const Triangle& t : mesh.triangles) parts[sets.root(t[0])].triangles.push_back(t);
  std::vector<TriangleMesh> result;
  for (auto& [root, part] : parts) {
    part.points = mesh.points;
    remove_isolated_vertices(part);
    result.push_back(std::move(part));
  }
  return result;
}

}  // namespace smopt::testing
