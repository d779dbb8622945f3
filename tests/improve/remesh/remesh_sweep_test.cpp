#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "metrics/union_find.h"
#include "smopt/improve/remesh/remesh.h"
#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/improve/remesh/shape_judge.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

/// Nothing passes through anything, even where both ends of every operation are free of intersections.
namespace smopt {
namespace {

using namespace testing;
using ::testing::Each;

TriangleMesh remeshed(TriangleMesh mesh, const RemeshOptions& options) {
  remesh(mesh, options);
  return mesh;
}

/// Options that move and replace much: many rounds, coarser, finer, shrinking.
std::vector<RemeshOptions> rough_options(std::size_t vertices) {
  RemeshOptions coarse, fine, shrinking;
  coarse.vertices = vertices / 4;
  coarse.rounds = 10;
  fine.vertices = 2 * vertices;
  shrinking.preserves_volume = false;
  shrinking.rounds = 30;
  return {RemeshOptions{}, coarse, fine, shrinking};
}

// ---- Links ----

using Loop = std::vector<Vec3>;
using Edge = std::pair<VertexId, VertexId>;

/// How often one closed polygon winds around another: the Gauss integral, exact for each pair of segments (Klenin and Langowski, Computation
/// of writhe in modeling of supercoiled DNA, 2000).
double linking_number(const Loop& a, const Loop& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Vec3 &a0 = a[i], &a1 = a[(i + 1) % a.size()], &b0 = b[j], &b1 = b[(j + 1) % b.size()];
      const Vec3 r00 = b0 - a0, r01 = b1 - a0, r10 = b0 - a1, r11 = b1 - a1;
      const std::array<Vec3, 4> n = {r00.cross(r01).normalized(), r01.cross(r11).normalized(), r11.cross(r10).normalized(),
                                     r10.cross(r00).normalized()};
      double area = 0;
      for (std::size_t k = 0; k < 4; ++k) area += std::asin(std::clamp(n[k].dot(n[(k + 1) % 4]), -1.0, 1.0));
      const double side = (b1 - b0).cross(a1 - a0).dot(r00);
      sum += side > 0 ? area : (side < 0 ? -area : 0);
    }
  }
  return sum / (4 * std::numbers::pi);
}

/// Loops along edges that generate the first homology of a closed surface, two for each handle: the edges that are neither in a spanning tree
/// of the vertices nor crossed by one of the triangles, closed through the first tree.
class Handles {
 public:
  explicit Handles(const TriangleMesh& mesh) : mesh_(mesh), parent_(mesh.vertex_count(), kNone) { grow_tree(); }

  [[nodiscard]] std::vector<Loop> loops() const {
    std::map<Edge, FaceId> left;
    for (FaceId f = 0; f < mesh_.triangle_count(); ++f)
      for (int i = 0; i < 3; ++i) left[{mesh_.triangles[f][i], mesh_.triangles[f][(i + 1) % 3]}] = f;
    metrics::UnionFind dual(mesh_.triangle_count());
    std::vector<Loop> result;
    for (const auto& [edge, f] : left) {
      const auto [v, w] = edge;
      if (v > w || parent_[v] == w || parent_[w] == v) continue;
      const FaceId g = left.at({w, v});
      if (dual.root(f) != dual.root(g))
        dual.unite(f, g);
      else
        result.push_back(loop_through(v, w));
    }
    return result;
  }

 private:
  static constexpr VertexId kNone = ~VertexId{0};

