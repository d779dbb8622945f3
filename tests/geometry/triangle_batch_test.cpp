#include "smopt/geometry/triangle_batch.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "smopt/mesh/triangle_mesh.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;
using ::testing::ElementsAreArray;
using ::testing::IsEmpty;

/// A mesh, its grid, and copies of parts of it.
class Checked {
 public:
  explicit Checked(const TriangleMesh& mesh) : mesh_(mesh), grid_(mesh.points, mesh.triangles) {}

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] TriangleBatch& batch() { return batch_; }
  [[nodiscard]] Box box(std::size_t f) const {
    const auto [a, b, c] = mesh_.triangles[f];
    return grid_.box_of(mesh_.points[a], mesh_.points[b], mesh_.points[c]);
  }
  /// The box around a point in the grid's frame.
  [[nodiscard]] Box around(const Vec3& point, double half_edge) const {
    return grid_.box_of(Vec3(point - Vec3::Constant(half_edge)), Vec3(point + Vec3::Constant(half_edge)));
  }

  void gather(const Box& space, const Vec3& center) {
    space_ = space;
    batch_.gather(grid_, mesh_.points, mesh_.triangles, space, center);
  }

  /// The triangles near the box, in the order of the batch. None of them misses it by more than a step of the space.
  [[nodiscard]] std::vector<std::uint32_t> near(const Box& query) {
    Box wider = query;
    for (int axis = 0; axis < 3; ++axis) {
      const float step = (space_.high[axis] - space_.low[axis]) / 60000;
      wider.low[axis] -= step;
      wider.high[axis] += step;
    }
    std::vector<std::uint32_t> faces;
    for (const std::uint32_t i : batch_.near(query)) {
      faces.push_back(batch_[i].face);
      EXPECT_TRUE(box(faces.back()).overlaps(wider)) << "face " << faces.back();
    }
    return faces;
  }
  /// Those of them whose boxes overlap the box.
  [[nodiscard]] std::vector<std::uint32_t> visited(const Box& query) {
    std::vector<std::uint32_t> faces = near(query);
    std::erase_if(faces, [&](std::uint32_t f) { return !box(f).overlaps(query); });
    return faces;
  }
  [[nodiscard]] std::vector<std::uint32_t> sorted(std::vector<std::uint32_t> faces) const {
    std::sort(faces.begin(), faces.end());
    return faces;
  }
  [[nodiscard]] std::vector<std::uint32_t> overlapping(const Box& query) const {
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = 0; f < mesh_.triangle_count(); ++f)
      if (box(f).overlaps(query)) faces.push_back(f);
    return faces;
  }

  /// Moves a vertex in the mesh and in the batch, whose space must hold its triangles before and after.
  void move(VertexId v, const Vec3& to) {
    std::vector<std::size_t> entries;
    for (const std::uint32_t i : batch_.near(around_star(v)))
      if (std::ranges::count(batch_[i].corners, v) > 0) entries.push_back(i);
    mesh_.points[v] = to;
    for (const std::size_t i : entries) batch_.move_corner(i, v, to, box(batch_[i].face));
  }
  [[nodiscard]] Box around_star(VertexId v) const {
    Box whole;
    for (std::uint32_t f = 0; f < mesh_.triangle_count(); ++f)
      if (std::ranges::count(mesh_.triangles[f], v) > 0) whole.unite(box(f));
    return whole;
  }

 private:
  TriangleMesh mesh_;
  TriangleGrid grid_;
  TriangleBatch batch_;
  Box space_;
};

class Random {
 public:
  explicit Random(std::uint32_t seed) : random_(seed) {}
  double number() { return uniform_(random_); }
  Vec3 vector() { return {number(), number(), number()}; }
  std::uint32_t index(std::size_t count) { return static_cast<std::uint32_t>(random_() % count); }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

void expect_entries_of_the_mesh(Checked& checked, const Box& space) {
  TriangleBatch& batch = checked.batch();
  float largest = 0;
  for (const std::uint32_t i : batch.near(space)) {
    const TriangleBatch::Entry& entry = batch[i];
    EXPECT_EQ(entry.corners, checked.mesh().triangles[entry.face]);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Vec3 exact = checked.mesh().points[entry.corners[std::min<std::size_t>(lane, 2)]] - batch.center();
      const Eigen::Vector3f kept(entry.x[lane], entry.y[lane], entry.z[lane]);
      EXPECT_EQ(kept, exact.cast<float>()) << "face " << entry.face << ", lane " << lane;
      largest = std::max(largest, kept.cwiseAbs().maxCoeff());
    }
  }
  EXPECT_GE(batch.radius(), largest);
}

