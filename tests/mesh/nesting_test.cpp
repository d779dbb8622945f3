#include "smopt/mesh/nesting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "tests/mesh/meshes.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Nesting nesting_of(const TriangleMesh& mesh) {
  return component_nesting(mesh, connected_components(mesh));
}

TriangleMesh three_shells() {
  return joined(joined(icosphere(2, 3), icosphere(2, 2)), icosphere(2, 1));
}

TEST(Nesting, ShellsInShells) {
  const Nesting nesting = nesting_of(three_shells());
  EXPECT_THAT(nesting.depth, ElementsAre(0, 1, 2));
  EXPECT_THAT(nesting.enclosing, ElementsAre(IsEmpty(), ElementsAre(0), ElementsAre(0, 1)));
}

TEST(Nesting, TheOrderOfTheComponentsDoesNotMatter) {
  const Nesting nesting = nesting_of(joined(joined(icosphere(2, 1), icosphere(2, 3)), icosphere(2, 2)));
  EXPECT_THAT(nesting.depth, ElementsAre(2, 0, 1));
  EXPECT_THAT(nesting.enclosing, ElementsAre(ElementsAre(1, 2), IsEmpty(), ElementsAre(1)));
}

TEST(Nesting, TwoCavitiesAndANeighbour) {
  const TriangleMesh cavities = joined(icosphere(1, 0.5, {1, 0, 0}), icosphere(1, 0.5, {-1, 0, 0}));
  const TriangleMesh mesh = joined(joined(icosphere(3, 3), cavities), icosphere(2, 1, {9, 0, 0}));
  const Nesting nesting = nesting_of(mesh);
  EXPECT_THAT(nesting.depth, ElementsAre(0, 1, 1, 0));
  EXPECT_THAT(nesting.enclosing, ElementsAre(IsEmpty(), ElementsAre(0), ElementsAre(0), IsEmpty()));
}

TEST(Nesting, OrientationPlaysNoPart) {
  for (unsigned which = 0; which < 8; ++which) {
    TriangleMesh mesh;
    for (unsigned shell = 0; shell < 3; ++shell) {
      const TriangleMesh sphere = icosphere(2, 3.0 - shell);
      mesh = joined(mesh, (which >> shell & 1) != 0 ? reversed(sphere) : sphere);
    }
    EXPECT_THAT(nesting_of(mesh).depth, ElementsAre(0, 1, 2)) << which;
  }
}

TEST(Nesting, RigidMotionAndScaleKeepIt) {
  const TriangleMesh mesh = joined(three_shells(), icosphere(2, 1, {5, 0, 0}));
  std::mt19937 random(12);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 20; ++i) {
    const Vec3 axis(uniform(random), uniform(random), uniform(random));
    const double scale = std::pow(10.0, 4 * uniform(random));
    const TriangleMesh moved = translated(scaled(rotated(mesh, axis, 6 * uniform(random)), scale), 1e3 * scale * axis);
    EXPECT_THAT(nesting_of(moved).depth, ElementsAre(0, 1, 2, 0)) << "case " << i;
  }
  EXPECT_THAT(nesting_of(translated(mesh, {1e6, -1e6, 1e6})).depth, ElementsAre(0, 1, 2, 0));
}

TEST(Nesting, TheHoleOfATorusIsOutside) {
  const TriangleMesh mesh = joined(joined(torus(3, 1, 40, 20), icosphere(2, 0.5)), icosphere(2, 0.3, {0, 3, 0}));
  EXPECT_THAT(nesting_of(mesh).depth, ElementsAre(0, 0, 1)) << "in the hole, and in the tube";
}

TEST(Nesting, ASlantedSheetOverlapsInItsBoxOnly) {
  // A long thin spindle along the diagonal; the small sphere is within its bounding box and outside it.
  TriangleMesh spindle = rotated(bipyramid(12), {1, -1, 0}, 0.9);
  for (Vec3& p : spindle.points) p = 0.2 * p + 4 * p.sum() * Vec3::Ones();
  EXPECT_THAT(nesting_of(joined(spindle, icosphere(1, 0.1, {3, -3, 0}))).depth, ElementsAre(0, 0));
}

/// An axis-aligned box of lattice cells whose faces are divided into unit squares and these along one or the other diagonal, so that rays
/// from other boxes' vertices go through its vertices, along its edges and in its faces.
struct LatticeBox {
  std::array<int, 3> low, high;

  [[nodiscard]] bool strictly_contains(const LatticeBox& other) const {
    for (int i = 0; i < 3; ++i)
      if (other.low[i] <= low[i] || other.high[i] >= high[i]) return false;
    return true;
  }
  [[nodiscard]] bool is_apart_from(const LatticeBox& other) const {
    for (int i = 0; i < 3; ++i)
      if (other.low[i] > high[i] || other.high[i] < low[i]) return true;
    return false;
  }
};