  void grow_tree() {
    std::map<VertexId, std::vector<VertexId>> neighbours;
    for (const Triangle& t : mesh_.triangles)
      for (int i = 0; i < 3; ++i) neighbours[t[i]].push_back(t[(i + 1) % 3]);
    std::vector<VertexId> queue = {mesh_.triangles[0][0]};
    parent_[queue[0]] = queue[0];
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const VertexId w : neighbours[queue[i]]) {
        if (parent_[w] != kNone) continue;
        parent_[w] = queue[i];
        queue.push_back(w);
      }
    }
  }

  [[nodiscard]] std::vector<VertexId> path_to_root(VertexId v) const {
    std::vector<VertexId> path = {v};
    while (parent_[path.back()] != path.back()) path.push_back(parent_[path.back()]);
    return path;
  }

  [[nodiscard]] Loop loop_through(VertexId v, VertexId w) const {
    std::vector<VertexId> there = path_to_root(v), back = path_to_root(w);
    while (there.size() > 1 && back.size() > 1 && there[there.size() - 2] == back[back.size() - 2]) {
      there.pop_back();
      back.pop_back();
    }
    back.pop_back();  // the common vertex
    there.insert(there.end(), back.rbegin(), back.rend());
    Loop loop;
    for (const VertexId u : there) loop.push_back(mesh_.points[u]);
    return loop;
  }

  const TriangleMesh& mesh_;
  std::vector<VertexId> parent_;
};

/// How often two tori are linked: all loops of one with all loops of the other have numbers that are multiples of it.
long linking_of_tori(const TriangleMesh& a, const TriangleMesh& b) {
  const std::vector<Loop> loops_a = Handles(a).loops(), loops_b = Handles(b).loops();
  EXPECT_EQ(loops_a.size(), 2U);
  EXPECT_EQ(loops_b.size(), 2U);
  long result = 0;
  for (const Loop& x : loops_a) {
    for (const Loop& y : loops_b) {
      const double number = linking_number(x, y);
      EXPECT_NEAR(number, std::round(number), 1e-6);
      result = std::gcd(result, std::lround(number));
    }
  }
  return result;
}

long linking(const TriangleMesh& two_tori) {
  const std::vector<TriangleMesh> parts = components_of(two_tori);
  EXPECT_EQ(parts.size(), 2U);
  return linking_of_tori(parts[0], parts[1]);
}

TEST(RemeshSweep, LeavesLinkedRingsLinkedAndOthersNot) {
  const TriangleMesh apart = joined(torus(1, 0.25, 24, 10), translated(torus(1, 0.25, 24, 10), {2.6, 0, 0}));
  ASSERT_EQ(linking(linked_rings()), 1);
  ASSERT_EQ(linking(apart), 0);
  for (const RemeshOptions& options : rough_options(apart.vertex_count())) {
    EXPECT_EQ(linking(remeshed(linked_rings(), options)), 1);
    EXPECT_EQ(linking(remeshed(apart, options)), 0);
  }
}

TEST(RemeshSweep, LeavesThinRingsThatNearlyTouchLinked) {
  // Each ring passes the other's inner side at a hundredth of its radius.
  const TriangleMesh ring = torus(1, 0.3, 30, 8);
  const TriangleMesh rings = joined(ring, translated(rotated(ring, {1, 0, 0}, std::numbers::pi / 2), {0.7, 0, 0}));
  const TriangleMesh close = joined(ring, translated(rotated(ring, {1, 0, 0}, std::numbers::pi / 2), {1.35, 0, 0}));
  for (const TriangleMesh& before : {rings, close}) {
    if (!intersecting_pairs(before).empty()) continue;
    for (const RemeshOptions& options : rough_options(before.vertex_count())) {
      const TriangleMesh after = remeshed(before, options);
      EXPECT_EQ(linking(after), linking(before));
      EXPECT_THAT(after, HasNoIntersections());
    }
  }
}

// ---- What lies in what ----

/// How many other components enclose each, sorted.
std::vector<int> nesting(const TriangleMesh& mesh) {
  const std::vector<TriangleMesh> parts = components_of(mesh);
  std::vector<int> result(parts.size(), 0);
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < parts.size(); ++j)
      if (i != j) result[i] += static_cast<int>(std::lround(std::abs(winding_number(parts[j], parts[i].points[0]))));
  std::sort(result.begin(), result.end());
  return result;
}

