#include "tests/improve/guarantee/promise.h"

#include <CGAL/Exact_rational.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "metrics/degenerate.h"
#include "metrics/topology.h"
#include "metrics/union_find.h"
#include "tests/improve/judge.h"
#include "tests/support/matchers.h"

namespace smopt::testing {
namespace {

using ::testing::ElementsAreArray;
using ::testing::IsEmpty;

/// The triangles with only the points they use, in the same order.
TriangleMesh compact(const TriangleMesh& mesh, const std::vector<Triangle>& triangles) {
  constexpr VertexId kUnused = ~VertexId{0};
  std::vector<VertexId> new_id(mesh.vertex_count(), kUnused);
  for (const Triangle& t : triangles)
    for (const VertexId v : t) new_id[v] = v;
  TriangleMesh result;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (new_id[v] == kUnused) continue;
    new_id[v] = static_cast<VertexId>(result.points.size());
    result.points.push_back(mesh.points[v]);
  }
  for (const auto& [a, b, c] : triangles) result.triangles.push_back({new_id[a], new_id[b], new_id[c]});
  return result;
}

std::vector<std::size_t> component_of_triangle(const TriangleMesh& mesh) {
  metrics::UnionFind sets(mesh.vertex_count());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.unite(a, b);
    sets.unite(b, c);
  }
  std::vector<std::size_t> roots;
  for (const Triangle& t : mesh.triangles) roots.push_back(sets.root(t[0]));
  return roots;
}

/// The components as meshes of their own, in the order of their lowest vertex.
std::vector<TriangleMesh> components(const TriangleMesh& mesh) {
  const std::vector<std::size_t> of_triangle = component_of_triangle(mesh);
  std::vector<std::size_t> roots = of_triangle;
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  std::vector<TriangleMesh> result;
  for (const std::size_t root : roots) {
    std::vector<Triangle> triangles;
    for (FaceId f = 0; f < mesh.triangle_count(); ++f)
      if (of_triangle[f] == root) triangles.push_back(mesh.triangles[f]);
    result.push_back(compact(mesh, triangles));
  }
  return result;
}

template <class Number>
Number triple_product(const std::array<Vec3, 3>& p) {
  const auto x = [&p](int corner, int axis) { return Number(p[corner][axis]); };
  return x(0, 0) * (x(1, 1) * x(2, 2) - x(1, 2) * x(2, 1)) + x(0, 1) * (x(1, 2) * x(2, 0) - x(1, 0) * x(2, 2)) +
         x(0, 2) * (x(1, 0) * x(2, 1) - x(1, 1) * x(2, 0));
}

/// Exactly, where rounding might decide: a component may be as thin as doubles allow.
int sign_of_volume(const TriangleMesh& mesh) {
  constexpr double kRounding = 1e-12;  // far above the relative error of a sum of some thousand products
  const auto corners = [&mesh](const Triangle& t) { return std::array{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}; };
  double volume = 0, largest = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto p = corners(t);
    volume += triple_product<double>(p);
    largest += p[0].norm() * p[1].norm() * p[2].norm();
  }
  if (std::abs(volume) > kRounding * largest) return volume > 0 ? 1 : -1;
  CGAL::Exact_rational exact = 0;
  for (const Triangle& t : mesh.triangles) exact += triple_product<CGAL::Exact_rational>(corners(t));
  return static_cast<int>(CGAL::sign(exact));
}

/// How many of the parts enclose each part.
std::vector<int> depths(const std::vector<TriangleMesh>& parts) {
  std::vector<int> depth(parts.size(), 0);
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < parts.size(); ++j)
      if (i != j && std::abs(winding_number(parts[j], parts[i].points[0])) > 0.5) ++depth[i];
  return depth;
}

std::size_t degenerate_count(const TriangleMesh& mesh) {
  const std::vector<bool> flags = metrics::degenerate_triangles(mesh);
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), true));
}

std::vector<FaceId> new_degenerate_triangles(const TriangleMesh& before, const TriangleMesh& after) {
  const std::vector<bool> was = metrics::degenerate_triangles(before), is = metrics::degenerate_triangles(after);
  std::vector<FaceId> result;
  for (FaceId f = 0; f < is.size(); ++f)
    if (is[f] && !was[f]) result.push_back(f);
  return result;
}

std::vector<int> euler_characteristics(const TriangleMesh& mesh) {
  std::vector<int> result;
  for (const TriangleMesh& part : components(mesh)) result.push_back(euler_characteristic(part));
  std::sort(result.begin(), result.end());
  return result;
}

bool is_finite(const TriangleMesh& mesh) {
  return std::all_of(mesh.points.begin(), mesh.points.end(), [](const Vec3& p) { return p.allFinite(); });
}

bool removed_redundant_points(const ImproveReport& report) {
  return report.redundant.valence3 + report.redundant.valence4 > 0;
}

}  // namespace

