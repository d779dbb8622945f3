#include "baselines/gamer/angle_weighted_step.h"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "smopt/geometry/triangle_shape.h"
#include "smopt/parallel.h"

namespace smopt::baselines {
namespace {

/// Of cos + 1 from 2, where p and q lie in nearly the same direction from s (0.08 degrees) and p − q is none that could be relied on: GAMer
/// takes the direction to p then.
constexpr double kSameDirection = 1e-6;

/// The vertices in so many rings around one, nearer ones first, always in the same order.
class Neighbourhood {
 public:
  explicit Neighbourhood(const VertexRings& rings) : rings_(rings), seen_(rings.vertex_count(), kNever) {}

  /// Without v itself; valid until the next call.
  const std::vector<VertexId>& around(VertexId v, int rings) {
    found_.clear();
    seen_[v] = v;
    add_neighbours_of(v, v);
    std::size_t begin = 0;
    for (int ring = 1; ring < rings; ++ring) {
      const std::size_t end = found_.size();
      for (std::size_t i = begin; i < end; ++i) add_neighbours_of(found_[i], v);
      begin = end;
    }
    return found_;
  }

 private:
  static constexpr VertexId kNever = 0xFFFFFFFFU;

  void add_neighbours_of(VertexId from, VertexId centre) {
    for (const VertexId w : rings_.vertices(from)) {
      if (seen_[w] == centre) continue;
      seen_[w] = centre;
      found_.push_back(w);
    }
  }

  const VertexRings& rings_;
  std::vector<VertexId> seen_;  ///< by the centre around which it was last seen
  std::vector<VertexId> found_;
};

/// Of length one or zero.
Vec3 vertex_normal(const TriangleMesh& mesh, std::span<const FaceId> star) {
  Vec3 sum = Vec3::Zero();
  for (const FaceId f : star) {
    const auto& [a, b, c] = mesh.triangles[f];
    sum += doubled_area_vector(mesh.points[a], mesh.points[b], mesh.points[c]);
  }
  const double length = sum.norm();
  return length > 0 ? Vec3(sum / length) : Vec3::Zero();
}

/// From x to the weighted mean of what its neighbours propose.
Vec3 displacement(const Vec3& x, std::span<const VertexId> ring, const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  double weights = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3& s = points[ring[i]];
    Vec3 p = points[ring[(i + ring.size() - 1) % ring.size()]] - s, q = points[ring[(i + 1) % ring.size()]] - s;
    const double p_length = p.norm(), q_length = q.norm();
    if (!(p_length > 0 && q_length > 0)) continue;
    p /= p_length;
    q /= q_length;
    const double weight = p.dot(q) + 1;
    // Normal to the bisecting plane: p − q lies in the plane of p and q and stands on p + q.
    const Vec3 across = weight > 2 - kSameDirection ? p : (p - q).normalized();
    sum -= weight * across.dot(x - s) * across;
    weights += weight;
  }
  return weights > 0 ? Vec3(sum / weights) : Vec3::Zero();
}

Eigen::Matrix3d structure_tensor(const std::vector<VertexId>& vertices, const std::vector<Vec3>& normals) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const VertexId v : vertices) sum += normals[v] * normals[v].transpose();
  return sum;
}

}  // namespace

void angle_weighted_step(const TriangleMesh& mesh, const VertexRings& rings, int tensor_rings, std::vector<Vec3>& next) {
  std::vector<Vec3> normals(mesh.points.size());
  for_ranges_in_parallel(normals.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) normals[v] = vertex_normal(mesh, rings.faces(static_cast<VertexId>(v)));
  });
  oneapi::tbb::enumerable_thread_specific<Neighbourhood> neighbourhoods([&] { return Neighbourhood(rings); });
  for_ranges_in_parallel(next.size(), [&](std::size_t begin, std::size_t end) {
    Neighbourhood& neighbourhood = neighbourhoods.local();
    for (std::size_t i = begin; i < end; ++i) {
      const auto v = static_cast<VertexId>(i);
      const Eigen::Matrix3d tensor = structure_tensor(neighbourhood.around(v, tensor_rings), normals);
      const Vec3 wanted = displacement(mesh.points[i], rings.vertices(v), mesh.points);
      next[i] = mesh.points[i] + Vec3((Eigen::Matrix3d::Identity() + tensor).llt().solve(wanted));
    }
  });
}

}  // namespace smopt::baselines
