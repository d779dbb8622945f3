#include "metrics/intersections.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <fmt/format.h>
#include <tbb/concurrent_vector.h>

#include <algorithm>
#include <array>
#include <random>

#include "metrics/degenerate.h"
#include "metrics/finite.h"

namespace smopt::metrics {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Pair = std::pair<FaceId, FaceId>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, FaceId, CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

/// Below this many boxes CGAL compares all with all; its own choice for self-intersections.
constexpr std::ptrdiff_t kBoxCutoff = 2000;

/// Exact answers about pairs of non-degenerate triangles of one mesh.
class PairTest {
 public:
  explicit PairTest(const TriangleMesh& mesh) : triangles_(mesh.triangles) {
    points_.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) points_.emplace_back(p.x(), p.y(), p.z());
  }

  [[nodiscard]] CGAL::Bbox_3 box(FaceId f) const {
    const Triangle& t = triangles_[f];
    return points_[t[0]].bbox() + points_[t[1]].bbox() + points_[t[2]].bbox();
  }

  [[nodiscard]] bool meet_elsewhere(FaceId f, FaceId g) const {
    const Sharing s = shared_first(triangles_[f], triangles_[g]);
    switch (s.shared) {
      case 0:
        return CGAL::do_intersect(triangle(s.f), triangle(s.g));
      case 1:
        return meet_beside_vertex(s.f, s.g);
      case 2:
        return fold_onto_each_other(s.f, s.g);
      default:
        return true;
    }
  }

 private:
  /// Two triangles with the vertices they share in front, in the same order.
  struct Sharing {
    Triangle f, g;
    int shared = 0;
  };

  static Sharing shared_first(Triangle f, Triangle g) {
    int n = 0;
    for (int i = 0; i < 3; ++i) {
      const auto match = std::find(g.begin() + n, g.end(), f[i]);
      if (match == g.end()) continue;
      std::iter_swap(g.begin() + n, match);
      std::swap(f[n], f[i]);
      ++n;
    }
    return {f, g, n};
  }

  [[nodiscard]] Kernel::Triangle_3 triangle(const Triangle& t) const { return {points_[t[0]], points_[t[1]], points_[t[2]]}; }
  [[nodiscard]] Kernel::Segment_3 far_side(const Triangle& t) const { return {points_[t[1]], points_[t[2]]}; }

  /// The common part of the two is convex and holds the shared vertex; if it holds anything else, it reaches a side opposite the vertex.
  [[nodiscard]] bool meet_beside_vertex(const Triangle& f, const Triangle& g) const {
    return CGAL::do_intersect(triangle(f), far_side(g)) || CGAL::do_intersect(triangle(g), far_side(f));
  }

  /// Two triangles on a common edge overlap only if they lie in one plane, on the same side of the edge.
  [[nodiscard]] bool fold_onto_each_other(const Triangle& f, const Triangle& g) const {
    const Point& a = points_[f[0]];
    const Point& b = points_[f[1]];
    const Point& c = points_[f[2]];
    const Point& d = points_[g[2]];
    return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
  }

  const std::vector<Triangle>& triangles_;
  std::vector<Point> points_;
};

std::vector<Box> boxes_of_proper_triangles(const TriangleMesh& mesh, const PairTest& test) {
  const std::vector<bool> degenerate = degenerate_triangles(mesh);
  std::vector<Box> boxes;
  boxes.reserve(mesh.triangle_count());
  for (std::size_t f = 0; f < mesh.triangle_count(); ++f)
    if (!degenerate[f]) boxes.emplace_back(test.box(static_cast<FaceId>(f)), static_cast<FaceId>(f));
  return boxes;
}

/// Pointers in a random but fixed order: CGAL's parallel algorithm halves the range, and wants halves that are alike.
std::vector<const Box*> shuffled_pointers(const std::vector<Box>& boxes) {
  std::vector<const Box*> pointers;
  pointers.reserve(boxes.size());
  for (const Box& box : boxes) pointers.push_back(&box);
  std::shuffle(pointers.begin(), pointers.end(), std::mt19937(0));
  return pointers;
}

/// Ends the search for pairs.
struct TooManyPairs {};

/// \throws TooManyPairs
std::vector<Pair> intersecting_pairs(const TriangleMesh& mesh, std::size_t limit) {
  const PairTest test(mesh);
  const std::vector<Box> boxes = boxes_of_proper_triangles(mesh, test);
  std::vector<const Box*> pointers = shuffled_pointers(boxes);
  tbb::concurrent_vector<Pair> found;
  const auto test_candidates = [&](const Box* a, const Box* b) {
    if (!test.meet_elsewhere(a->info(), b->info())) return;
    found.push_back(std::minmax(a->info(), b->info()));
    if (found.size() > limit) throw TooManyPairs();
  };
  CGAL::box_self_intersection_d<CGAL::Parallel_tag>(pointers.begin(), pointers.end(), test_candidates, kBoxCutoff);
  std::vector<Pair> pairs(found.begin(), found.end());
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

Intersections find_intersections(const TriangleMesh& mesh, const IntersectionOptions& options) {
  Intersections result;
  if (!has_finite_triangles(mesh)) {
    result.why_not_counted = "a triangle has a corner that is not finite";
    return result;
  }
  try {
    result.pairs = intersecting_pairs(mesh, options.count_limit);
  } catch (const TooManyPairs&) {
    result.why_not_counted = fmt::format("more than {} pairs", options.count_limit);
    return result;
  }
  result.count = result.pairs.size();
  if (result.pairs.size() > options.list_limit) result.pairs.resize(options.list_limit);
  return result;
}

}  // namespace smopt::metrics