/// Meshes at different scales and places.
std::vector<TriangleMesh> meshes() {
  const TriangleMesh mesh = joined(noisy(icosphere(3), 0.03, 4), noisy(torus(2, 0.3, 30, 9), 0.03, 5));
  return {mesh, scaled(mesh, 1e-6), translated(scaled(mesh, 1e6), {1e6, 2e6, -1e6}), translated(mesh, {1e6, 0, -1e6})};
}

double size_of(const TriangleMesh& mesh) {
  Vec3 low = mesh.points[0], high = low;
  for (const Vec3& p : mesh.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).maxCoeff();
}

TEST(TriangleBatch, HasEveryTriangleThatOverlapsTheSpaceOnceAndNoOther) {
  Random random(1);
  for (const TriangleMesh& mesh : meshes()) {
    Checked checked(mesh);
    for (int i = 0; i < 40; ++i) {
      const Vec3 center = mesh.points[random.index(mesh.vertex_count())] + 0.02 * size_of(mesh) * random.vector();
      const Box space = checked.around(center, size_of(mesh) * std::pow(10.0, -3 * std::abs(random.number())));
      checked.gather(space, center);
      EXPECT_EQ(checked.batch().center(), center);
      ASSERT_EQ(checked.sorted(checked.visited(space)), checked.overlapping(space));
      expect_entries_of_the_mesh(checked, space);
    }
  }
}

TEST(TriangleBatch, VisitsTheTrianglesWhoseBoxesOverlap) {
  Random random(2);
  for (const TriangleMesh& mesh : meshes()) {
    Checked checked(mesh);
    for (int i = 0; i < 10; ++i) {
      const Vec3 center = mesh.points[random.index(mesh.vertex_count())];
      const double half_edge = 0.15 * size_of(mesh);
      const Box space = checked.around(center, half_edge);
      checked.gather(space, center);
      for (int j = 0; j < 30; ++j) {
        const double part = std::abs(random.number());
        const Box query = checked.around(center + 0.99 * (1 - part) * half_edge * random.vector(), 0.99 * part * half_edge);
        ASSERT_TRUE(checked.batch().covers(query));
        EXPECT_EQ(checked.sorted(checked.visited(query)), checked.overlapping(query));
      }
    }
  }
}

TEST(TriangleBatch, CoversTheBoxesWithinItsSpaceItsOwnIncluded) {
  const TriangleMesh mesh = icosphere(2);
  Checked checked(mesh);
  const Box space = checked.around(mesh.points[0], 0.3);
  checked.gather(space, mesh.points[0]);
  EXPECT_TRUE(checked.batch().covers(space));
  EXPECT_TRUE(checked.batch().covers(checked.around(mesh.points[0], 0.29)));
  for (int axis = 0; axis < 3; ++axis) {
    Box wider = space;
    wider.high[axis] = std::nextafter(wider.high[axis], INFINITY);
    EXPECT_FALSE(checked.batch().covers(wider)) << "above, axis " << axis;
    wider = space;
    wider.low[axis] = std::nextafter(wider.low[axis], -INFINITY);
    EXPECT_FALSE(checked.batch().covers(wider)) << "below, axis " << axis;
  }
}

TEST(TriangleBatch, CoversNothingBeforeItIsFilledAndAfterItIsCleared) {
  const TriangleMesh mesh = icosphere(2);
  Checked checked(mesh);
  TriangleBatch batch;
  const Box small = checked.around(mesh.points[0], 1e-3);
  EXPECT_FALSE(batch.covers(small));
  const TriangleGrid grid(mesh.points, mesh.triangles);
  batch.gather(grid, mesh.points, mesh.triangles, checked.around(mesh.points[0], 0.3), mesh.points[0]);
  EXPECT_TRUE(batch.covers(small));
  batch.clear();
  EXPECT_FALSE(batch.covers(small));
}

