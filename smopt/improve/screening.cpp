#include "smopt/improve/screening.h"

#include <algorithm>

namespace smopt {

ActiveSet Screening::of_all() {
  ActiveSet set;
  for (FaceId f = 0; f < mesh_.triangle_count(); ++f) examine(f, set);
  finish(set);
  return set;
}

ActiveSet Screening::of_stars(const std::vector<VertexId>& vertices) {
  std::vector<FaceId> faces;
  for (const VertexId v : vertices) faces.insert(faces.end(), rings_.faces(v).begin(), rings_.faces(v).end());
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  ActiveSet set;
  for (const FaceId f : faces) examine(f, set);
  finish(set);
  return set;
}

void Screening::examine(FaceId f, ActiveSet& set) {
  const Triangle& t = mesh_.triangles[f];
  if (!test_.is_low(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]])) return;
  ++set.low_quality;
  for (const VertexId v : t) {
    activate(v, set);
    for (const VertexId w : rings_.vertices(v)) activate(w, set);
  }
}

void Screening::activate(VertexId v, ActiveSet& set) {
  if (is_active_[v] != 0) return;
  is_active_[v] = 1;
  set.vertices.push_back(v);
}

void Screening::finish(ActiveSet& set) {
  std::sort(set.vertices.begin(), set.vertices.end());
  for (const VertexId v : set.vertices) is_active_[v] = 0;
}

}  // namespace smopt
