#include "smopt/improve/remesh/deviation_bound.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
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
/// The same while only close surroundings have been fetched.
constexpr int kFewPieces = 8;
/// Surroundings are fetched first up to this, relative to the longest extent of what they are for: a ring of triangles around it.
constexpr float kMarginPerExtent = 0.5F;
/// Not less than this of ε, as the surface may have moved; where it is not enough, this many times as far, and at last up to ε.
constexpr float kMarginPerBound = 0.125F;
constexpr float kMarginGrowth = 4;
/// A node of the input whose ball is larger than this, relative to ε, is looked at in parts rather than have surroundings of its own fetched.
constexpr double kBallPerBound = 0.5;
/// The surroundings of a ball: of its middle, up to this part of its radius.
constexpr double kMiddlePerBall = 0.25;
/// Boxes are enlarged in single precision; this covers what that rounds.
constexpr float kEnlarge = 1.000001F;

constexpr std::uint32_t kNone = NearestTriangle::kNone;

Box enlarged(const Box& box, float by) {
  const Floats margin = in_all_lanes(by);
  return {rounded_down(box.low - margin), rounded_up(box.high + margin)};
}

Box common(const Box& a, const Box& b) {
  return {larger_of(a.low, b.low), smaller_of(a.high, b.high)};
}
bool is_empty(const Box& box) {
  return !(box.low[0] <= box.high[0] && box.low[1] <= box.high[1] && box.low[2] <= box.high[2]);
}
Vec3 low_of(const Box& box) {
  return {box.low[0], box.low[1], box.low[2]};
}
Vec3 high_of(const Box& box) {
  return {box.high[0], box.high[1], box.high[2]};
}
float longest_extent(const Box& box) {
  return std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
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
    centers_.clear();
    whole_ = Box{};
  }
  void add(const Corners& t) {
    const Box box = box_of(t);
    if (boxes_.size() % kLanes == 0) centers_.push_back({in_all_lanes(kFar), in_all_lanes(kFar), in_all_lanes(kFar)});
    const Floats center = 0.5F * (box.low + box.high);
    for (std::size_t i = 0; i < 3; ++i) centers_.back()[i][boxes_.size() % kLanes] = center[i];
    triangles_.push_back(t);
    distances_.emplace_back(t);
    boxes_.push_back(box);
    whole_.unite(box);
  }
  [[nodiscard]] const Corners& operator[](std::uint32_t place) const { return triangles_[place]; }
  [[nodiscard]] const PointToTriangle& distance_to(std::uint32_t place) const { return distances_[place]; }
  [[nodiscard]] const Box& box() const { return whole_; }

  /// The triangle whose box's middle is nearest: mostly the nearest triangle.
  [[nodiscard]] std::uint32_t guess(const Vec3& p) const {
    const Floats x = in_all_lanes(static_cast<float>(p[0])), y = in_all_lanes(static_cast<float>(p[1])),
                 z = in_all_lanes(static_cast<float>(p[2]));
    Floats best = in_all_lanes(std::numeric_limits<float>::infinity());
    Masks place = Masks{} - 1;
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      const auto& [cx, cy, cz] = centers_[i];
      const Floats distance2 = (cx - x) * (cx - x) + (cy - y) * (cy - y) + (cz - z) * (cz - z);
      place = distance2 < best ? static_cast<std::int32_t>(kLanes * i) + Masks{0, 1, 2, 3} : place;
      best = smaller_of(distance2, best);
    }
    std::size_t lane = 0;
    for (std::size_t i = 1; i < kLanes; ++i)
      if (best[i] < best[lane]) lane = i;
    return best[lane] < kFar ? static_cast<std::uint32_t>(place[lane]) : kNone;
  }
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
  /// Where the middles of no triangles are, Å; its square is finite, and no distance comes near it.
  static constexpr float kFar = 1e15F;

  std::vector<Corners> triangles_;
  std::vector<PointToTriangle> distances_;
  std::vector<Box> boxes_;
  std::vector<std::array<Floats, 3>> centers_;  // four boxes' in each, by coordinate
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
      const Vec3 center = piece.center();
      if (is_near_last(piece) || is_near(piece, surface_.guess(center))) continue;
      const NearestTriangle nearest = surface_.nearest_from(center, place_);
      if (is_near(piece, nearest.place)) continue;
      const double center_gap = gap(center);
      if (center_gap > reach + piece.radius_around(center)) continue;
      const bool is_hopeless = center_gap <= reach && !(nearest.squared_distance <= distance2_);
      if (is_hopeless || nearest.place == kNone || level == kMostLevels || pieces >= most_pieces) return false;
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
    const auto covers_from = [&](std::uint32_t place) {
      return place != kNone && std::sqrt(surface_.distance_to(place).squared_distance(center)) + radius <= distance_;
    };
    if (radius > distance_) return false;
    if (covers_from(place_)) return true;
    const std::uint32_t guess = surface_.guess(center);
    if (!covers_from(guess)) return false;
    place_ = guess;
    return true;
  }

 private:
  [[nodiscard]] bool is_near_last(const ConvexPiece& piece) const {
    return place_ != kNone && is_within(piece, surface_.distance_to(place_), distance2_);
  }
  /// Remembers the triangle: it is probably near the next piece, too.
  bool is_near(const ConvexPiece& piece, std::uint32_t place) {
    if (place == place_ || place == kNone) return false;
    place_ = place;
    return is_near_last(piece);
  }

  const Surface& surface_;
  double distance_, distance2_;
  std::vector<OpenPiece>& open_;
  std::uint32_t place_ = kNone;
};

