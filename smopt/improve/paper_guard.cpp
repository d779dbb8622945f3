#include "smopt/improve/paper_guard.h"

#include <algorithm>

namespace smopt {
namespace {

/// Sorted, each once.
template <class T>
void make_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

bool has_corner(const Triangle& t, VertexId v) {
  return t[0] == v || t[1] == v || t[2] == v;
}

}  // namespace

bool edge_meets_triangle_as_printed(const Vec3& q1, const Vec3& q2, const Vec3& p1, const Vec3& p2, const Vec3& p3) {
  const Vec3 edge = q2 - q1;
  const auto are_apart = [&](const Vec3& a, const Vec3& b, const Vec3& third) {
    const Vec3 normal = (a - q1).cross(b - q1);
    return (third - q1).dot(normal) * edge.dot(normal) < 0;
  };
  if (are_apart(p1, p2, p3) || are_apart(p2, p3, p1) || are_apart(p3, p1, p2)) return false;
  const Vec3 normal = (p2 - p1).cross(p3 - p1);
  return !((p1 - q1).dot(normal) * (p1 - q2).dot(normal) > 0);
}

void PaperGuard::select(const StarMove& move, const Vec3& reach) {
  LocalGuard::select(move, reach);
  std::vector<VertexId> centers{move.vertex()};
  for (int ring = 1; ring < vicinity_; ++ring) {
    for (std::size_t i = 0, count = centers.size(); i < count; ++i)
      for (const VertexId w : rings_.vertices(centers[i])) centers.push_back(w);
    make_unique(centers);
  }
  faces_.clear();
  for (const VertexId c : centers) faces_.insert(faces_.end(), rings_.faces(c).begin(), rings_.faces(c).end());
  make_unique(faces_);
  edges_.clear();
  for (const FaceId f : faces_) {
    const Triangle& t = mesh().triangles[f];
    for (std::size_t i = 0; i < 3; ++i) edges_.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
  }
  make_unique(edges_);
}

bool PaperGuard::meets(const Edge& edge, const Triangle& t) const {
  if (has_corner(t, edge.from) || has_corner(t, edge.to)) return false;
  return edge_meets_triangle_as_printed(point(edge.from), point(edge.to), point(t[0]), point(t[1]), point(t[2]));
}

bool PaperGuard::is_ok() {
  for (const FaceId f : faces_)
    for (const VertexId w : move().ring())
      if (meets({move().vertex(), w}, mesh().triangles[f])) return false;
  for (const FaceId f : move().faces())
    for (const Edge& edge : edges_)
      if (meets(edge, mesh().triangles[f])) return false;
  return true;
}

}  // namespace smopt
