#include "smopt/improve/remesh/two_sided_distance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

#include "smopt/error.h"
#include "smopt/improve/remesh/convex_piece.h"
#include "smopt/improve/remesh/triangle_tree.h"

namespace smopt {
namespace {

/// What is looked at by one task, with what was found for one as a start for the next. It is part of the result's definition: where triangles
/// are equally near, the start decides.
constexpr std::uint32_t kTaskSize = 256;
/// Pieces of one triangle that are looked at; a few megabytes where they all wait.
constexpr int kMostPieces = 20'000;
/// Rounding of a distance relative to the largest coordinate: a few dozen operations, and up to 40 levels of cuts.
constexpr double kRoundingRel = 512 * 0x1p-53;
/// No tolerance is below this, relative to the extent: eight times what rounding takes.
constexpr double kLeastToleranceRel = 8 * kRoundingRel;

void require_finite(const TriangleMesh& mesh) {
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t)
      if (!mesh.points[v].allFinite()) throw InvalidMesh("the distance of surfaces needs finite coordinates");
}

/// Numbers of the points that triangles use, ascending.
std::vector<VertexId> used_points(const TriangleMesh& mesh) {
  std::vector<char> is_used(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t) is_used[v] = 1;
  std::vector<VertexId> used;
  for (VertexId v = 0; v < is_used.size(); ++v)
    if (is_used[v] != 0) used.push_back(v);
  return used;
}

/// Both bounds, each from where it is larger.
FarthestPoint farther(const FarthestPoint& a, const FarthestPoint& b) {
  FarthestPoint result = b.lower > a.lower ? b : a;
  result.upper = std::max(a.upper, b.upper);
  return result;
}

/// The farthest of what `of_task(begin, end)` finds in the tasks that make up [0, count), the first of equals.
template <class OfTask>
FarthestPoint farthest_of_tasks(std::size_t count, const OfTask& of_task) {
  std::vector<FarthestPoint> found((count + kTaskSize - 1) / kTaskSize);
  tbb::parallel_for(std::size_t{0}, found.size(),
                    [&](std::size_t i) { found[i] = of_task(i * kTaskSize, std::min(count, (i + 1) * kTaskSize)); });
  FarthestPoint best;
  for (const FarthestPoint& f : found) best = farther(best, f);
  return best;
}

/// Looks at points and triangles for the farthest from a surface, those of one task one after the other. Points are in the surface's frame.
class Search {
 public:
  /// \param lower  known already, Å
  Search(const TriangleTree& surface, double tolerance, double lower) : surface_(surface), tolerance_(tolerance) { best_.lower = lower; }

  void try_point(const Vec3& p) { try_point(p, find(p)); }

  /// The farthest pieces first, so that the bounds are close even where pieces run out.
  void try_triangle(const Corners& triangle) {
    open_.assign(1, {ConvexPiece(triangle), HUGE_VAL});
    for (int pieces = 0; !open_.empty() && pieces < kMostPieces; ++pieces) {
      std::pop_heap(open_.begin(), open_.end());
      const OpenPiece next = open_.back();
      open_.pop_back();
      if (!is_settled(next)) look_closely(next);
    }
    if (!open_.empty()) best_.upper = std::max(best_.upper, open_.front().upper);
  }

  [[nodiscard]] const FarthestPoint& best() const { return best_; }

 private:
  /// A piece that is not farther than `upper`.
  struct OpenPiece {
    ConvexPiece piece;
    double upper;
    bool operator<(const OpenPiece& other) const { return upper < other.upper; }
  };

