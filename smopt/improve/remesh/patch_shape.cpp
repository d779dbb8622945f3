#include "smopt/improve/remesh/patch_shape.h"

#include <algorithm>
#include <limits>

#include "smopt/geometry/triangle_shape.h"

namespace smopt {
namespace {

constexpr double kBest = std::numeric_limits<double>::infinity();

/// Of the cosine between two neighbouring normals: bends that operations may make whatever was there before. Surfaces that are sampled well bend
/// by less.
constexpr double kHarmlessCosine = 0.5;
/// A split leaves the bends as they are, but for rounding.
constexpr double kCosineRounding = 1e-9;

Vec3 normal_of(const EditableSurface& surface, const Triangle& t) {
  return doubled_area_vector(surface.point(t[0]), surface.point(t[1]), surface.point(t[2])).normalized();
}

/// The triangle on the right of the edge from a to b.
const Triangle& right_of(const EditableSurface& surface, VertexId a, VertexId b) {
  return surface.mesh().triangles[surface.edge_at(a, surface.slot_of(a, b)).right_face];
}

/// The smallest cosine between neighbouring normals, among some triangles that make up a disc, and across its boundary.
class SmallestCosine {
 public:
  SmallestCosine(const EditableSurface& surface, const std::vector<VertexId>& boundary) : surface_(surface), boundary_(boundary) {}

  void add(const Triangle& t) {
    const Vec3 normal = normal_of(surface_, t);
    for (std::size_t i = 0; i < 3; ++i) add_edge(t[i], t[(i + 1) % 3], normal);
  }
  [[nodiscard]] double value() const { return value_; }

 private:
  struct InnerEdge {
    VertexId from, to;
    Vec3 normal;
  };
  void add_edge(VertexId a, VertexId b, const Vec3& normal) {
    for (std::size_t k = 0; k < boundary_.size(); ++k)
      if (boundary_[k] == a && boundary_[k + 1 < boundary_.size() ? k + 1 : 0] == b)
        return add_cosine(normal.dot(normal_of(surface_, right_of(surface_, a, b))));
    for (std::size_t i = 0; i < count_; ++i)
      if (inner_[i].from == b && inner_[i].to == a) return add_cosine(normal.dot(inner_[i].normal));
    if (count_ < inner_.size()) inner_[count_++] = {a, b, normal};
  }
  void add_cosine(double cosine) {
    if (!(cosine >= value_)) value_ = cosine;  // not a number, too: a degenerate triangle
  }

  const EditableSurface& surface_;
  const std::vector<VertexId>& boundary_;
  double value_ = 1;
  std::array<InnerEdge, 2 * EditableSurface::kMaxValence> inner_;
  std::size_t count_ = 0;
};

double cosine_before(const EditableSurface& surface, const Patch& patch) {
  SmallestCosine smallest(surface, patch.boundary);
  for (const FaceId f : patch.old_faces) smallest.add(surface.mesh().triangles[f]);
  return smallest.value();
}

double cosine_after(const EditableSurface& surface, const Patch& patch) {
  SmallestCosine smallest(surface, patch.boundary);
  for (const Triangle& t : patch.new_triangles) smallest.add(t);
  return smallest.value();
}

}  // namespace

PatchShape triangle_shape(const RemeshState& state, const Patch& patch) {
  PatchShape shape{kBest, kBest};
  for (const FaceId f : patch.old_faces) shape.before = std::min(shape.before, state.quality_of(state.surface.mesh().triangles[f]));
  for (const Triangle& t : patch.new_triangles) shape.after = std::min(shape.after, state.quality_of(t));
  return shape;
}

bool keeps_bends(const RemeshState& state, const Patch& patch) {
  const double after = cosine_after(state.surface, patch);
  return after >= kHarmlessCosine || after >= cosine_before(state.surface, patch) - kCosineRounding;
}

double star_quality_at(const RemeshState& state, VertexId v, const Vec3& x) {
  const std::span<const VertexId> ring = state.surface.rings().vertices(v);
  double worst = kBest;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const VertexId next = ring[k + 1 < ring.size() ? k + 1 : 0];
    worst = std::min(worst, state.quality.of_triangle(x, state.surface.point(ring[k]), state.surface.point(next)));
  }
  return worst;
}

double star_bend_at(const RemeshState& state, VertexId v, const Vec3& x) {
  const EditableSurface& surface = state.surface;
  const std::span<const VertexId> ring = surface.rings().vertices(v);
  const auto normal_at = [&](std::size_t k) {
    return Vec3(doubled_area_vector(x, surface.point(ring[k]), surface.point(ring[k + 1 < ring.size() ? k + 1 : 0])).normalized());
  };
  double smallest = 1;
  Vec3 previous = normal_at(ring.size() - 1);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec3 normal = normal_at(k);
    const VertexId next = ring[k + 1 < ring.size() ? k + 1 : 0];
    smallest = std::min({smallest, normal.dot(previous), normal.dot(normal_of(surface, right_of(surface, ring[k], next)))});
    previous = normal;
  }
  return state.quality.of_bend(smallest);
}

}  // namespace smopt