class BoxBuilder {
 public:
  BoxBuilder(const LatticeBox& box, std::mt19937& random) : box_(box), random_(random) {
    for (int axis = 0; axis < 3; ++axis)
      for (const bool is_high : {false, true}) add_side(axis, is_high);
  }
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }

 private:
  VertexId vertex(const std::array<int, 3>& at) {
    const auto [it, is_new] = ids_.try_emplace(at, static_cast<VertexId>(mesh_.points.size()));
    if (is_new) mesh_.points.emplace_back(at[0], at[1], at[2]);
    return it->second;
  }

  void add_side(int axis, bool is_high) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = box_.low[u]; i < box_.high[u]; ++i) {
      for (int j = box_.low[v]; j < box_.high[v]; ++j) {
        const auto corner = [&](int di, int dj) {
          std::array<int, 3> at{};
          at[axis] = is_high ? box_.high[axis] : box_.low[axis];
          at[u] = i + di;
          at[v] = j + dj;
          return vertex(at);
        };
        add_square({corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}, is_high);
      }
    }
  }

  void add_square(const std::array<VertexId, 4>& q, bool is_anticlockwise) {
    const std::size_t first = random_() % 2;
    for (const std::size_t k : {first, first + 2}) {
      Triangle t{q[k % 4], q[(k + 1) % 4], q[(k + 2) % 4]};
      if (!is_anticlockwise) std::swap(t[1], t[2]);
      mesh_.triangles.push_back(t);
    }
  }

  LatticeBox box_;
  std::mt19937& random_;
  TriangleMesh mesh_;
  std::map<std::array<int, 3>, VertexId> ids_;
};

/// Boxes that are strictly inside or strictly apart from each other; the first `shells` are around all others.
std::vector<LatticeBox> random_boxes(std::mt19937& random, int attempts, int space, int shells) {
  std::vector<LatticeBox> boxes;
  for (int i = -shells; i < 0; ++i) boxes.push_back({{i, i, i}, {2 * space - i, 2 * space - i, 2 * space - i}});
  for (int i = 0; i < attempts; ++i) {
    LatticeBox box{};
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = static_cast<int>(random() % static_cast<unsigned>(space));
      box.high[axis] = box.low[axis] + 1 + static_cast<int>(random() % static_cast<unsigned>(i % 2 == 0 ? space : 2));
    }
    const bool is_fitting = std::ranges::all_of(boxes, [&](const LatticeBox& other) {
      return other.strictly_contains(box) || box.strictly_contains(other) || box.is_apart_from(other);
    });
    if (is_fitting) boxes.push_back(box);
  }
  return boxes;
}

TEST(Nesting, RaysThroughVerticesAndEdgesAreCountedRight) {
  std::map<std::uint32_t, int> seen;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    const std::vector<LatticeBox> boxes = random_boxes(random, 400, 8, static_cast<int>(seed % 3));
    TriangleMesh mesh;
    for (const LatticeBox& box : boxes) mesh = joined(mesh, BoxBuilder(box, random).mesh());
    ASSERT_THAT(mesh, IsClosedManifold());
    const Nesting nesting = nesting_of(mesh);
    ASSERT_EQ(nesting.depth.size(), boxes.size());
    for (std::uint32_t c = 0; c < boxes.size(); ++c) {
      std::vector<std::uint32_t> around;
      for (std::uint32_t other = 0; other < boxes.size(); ++other)
        if (boxes[other].strictly_contains(boxes[c])) around.push_back(other);
      ASSERT_EQ(nesting.enclosing[c], around) << "seed " << seed << ", box " << c;
      ASSERT_EQ(nesting.depth[c], around.size()) << "seed " << seed << ", box " << c;
      ++seen[nesting.depth[c]];
    }
  }
  for (const std::uint32_t depth : {0U, 1U, 2U}) EXPECT_GT(seen[depth], 10) << "hardly any box of depth " << depth;
}

TEST(Nesting, RelabellingKeepsTheDepths) {
  const TriangleMesh mesh = joined(three_shells(), icosphere(2, 1, {9, 0, 0}));
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    std::vector<std::uint32_t> depth = nesting_of(relabelled(mesh, seed)).depth;
    std::ranges::sort(depth);
    EXPECT_THAT(depth, ElementsAre(0, 0, 1, 2)) << "seed " << seed;
  }
}

TEST(Nesting, ThousandsOfComponentsAndAPoleOfManyTriangles) {
  TriangleMesh mesh = scaled(bipyramid(10000), 100);
  for (int i = 0; i < 3000; ++i)
    mesh = joined(mesh, translated(scaled(tetrahedron(), 0.1), {i % 15 - 7.0, i / 15 % 15 - 7.0, i / 225 - 7.0}));
  const Nesting nesting = nesting_of(mesh);
  ASSERT_EQ(nesting.depth.size(), 3001U);
  EXPECT_EQ(nesting.depth[0], 0U);
  for (std::size_t c = 1; c < nesting.depth.size(); ++c) ASSERT_EQ(nesting.depth[c], 1U) << "component " << c;
}

TEST(Nesting, OfNothing) {
  EXPECT_THAT(nesting_of({}).depth, IsEmpty());
}

}  // namespace
}  // namespace smopt
