#include "smopt/improve/remesh/triangle_tree.h"

#include <algorithm>
#include <numeric>

#include <oneapi/tbb/parallel_invoke.h>

#include "smopt/parallel.h"

namespace smopt {
namespace {

/// Levels of a tree of 2³² triangles, with one to spare.
constexpr std::size_t kMostLevels = 34;
/// Below so many triangles, a part of the tree is built by one thread.
constexpr std::uint32_t kSmallPart = 4096;

struct Frame {
  Vec3 origin = Vec3::Zero();
  double extent = 0;
};

/// Around the points that triangles use.
Frame frame_of(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  Vec3 low = mesh.points[mesh.triangles[0][0]], high = low;
  for (const Triangle& t : mesh.triangles) {
    for (const VertexId v : t) {
      low = low.cwiseMin(mesh.points[v]);
      high = high.cwiseMax(mesh.points[v]);
    }
  }
  const Vec3 origin = 0.5 * (low + high);
  return {origin, std::max((high - origin).maxCoeff(), (origin - low).maxCoeff())};
}

Box box_of(const Corners& t) {
  return triangle_box(t[0], t[1], t[2]);
}

/// Divides a part of the triangles into leaves, and gives each node its box on the way back.
class Builder {
 public:
  Builder(const std::vector<Corners>& triangles, std::vector<std::uint32_t>& order, std::uint32_t first_leaf, std::vector<Box>& boxes,
          std::vector<std::uint32_t>& leaf_begin)
      : triangles_(triangles), order_(order), first_leaf_(first_leaf), boxes_(boxes), leaf_begin_(leaf_begin) {}

  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
    if (node >= first_leaf_) return finish_leaf(node, begin, end);
    const std::uint32_t middle = begin + (end - begin) / 2;
    halve(begin, middle, end);
    const auto build_first = [&] { build(2 * node + 1, begin, middle); };
    const auto build_second = [&] { build(2 * node + 2, middle, end); };
    if (end - begin > kSmallPart) {
      tbb::parallel_invoke(build_first, build_second);
    } else {
      build_first();
      build_second();
    }
    boxes_[node] = united(boxes_[2 * node + 1], boxes_[2 * node + 2]);
  }

 private:
  [[nodiscard]] Vec3 tripled_center(std::uint32_t f) const { return triangles_[f][0] + triangles_[f][1] + triangles_[f][2]; }

  void halve(std::uint32_t begin, std::uint32_t middle, std::uint32_t end) {
    if (end - begin < 2) return;
    Vec3 low = tripled_center(order_[begin]), high = low;
    for (std::uint32_t i = begin; i < end; ++i) {
      low = low.cwiseMin(tripled_center(order_[i]));
      high = high.cwiseMax(tripled_center(order_[i]));
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    const auto key = [&](std::uint32_t f) { return std::pair(tripled_center(f)[axis], f); };
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t f, std::uint32_t g) { return key(f) < key(g); });
  }
  void finish_leaf(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
    leaf_begin_[node - first_leaf_] = begin;
    // The same places for the same triangles, however the halves were found.
    std::sort(order_.begin() + begin, order_.begin() + end);
    Box box;
    for (std::uint32_t i = begin; i < end; ++i) box.unite(box_of(triangles_[order_[i]]));
    boxes_[node] = box;
  }

  const std::vector<Corners>& triangles_;
  std::vector<std::uint32_t>& order_;
  std::uint32_t first_leaf_;
  std::vector<Box>& boxes_;
  std::vector<std::uint32_t>& leaf_begin_;
};

std::vector<Corners> corners_in_frame(const TriangleMesh& mesh, const Vec3& origin) {
  std::vector<Corners> corners(mesh.triangle_count());
  for_ranges_in_parallel(corners.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      for (std::size_t i = 0; i < 3; ++i) corners[f][i] = mesh.points[mesh.triangles[f][i]] - origin;
  });
  return corners;
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  const Frame frame = frame_of(mesh);
  origin_ = frame.origin;
  extent_ = frame.extent;
  const std::vector<Corners> corners = corners_in_frame(mesh, origin_);
  const auto count = static_cast<std::uint32_t>(corners.size());
  std::uint32_t leaves = 1;
  while (leaves * std::uint64_t{kMostInLeaf} < count) leaves *= 2;
  first_leaf_ = leaves - 1;
  boxes_.resize(std::size_t{2} * leaves - 1);
  leaf_begin_.assign(std::size_t{leaves} + 1, count);
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  Builder(corners, order, first_leaf_, boxes_, leaf_begin_).build(kRoot, 0, count);
  triangles_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) triangles_[i] = corners[order[i]];
}

template <class Visit>
void TriangleTree::search(const Vec3& p, const double& bound, const Visit& visit) const {
  struct Open {
    std::uint32_t node;
    float distance2;
  };
  const Box point = point_box(p);
  std::array<Open, kMostLevels> stack;
  std::size_t open = 0;
  stack[open++] = {kRoot, squared_distance_below(boxes_[kRoot], point)};
  while (open > 0) {
    Open next = stack[--open];
    while (double{next.distance2} < bound && !is_leaf(next.node)) {
      const std::uint32_t first = 2 * next.node + 1;
      Open near = {first, squared_distance_below(boxes_[first], point)};
      Open far = {first + 1, squared_distance_below(boxes_[first + 1], point)};
      if (far.distance2 < near.distance2) std::swap(near, far);
      stack[open++] = far;
      next = near;
    }
    if (!(double{next.distance2} < bound)) continue;
    const std::uint32_t leaf = next.node - first_leaf_;
    for (std::uint32_t place = leaf_begin_[leaf]; place < leaf_begin_[leaf + 1]; ++place) visit(place);
  }
}

NearestTriangle TriangleTree::nearest(const Vec3& p, NearestTriangle known) const {
  search(p, known.squared_distance, [&](std::uint32_t place) {
    const double distance2 = PointToTriangle(triangles_[place]).squared_distance(p);
    if (distance2 < known.squared_distance) known = {place, distance2};
  });
  return known;
}

NearestTriangle TriangleTree::nearest_from(const Vec3& p, std::uint32_t place) const {
  if (place == NearestTriangle::kNone) return nearest(p);
  return nearest(p, {place, PointToTriangle(triangles_[place]).squared_distance(p)});
}

double TriangleTree::distance_below(const Vec3& p, const NearestTriangle& known) const {
  double below = std::sqrt(known.squared_distance);
  search(p, known.squared_distance,
         [&](std::uint32_t place) { below = std::min(below, PointToTriangle(triangles_[place]).distance_below(p)); });
  return below;
}

}  // namespace smopt