std::vector<Shell> shells(const TriangleMesh& mesh) {
  const std::vector<TriangleMesh> parts = components(mesh);
  const std::vector<int> depth = depths(parts);
  std::vector<Shell> result;
  for (std::size_t i = 0; i < parts.size(); ++i) result.emplace_back(euler_characteristic(parts[i]), sign_of_volume(parts[i]), depth[i]);
  std::sort(result.begin(), result.end());
  return result;
}

TriangleMesh without_removed_components(const TriangleMesh& mesh, CavityPolicy policy) {
  if (policy == CavityPolicy::keep) return mesh;
  const std::vector<TriangleMesh> parts = components(mesh);
  const std::vector<int> depth = depths(parts);
  const std::vector<std::size_t> of_triangle = component_of_triangle(mesh);
  std::vector<std::size_t> roots = of_triangle;
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  std::vector<Triangle> kept;
  for (FaceId f = 0; f < mesh.triangle_count(); ++f) {
    const auto part = std::lower_bound(roots.begin(), roots.end(), of_triangle[f]) - roots.begin();
    if (depth[static_cast<std::size_t>(part)] == 0) kept.push_back(mesh.triangles[f]);
  }
  return compact(mesh, kept);
}

void expect_promise_kept(const TriangleMesh& before, const ImproveOptions& options) {
  SCOPED_TRACE(describe(options));
  const TriangleMesh reference = without_removed_components(before, options.cavities);
  TriangleMesh after = before;
  const ImproveReport report = improve(after, options);
  EXPECT_TRUE(is_finite(after));
  EXPECT_THAT(after, HasNoIntersections());
  EXPECT_THAT(after, IsClosedManifold());
  EXPECT_LE(degenerate_count(after), degenerate_count(reference));
  EXPECT_THAT(shells(after), ElementsAreArray(shells(reference)));
  if (removed_redundant_points(report)) return;
  EXPECT_EQ(after.triangles, reference.triangles);
  EXPECT_THAT(new_degenerate_triangles(reference, after), IsEmpty());
}

void expect_no_new_fault(const TriangleMesh& before, const ImproveOptions& options) {
  SCOPED_TRACE(describe(options));
  TriangleMesh reference = before;  // turned outwards
  prepare(reference, CavityPolicy::keep);
  const std::vector<FacePair> pairs = intersecting_pairs(reference);
  TriangleMesh after = before;
  const ImproveReport report = improve(after, options);
  EXPECT_TRUE(is_finite(after));
  EXPECT_THAT(after, IsClosedManifold());
  EXPECT_THAT(euler_characteristics(after), ElementsAreArray(euler_characteristics(reference)));
  EXPECT_LE(intersecting_pairs(after).size(), pairs.size());
  EXPECT_LE(degenerate_count(after), degenerate_count(reference));
  if (removed_redundant_points(report)) return;
  EXPECT_EQ(after.triangles, reference.triangles);
  EXPECT_THAT(new_pairs(pairs, after), IsEmpty());
  EXPECT_THAT(new_degenerate_triangles(reference, after), IsEmpty());
}

void expect_same_bytes_for_one_and_two_threads(const TriangleMesh& before, const ImproveOptions& options) {
  SCOPED_TRACE(describe(options));
  std::array<TriangleMesh, 2> results = {before, before};
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    improve(results[threads - 1], options);
  }
  EXPECT_TRUE(is_same(results[0], results[1]));
}

ImproveOptions combination(std::size_t index) {
  const auto next_digit = [&index](std::size_t base) {
    const std::size_t digit = index % base;
    index /= base;
    return digit;
  };
  constexpr std::array kSteps = {StepRule::umbrella, StepRule::volume_preserving, StepRule::tangential};
  ImproveOptions options;
  options.smoothing.step = kSteps[next_digit(kSteps.size())];
  options.cavities = next_digit(2) == 0 ? CavityPolicy::keep : CavityPolicy::delete_cavities;
  options.smoothing.keeps_angles = next_digit(2) == 1;
  const bool is_eager = next_digit(2) == 0;
  if (is_eager) {
    options.smoothing.thresholds = {0.9, 50};
    options.smoothing.rounds = 20;
  }
  const std::size_t redundant = next_digit(3);
  options.deletes_redundant_points = redundant > 0;
  if (redundant == 2) options.redundant = {1e-3, true};
  return options;
}

std::string describe(const ImproveOptions& options) {
  constexpr std::array kSteps = {"umbrella", "volume_preserving", "tangential"};
  return fmt::format("step {}, cavities {}, angles {}, edge ratio {}, {} rounds, redundant points {} {}{}",
                     kSteps[static_cast<std::size_t>(options.smoothing.step)], options.cavities == CavityPolicy::keep ? "kept" : "deleted",
                     options.smoothing.keeps_angles ? "kept" : "free", options.smoothing.thresholds.edge_ratio, options.smoothing.rounds,
                     options.deletes_redundant_points ? "deleted" : "kept", options.redundant.tolerance,
                     options.redundant.is_tolerance_relative ? "rel" : "");
}

}  // namespace smopt::testing
