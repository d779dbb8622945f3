#include "metrics/vertex_spacing.h"

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

namespace smopt::metrics {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Search = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<Kernel>>;

/// A point of the tree finds itself first.
constexpr unsigned kSelfAndNearest = 2;

/// \pre two points at least
double smallest_distance(const std::vector<Vec3>& points) {
  std::vector<Kernel::Point_3> searched;
  searched.reserve(points.size());
  for (const Vec3& p : points) searched.emplace_back(p.x(), p.y(), p.z());
  Search::Tree tree(searched.begin(), searched.end());
  tree.build();
  double squared = std::numeric_limits<double>::infinity();
  for (const Kernel::Point_3& p : searched) {
    const Search search(tree, p, kSelfAndNearest);
    squared = std::min(squared, std::next(search.begin())->second);
  }
  return std::sqrt(squared);
}

}  // namespace

std::optional<double> smallest_vertex_spacing(const TriangleMesh& mesh) {
  const bool are_finite = std::ranges::all_of(mesh.points, [](const Vec3& p) { return p.allFinite(); });
  if (mesh.points.size() < 2 || !are_finite) return std::nullopt;
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.points) box.extend(p);
  const double diagonal = box.diagonal().norm();
  return diagonal > 0 ? smallest_distance(mesh.points) / diagonal : 0;
}

}  // namespace smopt::metrics
