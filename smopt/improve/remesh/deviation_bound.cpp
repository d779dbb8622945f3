#include "smopt/improve/remesh/deviation_bound.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "smopt/error.h"
#include "smopt/improve/remesh/convex_piece.h"

namespace smopt {
namespace {

/// What rounding may take from a distance, relative to the largest coordinate (in the frame of the input's middle): 2⁻⁵³ each for the corners
/// of both triangles, 4 a level of splitting (see `split`), some for the distance itself.
constexpr double kRoundingRel = 512 * 0x1p-53;
/// Levels of splitting: a piece a millionth of a triangle's size is not worth another.
constexpr int kMostLevels = 40;
/// Pieces of one triangle that are looked at before it is given up; a triangle among others of its size needs two dozen at most.
constexpr int kMostPieces = 512;
/// The same while only the nearest surroundings have been fetched.
constexpr int kFewPieces = 32;
/// The surroundings that are fetched first, around the old patch, per its longest extent: a ring of triangles.
constexpr float kFirstMarginPerExtent = 0.5F;
/// Boxes are enlarged in single precision; this covers what that rounds.
constexpr float kEnlarge = 1.000001F;

constexpr std::uint32_t kNone = NearestTriangle::kNone;

Box enlarged(const Box& box, float by) {
  const Floats margin = in_all_lanes(by);
  return {rounded_down(box.low - margin), rounded_up(box.high + margin)};
}

Corners corners_of(const TriangleMesh& mesh, FaceId f, const Vec3& origin) {
  const Triangle& t = mesh.triangles[f];
  return {mesh.points[t[0]] - origin, mesh.points[t[1]] - origin, mesh.points[t[2]] - origin};
}

Box box_of(const Corners& t) {
  return triangle_box(t[0], t[1], t[2]);
}

/// A few triangles close together. Has the same questions as a TriangleTree.
class TriangleList {
 public:
  void clear() {
    triangles_.clear();
    distances_.clear();
    boxes_.clear();
    whole_ = Box{};
  }
  void add(const Corners& t) {
    triangles_.push_back(t);
    distances_.emplace_back(t);
    boxes_.push_back(box_of(t));
    whole_.unite(boxes_.back());
  }
  [[nodiscard]] const Corners& operator[](std::uint32_t place) const { return triangles_[place]; }
  [[nodiscard]] const PointToTriangle& distance_to(std::uint32_t place) const { return distances_[place]; }
  [[nodiscard]] const Box& box() const { return whole_; }

  [[nodiscard]] NearestTriangle nearest_from(const Vec3& p, std::uint32_t place) const {
    const Box point = point_box(p);
    NearestTriangle nearest;
    if (place != kNone) nearest = {place, distances_[place].squared_distance(p)};
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
      if (!(double{squared_distance_below(boxes_[i], point)} < nearest.squared_distance)) continue;
      const double distance2 = distances_[i].squared_distance(p);
      if (distance2 < nearest.squared_distance) nearest = {i, distance2};
    }
    return nearest;
  }
  /// A distance that none of them is nearer to p than.
  [[nodiscard]] double distance_below(const Vec3& p) const {
    double below = HUGE_VAL;
    for (const PointToTriangle& t : distances_) below = std::min(below, t.distance_below(p));
    return below;
  }

 private:
  std::vector<Corners> triangles_;
  std::vector<PointToTriangle> distances_;
  std::vector<Box> boxes_;
  Box whole_;
};

struct OpenPiece {
  ConvexPiece piece;
  int level;
};

/// Proves that triangles, or the parts of them that matter, are within a distance of a surface (a TriangleTree or a TriangleList).
template <class Surface>
class Proof {
 public:
  Proof(const Surface& surface, double distance, std::vector<OpenPiece>& open)
      : surface_(surface), distance_(distance), distance2_(distance * distance), open_(open) {}

