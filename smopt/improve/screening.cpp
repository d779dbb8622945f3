#include "smopt/improve/screening.h"

#include <algorithm>
#include <numeric>

#include "smopt/parallel.h"

namespace smopt {

ActiveSet Screening::of_all() {
  std::vector<FaceId> faces(mesh_.triangle_count());
  std::iota(faces.begin(), faces.end(), FaceId{0});
  return of_faces(faces);
}

ActiveSet Screening::of_stars(const std::vector<VertexId>& vertices) {
  std::vector<FaceId> faces;
  for (const VertexId v : vertices) faces.insert(faces.end(), rings_.faces(v).begin(), rings_.faces(v).end());
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return of_faces(faces);
}

ActiveSet Screening::of_faces(const std::vector<FaceId>& faces) {
  std::vector<char> is_low(faces.size());
  for_ranges_in_parallel(faces.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& t = mesh_.triangles[faces[i]];
      is_low[i] = test_.is_low(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]) ? 1 : 0;
    }
  });
  ActiveSet set;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (is_low[i] == 0) continue;
    ++set.low_quality;
    for (const VertexId v : mesh_.triangles[faces[i]]) {
      activate(v, set);
      for (const VertexId w : rings_.vertices(v)) activate(w, set);
    }
  }
  std::sort(set.vertices.begin(), set.vertices.end());
  for (const VertexId v : set.vertices) is_active_[v] = 0;
  return set;
}

void Screening::activate(VertexId v, ActiveSet& set) {
  if (is_active_[v] != 0) return;
  is_active_[v] = 1;
  set.vertices.push_back(v);
}

}  // namespace smopt