TEST(TriangleBatch, ForgetsWhatItHadBefore) {
  const TriangleMesh mesh = joined(icosphere(2), translated(icosphere(1), {10, 0, 0}));
  Checked checked(mesh);
  const Box first = checked.around({0, 0, 0}, 2), second = checked.around({10, 0, 0}, 2), nothing = checked.around({5, 0, 0}, 1);
  checked.gather(first, {0, 0, 0});
  const float radius_of_first = checked.batch().radius();
  checked.gather(second, {10, 0, 0});
  EXPECT_EQ(checked.visited(second).size(), 80U);
  EXPECT_FALSE(checked.batch().covers(checked.around({0, 0, 0}, 1)));
  checked.gather(nothing, {5, 0, 0});
  EXPECT_THAT(checked.visited(nothing), IsEmpty());
  checked.gather(first, {0, 0, 0});
  EXPECT_EQ(checked.visited(first).size(), 320U);
  EXPECT_EQ(checked.batch().radius(), radius_of_first);
}

TEST(TriangleBatch, NamesEachEntryOnceInAscendingOrder) {
  const TriangleMesh mesh = icosphere(2);
  Checked checked(mesh);
  const Box space = checked.around({0, 0, 0}, 2);
  checked.gather(space, {0, 0, 0});
  const std::span<const std::uint32_t> all = checked.batch().near(space);
  ASSERT_EQ(all.size(), mesh.triangle_count());
  for (std::uint32_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], i);
  EXPECT_TRUE(checked.batch().near(checked.around({0, 0, 0}, 0.1)).empty());
}

TEST(TriangleBatch, VisitsInTheSameOrderEveryTime) {
  const TriangleMesh mesh = noisy(icosphere(3), 0.03, 1);
  Checked first(mesh), second(mesh);
  const Box space = first.around(mesh.points[5], 0.5);
  second.gather(second.around(mesh.points[9], 0.2), mesh.points[9]);
  first.gather(space, mesh.points[5]);
  second.gather(space, mesh.points[5]);
  EXPECT_THAT(first.visited(space), ElementsAreArray(second.visited(space)));
}

TEST(TriangleBatch, KnowsWhereCornersHaveMoved) {
  Random random(3);
  for (const TriangleMesh& mesh : meshes()) {
    Checked checked(mesh);
    const Vec3 center = mesh.points[7];
    const double half_edge = 0.3 * size_of(mesh);
    const Box space = checked.around(center, half_edge);
    checked.gather(space, center);
    int moves = 0;
    for (int i = 0; i < 400; ++i) {
      const VertexId v = random.index(mesh.vertex_count());
      const Vec3 to = checked.mesh().points[v] + 0.05 * size_of(mesh) * random.vector();
      if (!checked.batch().covers(checked.around(to, 0)) || !checked.batch().covers(checked.around_star(v))) continue;
      ++moves;
      checked.move(v, to);
      if (i % 20 != 0) continue;
      expect_entries_of_the_mesh(checked, space);
      for (int j = 0; j < 10; ++j) {
        const Box query = checked.around(center + 0.4 * half_edge * random.vector(), 0.5 * half_edge * std::abs(random.number()));
        ASSERT_EQ(checked.sorted(checked.visited(query)), checked.overlapping(query)) << "after " << moves << " moves";
      }
    }
    EXPECT_GT(moves, 30);
  }
}

TEST(TriangleBatch, TheRadiusBoundsCornersThatHaveMovedOutwardsToo) {
  Checked checked(icosphere(0));
  const Box space = checked.around({0, 0, 0}, 50);
  checked.gather(space, {0, 0, 0});
  checked.move(3, 40 * checked.mesh().points[3]);
  expect_entries_of_the_mesh(checked, space);
}

TEST(TriangleBatch, ATriangleTakenOutOfTheGridIsNotCopied) {
  const TriangleMesh mesh = icosphere(1);
  TriangleGrid grid(mesh.points, mesh.triangles);
  grid.remove(17);
  TriangleBatch batch;
  const Box space = grid.box_of(Vec3(Vec3::Constant(-2)), Vec3(Vec3::Constant(2)));
  batch.gather(grid, mesh.points, mesh.triangles, space, Vec3::Zero());
  std::set<std::uint32_t> faces;
  for (const std::uint32_t i : batch.near(space)) faces.insert(batch[i].face);
  EXPECT_EQ(faces.size(), mesh.triangle_count() - 1);
  EXPECT_EQ(faces.count(17), 0U);
}

}  // namespace
}  // namespace smopt