  /// \param gap  a distance from a point to what makes a part matter, or less: parts that are farther from it than `reach` do not
  template <class Gap>
  bool covers(const Corners& triangle, int most_pieces, double reach, const Gap& gap) {
    open_.assign(1, {ConvexPiece(triangle), 0});
    for (int pieces = 0; !open_.empty(); ++pieces) {
      const auto [piece, level] = open_.back();
      open_.pop_back();
      if (place_ != kNone && is_within(piece, surface_.distance_to(place_), distance2_)) continue;
      const Vec3 center = piece.center();
      const NearestTriangle nearest = surface_.nearest_from(center, place_);
      if (has_proof(piece, nearest)) continue;
      const double center_gap = gap(center);
      if (center_gap > reach + piece.radius_around(center)) continue;
      const bool is_hopeless = center_gap <= reach && !(nearest.squared_distance <= distance2_);
      if (is_hopeless || nearest.place == kNone || level == kMostLevels || pieces == most_pieces) return false;
      const auto [over, beside] = split(piece, surface_[nearest.place], distance_);
      open_.push_back({beside, level + 1});
      open_.push_back({over, level + 1});
    }
    return true;
  }
  /// The whole triangle matters.
  bool covers(const Corners& triangle) {
    return covers(triangle, kMostPieces, distance_, [](const Vec3&) { return 0.0; });
  }

  /// Whether all points of a ball are within the distance of one triangle.
  bool covers_ball(const Vec3& center, double radius) {
    if (radius > distance_) return false;
    const NearestTriangle nearest = surface_.nearest_from(center, place_);
    if (!(std::sqrt(nearest.squared_distance) + radius <= distance_)) return false;
    place_ = nearest.place;
    return true;
  }

 private:
  bool has_proof(const ConvexPiece& piece, const NearestTriangle& nearest) {
    if (nearest.place == place_ || nearest.place == kNone) return false;
    place_ = nearest.place;  // probably right for the next piece, too
    return is_within(piece, surface_.distance_to(place_), distance2_);
  }

