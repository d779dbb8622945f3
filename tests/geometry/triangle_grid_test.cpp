#include "smopt/geometry/triangle_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;
using ::testing::ElementsAreArray;
using ::testing::IsEmpty;

/// A grid beside a plain list of the same boxes.
class Checked {
 public:
  explicit Checked(const TriangleMesh& mesh) : grid_(mesh.points, mesh.triangles) {
    for (const auto& [a, b, c] : mesh.triangles) boxes_.push_back(grid_.box_of(mesh.points[a], mesh.points[b], mesh.points[c]));
  }

  [[nodiscard]] const TriangleGrid& grid() const { return grid_; }
  [[nodiscard]] std::size_t size() const { return boxes_.size(); }

  void move(std::uint32_t f, const Box& box) {
    grid_.move(f, box);
    boxes_[f] = box;
  }
  void remove(std::uint32_t f) {
    grid_.remove(f);
    boxes_[f] = Box{};
  }

  [[nodiscard]] std::vector<std::uint32_t> visited(const Box& query) const {
    std::vector<std::uint32_t> faces;
    grid_.for_overlapping(query, [&](std::uint32_t f) { faces.push_back(f); });
    std::sort(faces.begin(), faces.end());
    return faces;
  }
  [[nodiscard]] std::vector<std::uint32_t> overlapping(const Box& query) const {
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = 0; f < boxes_.size(); ++f)
      if (boxes_[f].overlaps(query)) faces.push_back(f);
    return faces;
  }

 private:
  TriangleGrid grid_;
  std::vector<Box> boxes_;
};

class RandomBoxes {
 public:
  explicit RandomBoxes(std::uint32_t seed) : random_(seed) {}

  Vec3 vector() { return {uniform_(random_), uniform_(random_), uniform_(random_)}; }
  /// A box of up to `size` somewhere within `extent` of `center`, in the grid's frame.
  Box operator()(const TriangleGrid& grid, const Vec3& center, double extent, double size) {
    const Vec3 low = center + extent * vector();
    return grid.box_of(low, low + 0.5 * size * (vector() + Vec3::Ones()));
  }
  std::uint32_t index(std::size_t count) { return static_cast<std::uint32_t>(random_() % count); }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// Random queries of several sizes give exactly the list's answer, each triangle once.
void expect_same_answers(const Checked& checked, RandomBoxes& random, const Vec3& center, double extent, int queries) {
  std::size_t found = 0;
  for (int i = 0; i < queries; ++i) {
    const Box query = random(checked.grid(), center, 1.2 * extent, extent * std::pow(10.0, -(i % 4)));
    const auto expected = checked.overlapping(query);
    found += expected.size();
    ASSERT_THAT(checked.visited(query), ElementsAreArray(expected)) << "query " << i;
  }
  for (std::uint32_t f = 0; f < checked.size(); f += 7) {
    const auto expected = checked.overlapping(checked.grid().box(f));
    found += expected.size();
    ASSERT_THAT(checked.visited(checked.grid().box(f)), ElementsAreArray(expected)) << "face " << f;
  }
  EXPECT_GT(found, 0U);
}

TEST(TriangleGrid, FindsExactlyTheOverlappingTrianglesOnce) {
  for (const double radius : {1e-3, 1.0, 1e5}) {
    for (const Vec3& center : {Vec3(0, 0, 0), Vec3(1e6, -1e6, 1e6)}) {
      const Checked checked(icosphere(3, radius, center));
      RandomBoxes random(1);
      expect_same_answers(checked, random, center, radius, 200);
    }
  }
}

TEST(TriangleGrid, BoxesContainTheTrianglesFarFromTheOrigin) {
  const TriangleMesh mesh = icosphere(2, 1, Vec3(1e6, 1e6, 1e6));
  const Checked checked(mesh);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const VertexId v : mesh.triangles[f]) {
      const Vec3 p = mesh.points[v] - checked.grid().origin();
      for (int i = 0; i < 3; ++i) {
        EXPECT_LE(double{checked.grid().box(f).low[i]}, p[i]);
        EXPECT_GE(double{checked.grid().box(f).high[i]}, p[i]);
      }
    }
    EXPECT_LT(checked.grid().box(f).high[0] - checked.grid().box(f).low[0], 0.7F) << "blurred by the distance";
  }
}