/// Memory that a thread keeps from question to question.
struct Scratch {
  TriangleList old_patch;
  TriangleList close;  // the new triangles and those that stay, around the old patch
  TriangleList local;  // the same around some part of the input
  std::vector<OpenPiece> open;
  std::vector<FaceId> faces;
};

Scratch& scratch() {
  thread_local Scratch memory;
  return memory;
}

/// A patch and what takes its place, with what is around it. Points are in the frame of the input.
class Replacement {
 public:
  Replacement(const Vec3& origin, const TriangleMesh& mesh, const TriangleGrid& grid, std::span<const FaceId> old_faces,
              std::span<const Corners> new_triangles, Scratch& memory)
      : origin_(origin),
        mesh_(mesh),
        grid_(grid),
        old_faces_(old_faces),
        new_triangles_(new_triangles),
        old_patch_(memory.old_patch),
        faces_(memory.faces) {
    old_patch_.clear();
    for (const FaceId f : old_faces) {
      const Triangle& t = mesh.triangles[f];
      old_patch_.add(corners_of(mesh, f, origin));
      box_in_grid_.unite(grid.box_of(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
    }
  }

  [[nodiscard]] const TriangleList& old_patch() const { return old_patch_; }
  /// Of the new triangles and of those that stay, what is in a box (in the grid's frame).
  void fetch(const Box& around, TriangleList& list) const {
    list.clear();
    for (const Corners& t : new_triangles_)
      if (grid_.box_of(t[0], t[1], t[2]).overlaps(around)) list.add(in_frame(t));
    // By number: the grid's order is any, and of triangles equally near the first is taken.
    faces_.clear();
    grid_.for_overlapping(around, [&](FaceId f) { faces_.push_back(f); });
    std::sort(faces_.begin(), faces_.end());
    for (const FaceId f : faces_)
      if (std::find(old_faces_.begin(), old_faces_.end(), f) == old_faces_.end()) list.add(corners_of(mesh_, f, origin_));
  }
  /// The box of a part of the input, in the grid's frame.
  [[nodiscard]] Box in_grid(const Box& box) const { return grid_.box_of(low_of(box) + origin_, high_of(box) + origin_); }
  [[nodiscard]] const Box& box_in_grid() const { return box_in_grid_; }
  [[nodiscard]] Corners in_frame(const Corners& t) const { return {t[0] - origin_, t[1] - origin_, t[2] - origin_}; }

 private:
  const Vec3& origin_;
  const TriangleMesh& mesh_;
  const TriangleGrid& grid_;
  std::span<const FaceId> old_faces_;
  std::span<const Corners> new_triangles_;
  TriangleList& old_patch_;
  std::vector<FaceId>& faces_;
  Box box_in_grid_;
};

/// Proves that what is near the old patch of the input surface is near what takes its place: condition (b).
class InputProof {
 public:
  /// \param epsilon   only what is so close to the old patch matters, Å
  /// \param provable  what "near" means, Å
  /// \param reach     the old patch's box in the grid's frame, enlarged by twice that: nothing beyond it can matter
  InputProof(const TriangleTree& input, const Replacement& replacement, double epsilon, double provable, const Box& reach, Scratch& memory)
      : input_(input),
        replacement_(replacement),
        epsilon_(epsilon),
        provable_(provable),
        reach_(reach),
        memory_(memory),
        close_(memory.close, provable, memory.open) {
    const Box& patch = replacement.box_in_grid();
    replacement.fetch(common(enlarged(patch, first_margin(patch)), reach), memory.close);
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
    return !(double{squared_distance_below(box, replacement_.old_patch().box())} > epsilon_ * epsilon_);
  }
  /// What is fetched first around a box: the triangles next to it, and where they may have moved to.
  [[nodiscard]] float first_margin(const Box& box) const {
    const float all = rounded_up(epsilon_);
    return std::min(all, std::max(kMarginPerExtent * longest_extent(box), kMarginPerBound * all));
  }

  /// Whether the whole box is near one triangle: only tried where that is likely.
  bool is_near(const Box& box) {
    const Vec3 center = 0.5 * (low_of(box) + high_of(box));
    const double radius = 0.5 * (high_of(box) - low_of(box)).norm();
    if (radius > kBallPerBound * provable_) return false;
    if (close_.covers_ball(center, radius)) return true;
    const Vec3 margin = Vec3::Constant(kMiddlePerBall * radius);
    const Box around = common(replacement_.in_grid(make_box(center - margin, center + margin)), reach_);
    if (is_empty(around)) return false;
    replacement_.fetch(around, memory_.local);
    return Proof<TriangleList>(memory_.local, provable_, memory_.open).covers_ball(center, radius);
  }
  bool are_near(std::span<const Corners> triangles) {
    return std::all_of(triangles.begin(), triangles.end(), [&](const Corners& t) { return !matters(box_of(t)) || is_near(t); });
  }
  /// Against what is around the old patch, then what is around the triangle, up to all that can matter for it.
  bool is_near(const Corners& triangle) {
    const auto gap = [&](const Vec3& p) { return replacement_.old_patch().distance_below(p); };
    if (close_.covers(triangle, kFewPieces, epsilon_, gap)) return true;
    const Box box = replacement_.in_grid(box_of(triangle));
    const float all = rounded_up(epsilon_);
    for (float margin = first_margin(box);; margin *= kMarginGrowth) {
      const Box around = common(enlarged(box, std::min(margin, all)), reach_);
      if (is_empty(around)) return false;
      replacement_.fetch(around, memory_.local);
      Proof<TriangleList> proof(memory_.local, provable_, memory_.open);
      if (proof.covers(triangle, margin < all ? kFewPieces : kMostPieces, epsilon_, gap)) return true;
      if (!(margin < all)) return false;
    }
  }

  const TriangleTree& input_;
  const Replacement& replacement_;
  double epsilon_, provable_;
  const Box& reach_;
  Scratch& memory_;
  Proof<TriangleList> close_;
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
  const Replacement replacement(input_.origin(), mesh, grid, old_faces, new_triangles, memory);
  Proof<TriangleTree> near_input(input_, provable_, memory.open);
  for (const Corners& t : new_triangles)
    if (!near_input.covers(replacement.in_frame(t))) return false;
  const Box box = reach(replacement.box_in_grid());
  return InputProof(input_, replacement, epsilon_ + rounding(), provable_, box, memory).succeeds();
}

}  // namespace smopt