TEST(RemeshSweep, LeavesASpeckInItsNeedle) {
  const TriangleMesh before = needles_with_a_speck_in_one();
  ASSERT_THAT(nesting(before), ::testing::ElementsAre(0, 1));
  for (const RemeshOptions& options : rough_options(before.vertex_count())) {
    const TriangleMesh after = remeshed(before, options);
    EXPECT_EQ(nesting(after), nesting(before));
    EXPECT_THAT(after, HasNoIntersections());
  }
}

TEST(RemeshSweep, LeavesThingsInADentOutside) {
  const TriangleMesh before = dents_with_things_in_one();
  ASSERT_THAT(nesting(before), ::testing::ElementsAre(0, 0, 0));
  for (const RemeshOptions& options : rough_options(before.vertex_count())) EXPECT_EQ(nesting(remeshed(before, options)), nesting(before));
}

TEST(RemeshSweep, KeepsTheNestingOfSpheres) {
  TriangleMesh before = icosphere(2);
  for (int depth = 1; depth < 6; ++depth) {
    const TriangleMesh shell = noisy(icosphere(depth % 3, std::pow(0.75, depth)), 0.01, static_cast<std::uint32_t>(depth));
    before = joined(before, depth % 2 == 1 ? reversed(shell) : shell);
  }
  ASSERT_THAT(before, HasNoIntersections());
  ASSERT_THAT(nesting(before), ::testing::ElementsAre(0, 1, 2, 3, 4, 5));
  for (const RemeshOptions& options : rough_options(before.vertex_count())) {
    const TriangleMesh after = remeshed(before, options);
    EXPECT_EQ(nesting(after), nesting(before));
    EXPECT_THAT(after, HasNoIntersections());
  }
}

// ---- Order of sheets ----

/// The heights at which a vertical line meets a surface, or none where it comes near an edge.
std::vector<double> heights_at(const TriangleMesh& mesh, double x, double y) {
  std::vector<double> heights;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const auto area = [](double px, double py, const Vec3& q, const Vec3& r) {
      return (q.x() - px) * (r.y() - py) - (q.y() - py) * (r.x() - px);
    };
    const double u = area(x, y, b, c), v = area(x, y, c, a), w = area(x, y, a, b), whole = u + v + w;
    if (whole != 0 && u / whole > 0 && v / whole > 0 && w / whole > 0) heights.push_back((u * a.z() + v * b.z() + w * c.z()) / whole);
  }
  return heights;
}

TEST(RemeshSweep, KeepsTheOrderOfPlatesOnANoisySheet) {
  for (const double gap : {0.1, 1e-3, 1e-6}) {
    const TriangleMesh before = plates_on_a_noisy_sheet(gap, 3);
    if (!intersecting_pairs(before).empty()) continue;
    for (const RemeshOptions& options : rough_options(before.vertex_count())) {
      const TriangleMesh after = remeshed(before, options);
      std::vector<TriangleMesh> parts = components_of(after);
      ASSERT_EQ(parts.size(), 2U);
      const auto mean_height = [](const TriangleMesh& mesh) {
        return std::accumulate(mesh.points.begin(), mesh.points.end(), 0.0, [](double sum, const Vec3& p) { return sum + p.z(); }) /
               static_cast<double>(mesh.points.size());
      };
      if (mean_height(parts[0]) > mean_height(parts[1])) std::swap(parts[0], parts[1]);
      int lines = 0;
      for (double x = 1.03; x < 7; x += 0.37) {
        for (double y = 1.07; y < 7; y += 0.41) {
          const std::vector<double> lower = heights_at(parts[0], x, y), upper = heights_at(parts[1], x, y);
          if (lower.empty() || upper.empty()) continue;
          EXPECT_LT(*std::max_element(lower.begin(), lower.end()), *std::min_element(upper.begin(), upper.end()));
          ++lines;
        }
      }
      if (options.preserves_volume) {
        EXPECT_GT(lines, 100);  // otherwise the plates shrink
      }
      EXPECT_THAT(after, HasNoIntersections());
    }
  }
}

}  // namespace
}  // namespace smopt