  NearestTriangle find(const Vec3& p) {
    const NearestTriangle nearest = surface_.nearest_from(p, place_);
    place_ = nearest.place;
    return nearest;
  }
  void try_point(const Vec3& p, const NearestTriangle& nearest) {
    if (!(nearest.squared_distance > best_.lower * best_.lower)) return;
    const double lower = surface_.distance_below(p, nearest);
    if (!(lower > best_.lower)) return;
    best_.lower = lower;
    best_.point = p;
  }
  /// Whether the piece need not be split: it is known to be close enough to some triangle, or is to the last that was near.
  bool is_settled(const OpenPiece& open) {
    if (is_settled_by(open.upper)) return true;
    if (place_ == NearestTriangle::kNone) return false;
    const PointToTriangle triangle = surface_.distance_to(place_);
    const double enough = best_.lower + tolerance_;
    return is_within(open.piece, triangle, enough * enough) && is_settled_by(std::sqrt(farthest_squared(open.piece, triangle)));
  }
  bool is_settled_by(double upper) {
    if (!(upper <= best_.lower + tolerance_)) return false;
    best_.upper = std::max(best_.upper, upper);
    return true;
  }
  void look_closely(const OpenPiece& open) {
    const Vec3 center = open.piece.center();
    const NearestTriangle nearest = find(center);
    try_point(center, nearest);
    const double upper = std::min(open.upper, std::sqrt(farthest_squared(open.piece, surface_.distance_to(nearest.place))));
    if (is_settled_by(upper)) return;
    const auto [over, beside] = split(open.piece, surface_[nearest.place], best_.lower + tolerance_);
    for (const ConvexPiece& part : {beside, over}) {
      open_.push_back({part, upper});
      std::push_heap(open_.begin(), open_.end());
    }
  }

  const TriangleTree& surface_;
  double tolerance_;
  FarthestPoint best_;
  std::uint32_t place_ = NearestTriangle::kNone;
  std::vector<OpenPiece> open_;  // a heap
};

/// Of all points of `from`, the farthest from `surface`. The lower bound that the vertices give decides how far triangles are split.
FarthestPoint farthest(const TriangleMesh& from, const TriangleTree& surface, double extent, double tolerance) {
  const double rounding = kRoundingRel * extent;
  const double provable = std::max(tolerance, kLeastToleranceRel * extent) - 2 * rounding;
  const std::vector<VertexId> points = used_points(from);
  const auto in_frame = [&](VertexId v) -> Vec3 { return from.points[v] - surface.origin(); };
  const FarthestPoint of_points = farthest_of_tasks(points.size(), [&](std::size_t begin, std::size_t end) {
    Search search(surface, provable, 0);
    for (std::size_t i = begin; i < end; ++i) search.try_point(in_frame(points[i]));
    return search.best();
  });
  const FarthestPoint of_triangles = farthest_of_tasks(from.triangles.size(), [&](std::size_t begin, std::size_t end) {
    Search search(surface, provable, of_points.lower);
    for (std::size_t f = begin; f < end; ++f) {
      const Triangle& t = from.triangles[f];
      search.try_triangle({in_frame(t[0]), in_frame(t[1]), in_frame(t[2])});
    }
    return search.best();
  });
  FarthestPoint best = farther(of_points, of_triangles);
  return {std::max(0.0, best.lower - rounding), std::max(best.lower, best.upper) + rounding, best.point + surface.origin()};
}

/// Where one of the surfaces is empty.
FarthestPoint farthest_from_empty(const TriangleMesh& from) {
  if (from.triangles.empty()) return {};
  return {HUGE_VAL, HUGE_VAL, from.points[from.triangles[0][0]]};
}

}  // namespace

TwoSidedDistance two_sided_distance(const TriangleMesh& a, const TriangleMesh& b, double tolerance) {
  if (!(tolerance > 0 && std::isfinite(tolerance))) throw InvalidOption("the tolerance of a distance must be a positive length");
  require_finite(a);
  require_finite(b);
  if (a.triangles.empty() || b.triangles.empty()) return {farthest_from_empty(a), farthest_from_empty(b)};
  const TriangleTree tree_a(a), tree_b(b);
  const double extent = tree_a.extent() + tree_b.extent() + (tree_a.origin() - tree_b.origin()).norm();
  return {farthest(a, tree_b, extent, tolerance), farthest(b, tree_a, extent, tolerance)};
}

}  // namespace smopt