  const Surface& surface_;
  double distance_, distance2_;
  std::vector<OpenPiece>& open_;
  std::uint32_t place_ = kNone;
};

/// Memory that a thread keeps from question to question.
struct Scratch {
  TriangleList old_patch;
  TriangleList close;  // the new triangles, and those close to the old patch that stay
  TriangleList all;    // the same, and all others that can matter
  std::vector<OpenPiece> open;
};

Scratch& scratch() {
  thread_local Scratch memory;
  return memory;
}

/// A patch and what takes its place, with what is around it. Points are in the frame of the input.
class Replacement {
 public:
  Replacement(const Vec3& origin, const TriangleMesh& mesh, const TriangleGrid& grid, std::span<const FaceId> old_faces,
              std::span<const Corners> new_triangles, TriangleList& old_patch)
      : origin_(origin), mesh_(mesh), grid_(grid), old_faces_(old_faces), new_triangles_(new_triangles), old_patch_(old_patch) {
    old_patch_.clear();
    for (const FaceId f : old_faces) {
      const Triangle& t = mesh.triangles[f];
      old_patch_.add(corners_of(mesh, f, origin));
      box_in_grid_.unite(grid.box_of(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
    }
  }

  [[nodiscard]] const TriangleList& old_patch() const { return old_patch_; }
  /// Of the old patch, Å.
  [[nodiscard]] float longest_extent() const {
    const Floats extents = box_in_grid_.high - box_in_grid_.low;
    return std::max({extents[0], extents[1], extents[2]});
  }
  /// The new triangles, and those up to a margin around the old patch that stay.
  void fetch(const Box& around, TriangleList& list) const {
    list.clear();
    for (const Corners& t : new_triangles_) list.add(in_frame(t));
    grid_.for_overlapping(around, [&](FaceId f) {
      if (std::find(old_faces_.begin(), old_faces_.end(), f) == old_faces_.end()) list.add(corners_of(mesh_, f, origin_));
    });
  }
  [[nodiscard]] const Box& box_in_grid() const { return box_in_grid_; }
  [[nodiscard]] Corners in_frame(const Corners& t) const { return {t[0] - origin_, t[1] - origin_, t[2] - origin_}; }

 private:
  const Vec3& origin_;
  const TriangleMesh& mesh_;
  const TriangleGrid& grid_;
  std::span<const FaceId> old_faces_;
  std::span<const Corners> new_triangles_;
  TriangleList& old_patch_;
  Box box_in_grid_;
};

/// Proves that what is near the old patch of the input surface is near what takes its place: condition (b).
class InputProof {
 public:
  /// \param reach     only what is so close to the old patch matters, Å
  /// \param provable  what "near" means, Å
  /// \param box       the old patch's, in the grid's frame, enlarged by all that can matter
  InputProof(const TriangleTree& input, const Replacement& replacement, double reach, double provable, const Box& box, Scratch& memory)
      : input_(input),
        replacement_(replacement),
        reach_(reach),
        box_(box),
        all_list_(memory.all),
        close_(memory.close, provable, memory.open),
        all_(memory.all, provable, memory.open) {
    const Box first = enlarged(replacement.box_in_grid(), kFirstMarginPerExtent * replacement.longest_extent());
    is_complete_ = first.contains(box);
    replacement.fetch(is_complete_ ? box : first, memory.close);
  }

  bool succeeds() {
    std::array<std::uint32_t, kMostLevels> stack;
    std::size_t open = 0;
    stack[open++] = TriangleTree::kRoot;
    while (open > 0) {
      const std::uint32_t node = stack[--open];
      if (!matters(input_.box(node)) || is_near(input_.box(node))) continue;
      if (!input_.is_leaf(node)) {
        stack[open++] = 2 * node + 2;
        stack[open++] = 2 * node + 1;
      } else if (!are_near(input_.triangles_of(node))) {
        return false;
      }
    }
    return true;
  }

 private:
  [[nodiscard]] bool matters(const Box& box) const {
    return !(double{squared_distance_below(box, replacement_.old_patch().box())} > reach_ * reach_);
  }
  bool is_near(const Box& box) {
    const Vec3 low(box.low[0], box.low[1], box.low[2]), high(box.high[0], box.high[1], box.high[2]);
    return close_.covers_ball(0.5 * (low + high), 0.5 * (high - low).norm());
  }
  bool are_near(std::span<const Corners> triangles) {
    return std::all_of(triangles.begin(), triangles.end(), [&](const Corners& t) { return !matters(box_of(t)) || is_near(t); });
  }
  bool is_near(const Corners& triangle) {
    const auto gap = [&](const Vec3& p) { return replacement_.old_patch().distance_below(p); };
    if (close_.covers(triangle, is_complete_ ? kMostPieces : kFewPieces, reach_, gap)) return true;
    if (is_complete_) return false;
    if (!has_all_) replacement_.fetch(box_, all_list_);
    has_all_ = true;
    return all_.covers(triangle, kMostPieces, reach_, gap);
  }

  const TriangleTree& input_;
  const Replacement& replacement_;
  double reach_;
  const Box& box_;
  TriangleList& all_list_;
  bool is_complete_ = false;  // the close ones are all
  bool has_all_ = false;
  Proof<TriangleList> close_, all_;
};

}  // namespace

DeviationBound::DeviationBound(const TriangleMesh& input, double epsilon) : input_(input), epsilon_(epsilon) {
  if (!(epsilon > 0 && std::isfinite(epsilon))) throw InvalidOption("the bound on the deviation must be a positive length");
  provable_ = std::max(0.0, epsilon - rounding());
}

double DeviationBound::rounding() const {
  return kRoundingRel * (input_.extent() + epsilon_);
}

Box DeviationBound::reach(const Box& old_patch) const {
  return enlarged(old_patch, rounded_up(2 * epsilon_) * kEnlarge);
}

bool DeviationBound::allows(const TriangleMesh& mesh, const TriangleGrid& grid, std::span<const FaceId> old_faces,
                            std::span<const Corners> new_triangles) const {
  Scratch& memory = scratch();
  const Replacement replacement(input_.origin(), mesh, grid, old_faces, new_triangles, memory.old_patch);
  Proof<TriangleTree> near_input(input_, provable_, memory.open);
  for (const Corners& t : new_triangles)
    if (!near_input.covers(replacement.in_frame(t))) return false;
  const Box box = reach(replacement.box_in_grid());
  return InputProof(input_, replacement, epsilon_ + rounding(), provable_, box, memory).succeeds();
}

}  // namespace smopt