TEST(TriangleGrid, StaysExactThroughThousandsOfMovesAndRemovals) {
  Checked checked(icosphere(3));
  RandomBoxes random(2);
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 300; ++i) {
      const std::uint32_t f = random.index(checked.size());
      if (i % 50 == 0) {
        checked.remove(f);
        continue;
      }
      // Mostly a small step, now and then across the whole space, growing, shrinking, or far outside it.
      const double reach = i % 10 == 0 ? 5 : (i % 3 == 0 ? 1 : 0.1);
      checked.move(f, random(checked.grid(), 0.9 * random.vector(), reach, 0.2 * reach));
    }
    expect_same_answers(checked, random, Vec3::Zero(), 1.5, 40);
    ASSERT_FALSE(HasFatalFailure()) << "round " << round;
  }
}

TEST(TriangleGrid, MovesFarOutsideTheFirstExtentAreFound) {
  Checked checked(icosphere(2));
  RandomBoxes random(3);
  for (std::uint32_t f = 0; f < checked.size(); f += 3) checked.move(f, random(checked.grid(), Vec3::Zero(), 1e9, 1e8));
  expect_same_answers(checked, random, Vec3::Zero(), 1e9, 100);
  expect_same_answers(checked, random, Vec3::Zero(), 1, 100);
}

TEST(TriangleGrid, ATriangleThatStandsStillIsNotLostByMoving) {
  Checked checked(icosphere(2));
  for (std::uint32_t f = 0; f < checked.size(); ++f) checked.move(f, checked.grid().box(f));
  RandomBoxes random(4);
  expect_same_answers(checked, random, Vec3::Zero(), 1, 100);
}

TEST(TriangleGrid, ClustersFarApart) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh = joined(mesh, icosphere(2, 1, 1e7 * Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1)));
  const Checked checked(mesh);
  RandomBoxes random(5);
  expect_same_answers(checked, random, Vec3::Zero(), 1, 100);
  expect_same_answers(checked, random, Vec3::Constant(1e7), 1, 100);
  expect_same_answers(checked, random, Vec3::Constant(0.5e7), 1e7, 100);
}

TEST(TriangleGrid, HugeTrianglesAmongSmallOnes) {
  TriangleMesh mesh = icosphere(3);
  mesh = joined(mesh, scaled(tetrahedron(), 1e4));
  mesh = joined(mesh, {{{-50, -50, 0.1}, {50, -50, 0.1}, {0, 50, 0.1}}, {{0, 1, 2}}});
  Checked checked(mesh);
  RandomBoxes random(6);
  expect_same_answers(checked, random, Vec3::Zero(), 1, 100);
  expect_same_answers(checked, random, Vec3::Zero(), 1e4, 100);
  // A small triangle grows over everything, and the huge ones shrink.
  checked.move(0, checked.grid().box_of(Vec3::Constant(-1e4), Vec3::Constant(1e4)));
  for (std::uint32_t f = static_cast<std::uint32_t>(checked.size()) - 5; f < checked.size(); ++f)
    checked.move(f, random(checked.grid(), Vec3::Zero(), 1, 0.1));
  expect_same_answers(checked, random, Vec3::Zero(), 1, 100);
}

TEST(TriangleGrid, SmallOrFlatOrDegenerateInput) {
  const TriangleMesh point{std::vector<Vec3>(3, Vec3(7, 7, 7)), {{0, 1, 2}}};
  const TriangleMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};
  for (const TriangleMesh& mesh : {point, flat, tetrahedron()}) {
    Checked checked(mesh);
    RandomBoxes random(7);
    expect_same_answers(checked, random, mesh.points[0], 2, 200);
    checked.move(0, random(checked.grid(), mesh.points[0], 3, 1));
    expect_same_answers(checked, random, mesh.points[0], 3, 200);
  }
}

TEST(TriangleGrid, NothingIsFoundInAnEmptyGrid) {
  const Checked none({});
  EXPECT_THAT(none.visited(make_box(Vec3::Constant(-1), Vec3::Constant(1))), IsEmpty());
}

TEST(TriangleGrid, ARemovedTriangleIsNeverFound) {
  Checked checked(icosphere(1));
  const Box everything = checked.grid().box_of(Vec3::Constant(-9), Vec3::Constant(9));
  for (std::uint32_t f = 0; f < checked.size(); ++f) checked.remove(f);
  EXPECT_THAT(checked.visited(everything), IsEmpty());
}

}  // namespace
}  // namespace smopt
